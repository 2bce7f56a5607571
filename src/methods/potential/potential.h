#pragma once

#include "medial/axis.h"
#include "medial/error.h"
#include "methods/problem.h"

namespace medial::potential {

/// What the method cannot take of its options.
std::optional<Error> refuse(const Problem& problem);

/// The engine `potential` (docs/potential.md). Requires what compute() has checked. Errors:
/// unsupported (valleys that the arithmetic cannot tell apart, so that no connected skeleton is
/// found), invalid_option (a seed outside of the shape).
Result<MedialAxis> run(const Problem& problem);

}  // namespace medial::potential
