#pragma once

#include "base/vec3.h"
#include "volume/face_tree.h"

namespace medial::volume {

struct Closest {
  double squared_distance = 0;
  Vec3 point;
  bool inside = false;  ///< of the triangle, not on a side
};

/// The nearest point on the three sides of a triangle.
inline Closest closest_on_sides(Vec3 p, const Triangle& triangle) {
  Closest best;
  for (int i = 0; i < 3; ++i) {
    const Vec3 from = triangle.corner[i], to = triangle.corner[(i + 1) % 3];
    const double length2 = medial::squared_norm(to - from);
    const double along = length2 > 0 ? dot(p - from, to - from) / length2 : 0;
    const Vec3 point = along <= 0 ? from : along >= 1 ? to : from + along * (to - from);
    const double distance2 = medial::squared_norm(point - p);
    if (i > 0 && distance2 >= best.squared_distance) continue;
    best = {distance2, point};
  }
  return best;
}

/// The point of a closed triangle nearest to p, by the region of its plane above which p lies
/// (Ericson 2005, Section 5.1.5). If corners and p are below 2^13 in absolute value, the error is
/// below 1e-11. For a triangle without area, the result lies on a side.
inline Closest closest_point(Vec3 p, const Triangle& triangle) {
  const auto& [a, b, c] = triangle.corner;
  const auto at = [p](Vec3 point, bool inside = false) {
    return Closest{medial::squared_norm(point - p), point, inside};
  };
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return at(a);
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return at(b);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return at(a + d1 / (d1 - d3) * ab);
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return at(c);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return at(a + d2 / (d2 - d6) * ac);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return at(b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b));
  if (!(va > 0 && vb > 0 && vc > 0)) return closest_on_sides(p, triangle);
  const double scale = 1 / (va + vb + vc);
  return at(a + vb * scale * ab + vc * scale * ac, true);
}

}  // namespace medial::volume
