#pragma once

#include "papers/experiment.h"

namespace medial::papers {

/// Draws Figs. 1 to 6 of the paper. Errors: unwritable.
Status draw_lee_figures(const Request& request);

}  // namespace medial::papers
