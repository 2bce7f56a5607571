#pragma once

#include "medial/contour.h"

namespace medial::curve {

/// fit_smooth_contour() for each polygon. Omits loops that lie in a disk of radius `tolerance`,
/// except for the largest loop: this moves no part of the shape by more than a fit may, and coarse
/// fits of specks would cross their neighbours. Errors: those of fit_smooth_contour().
Result<std::vector<Contour>> fit_loops(std::span<const std::vector<Vec2>> polygons,
                                       double tolerance);

}  // namespace medial::curve
