#pragma once

#include "papers/experiment.h"

namespace medial::papers {

/// Figs. 1 to 9. Errors: unwritable.
Status draw_figures(const Request& request);

}  // namespace medial::papers
