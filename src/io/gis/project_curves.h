#pragma once

#include <functional>
#include <vector>

#include "medial/contour.h"

namespace medial::io {

/// Takes points to their images, all or none.
using PointMap = std::function<bool(std::vector<Vec2>&)>;

/// The image of a contour under a smooth map of the plane that is no affine one. Straight pieces
/// stay straight, as edges of polygons do; each arc or curve becomes Bezier curves of degree 5 that
/// are the image at six places and, at five places between, within `tolerance` of it (measured;
/// halved until they are, by which the error falls to a 64th). False where a point has no image or
/// a piece has none that is smooth.
bool project_contour(const PointMap& map, double tolerance, Contour& contour);

}  // namespace medial::io
