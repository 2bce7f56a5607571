#pragma once

// Exact predicates on points, for all finite coordinates.

#include <cmath>
#include <limits>

#include "medial/geometry.h"

namespace medial {

/// The order of the plane sweep: by x, then by y.
constexpr bool lexicographic_less(Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

/// Whether p lies strictly between a and b. Requires collinear points.
constexpr bool strictly_between(Vec2 a, Vec2 p, Vec2 b) {
  return (lexicographic_less(a, p) && lexicographic_less(p, b)) ||
         (lexicographic_less(b, p) && lexicographic_less(p, a));
}

/// The slow path of orientation(), for points whose sign double precision does not decide.
int exact_orientation(Vec2 a, Vec2 b, Vec2 c);

/// The sign of the area of the triangle a, b, c: +1 if c lies to the left of a -> b, -1 to the
/// right, 0 on the line. Exact for all finite coordinates, even if differences or products overflow
/// or underflow.
inline int orientation(Vec2 a, Vec2 b, Vec2 c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double area = left - right;
  // With u = epsilon / 2, the three roundings of each product and the one of the difference amount
  // to less than (3 + 16 u) u (|left| + |right|); underflow adds less than the smallest normal
  // number. An overflow makes both sides infinite or not a number, and the comparison false.
  constexpr double u = std::numeric_limits<double>::epsilon() / 2;
  constexpr double relative = (3 + 16 * u) * u;
  constexpr double underflow = std::numeric_limits<double>::min();
  const double error = relative * (std::abs(left) + std::abs(right)) + underflow;
  if (area > error) return 1;
  if (area < -error) return -1;
  return exact_orientation(a, b, c);
}

/// The slow path of in_circle(), for points whose sign double precision does not decide.
int exact_in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 p);

/// The position of p relative to the circle through a, b and c (counter-clockwise): +1 inside, -1
/// outside, 0 on it. Exact for all finite coordinates.
inline int in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
  const Vec2 u = a - p, v = b - p, w = c - p;
  const double vw = v.x * w.y, wv = w.x * v.y, wu = w.x * u.y, uw = u.x * w.y, uv = u.x * v.y,
               vu = v.x * u.y;
  const double uu = squared_norm(u), vv = squared_norm(v), ww = squared_norm(w);
  const double sum = uu * (vw - wv) + vv * (wu - uw) + ww * (uv - vu);
  const double sizes = uu * (std::abs(vw) + std::abs(wv)) + vv * (std::abs(wu) + std::abs(uw)) +
                       ww * (std::abs(uv) + std::abs(vu));
  // Each term has a rounded difference in each of four factors, two roundings in the square, two in
  // the minor, one product and at most two sums: 11 units. The error of an underflow is at most the
  // smallest normal number times the other factor; an overflow makes the comparison false.
  constexpr double unit = std::numeric_limits<double>::epsilon() / 2;
  constexpr double relative = (12 + 128 * unit) * unit;
  constexpr double underflow = std::numeric_limits<double>::min();
  const double error = relative * sizes + 8 * underflow * (1 + uu + vv + ww);
  if (sum > error) return 1;
  if (sum < -error) return -1;
  return exact_in_circle(a, b, c, p);
}

}  // namespace medial
