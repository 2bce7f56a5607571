#pragma once

#include "medial/contour.h"

namespace medial::papers {

/// The periodic cubic spline (of continuous curvature) over chords through the points of a polygon
/// and more on its edges, until curve and polygon are within `tolerance`. Requires three different
/// points, no neighbours equal.
Contour spline_through(std::vector<Vec2> points, double tolerance);

}  // namespace medial::papers
