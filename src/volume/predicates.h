#pragma once

// Exact predicates in space.

#include "base/vec3.h"
#include "medial/geometry.h"

namespace medial::volume {

/// The axis of a vector's largest absolute coordinate; of equal ones, the first.
constexpr int longest_axis(Vec3 a) {
  const auto size = [&a](int axis) { return a[axis] < 0 ? -a[axis] : a[axis]; };
  const int best = size(1) > size(0) ? 1 : 0;
  return size(2) > size(best) ? 2 : best;
}

/// The sign of the volume of the tetrahedron a, b, c, d: +1 if a, b, c turn counter-clockwise as
/// seen from d, -1 clockwise, 0 if all lie in a plane. Exact if products of three coordinates
/// neither overflow nor underflow (absolute values from 1e-100 to 1e100, or zero).
int orientation(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

/// Whether the closed triangles a and b have a common point. Exact in the same range. Of a triangle
/// without area, only the sides count.
bool triangles_meet(const Vec3 (&a)[3], const Vec3 (&b)[3]);

/// Whether the closed segment p, q and the closed triangle have a common point; false for a
/// triangle without area. Exact in the same range.
bool segment_meets_triangle(Vec3 p, Vec3 q, const Vec3 (&triangle)[3]);

/// Whether the line along x through (y, z) = at crosses the triangle. A line that meets a side
/// crosses exactly one of its two faces, by a rule that depends only on the side, so each crossing
/// of a closed surface counts once. Exact.
bool line_crosses(Vec2 at, const Vec3 (&triangle)[3]);

/// Whether a and b lie on the same side of the segment u, v. All points must lie in one plane.
bool same_side(Vec3 u, Vec3 v, Vec3 a, Vec3 b);

}  // namespace medial::volume
