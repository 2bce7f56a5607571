#pragma once

#include "methods/problem.h"

namespace medial::curve_axis {

/// The method `curve-axis` (docs/curve-axis.md) on the problem's contours, or on the shape's own
/// loops. Errors: those of compute_curve_axis().
Result<MedialAxis> run(const Problem& problem);

}  // namespace medial::curve_axis
