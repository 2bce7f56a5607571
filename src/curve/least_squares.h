#pragma once

#include <span>
#include <vector>

#include "medial/contour.h"

namespace medial {

/// The distinct vertices of a polygon that a smooth curve is to follow within `tolerance`. Errors:
/// not_finite, too_few_points (fewer than three), invalid_option (the tolerance).
Result<std::vector<Vec2>> points_to_fit(std::span<const Vec2> polygon, double tolerance);

/// The periodic cubic spline (of continuous curvature) that least squares fit to a polygon, with
/// knots added where it strays, until curve and polygon are within `tolerance` (units of the
/// input), as sampled eight times between knots and twice between vertices. It passes through no
/// vertex and rounds what is smaller than the tolerance. Errors: not_finite, too_few_points,
/// invalid_option, unsupported (2^17 knots).
Result<Contour> smoothed_contour(std::span<const Vec2> polygon, double tolerance);

}  // namespace medial
