#pragma once

#include "methods/problem.h"

namespace medial {

/// The method `auto`: see method::Auto.
Result<Outcome> run_automatic(const Problem& problem);

}  // namespace medial
