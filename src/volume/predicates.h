#pragma once

// Decisions in space that are exact for all finite coordinates.

#include "base/vec3.h"
#include "medial/geometry.h"

namespace medial::volume {

/// The axis along which a vector is longest; of equals the first one.
constexpr int longest_axis(Vec3 a) {
  const auto size = [&a](int axis) { return a[axis] < 0 ? -a[axis] : a[axis]; };
  const int best = size(1) > size(0) ? 1 : 0;
  return size(2) > size(best) ? 2 : best;
}

/// The sign of the volume of the tetrahedron a, b, c, d: +1 if a, b, c turn counter-clockwise as
/// seen from d, -1 clockwise, 0 if all lie in a plane. Exact for all coordinates whose products of
/// three neither overflow nor underflow (1e-100 to 1e100 in size, or zero).
int orientation(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

/// Whether the closed triangles a and b have a point in common. Exact in the same range, except for
/// a triangle without area, where only the sides count.
bool triangles_meet(const Vec3 (&a)[3], const Vec3 (&b)[3]);

/// Whether the closed segment p, q and the closed triangle have a point in common; a triangle
/// without area has none. Exact in the same range.
bool segment_meets_triangle(Vec3 p, Vec3 q, const Vec3 (&triangle)[3]);

/// Whether the line along x through (y, z) = at crosses the triangle. A line that meets a side
/// crosses one of its two faces, by a rule that depends on the side alone: so each crossing of a
/// closed surface counts once. Exact.
bool line_crosses(Vec2 at, const Vec3 (&triangle)[3]);

/// Requires a and b in one plane with the segment u, v: whether they lie on the same side of it.
bool same_side(Vec3 u, Vec3 v, Vec3 a, Vec3 b);

}  // namespace medial::volume
