#include "volume/predicates.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/predicates.h"
#include "base/vec3.h"
#include "base/whole.h"

// g++ 12 warns, wrongly, of limbs inside cpp_int where its moves are inlined here.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

namespace medial::volume {
namespace {

using Integer = boost::multiprecision::cpp_int;

int exact_orientation(const std::array<Vec3, 4>& points) {
  std::array<double, 12> coordinates;
  for (std::size_t i = 0; i < 12; ++i) coordinates[i] = points[i / 3][static_cast<int>(i % 3)];
  const int lowest = binary_range(coordinates).lowest;
  std::array<std::array<Integer, 3>, 3> row;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto last = multiple_of<Integer>(coordinates[9 + axis], lowest);
    for (std::size_t i = 0; i < 3; ++i)
      row[i][axis] = multiple_of<Integer>(coordinates[3 * i + axis], lowest) - last;
  }
  const Integer left = row[0][0] * (row[1][1] * row[2][2] - row[1][2] * row[2][1]) +
                       row[1][0] * (row[2][1] * row[0][2] - row[2][2] * row[0][1]) +
                       row[2][0] * (row[0][1] * row[1][2] - row[0][2] * row[1][1]);
  // The determinant of a - d, b - d, c - d is negative where a, b, c turn counter-clockwise.
  return -left.sign();
}

/// The plane without one axis, in which a triangle that has an area keeps some.
Vec2 without(int axis, Vec3 p) {
  return axis == 0 ? Vec2{p.y, p.z} : axis == 1 ? Vec2{p.z, p.x} : Vec2{p.x, p.y};
}

/// The axis without which the triangle keeps some area, and the sign of it; -1 if there is none.
int flat_axis(Vec3 a, Vec3 b, Vec3 c) {
  // The largest component of the normal first, for the sake of well shaped triangles.
  const int best = longest_axis(cross(b - a, c - a));
  for (int turn = 0; turn < 3; ++turn) {
    const int axis = (best + turn) % 3;
    if (medial::orientation(without(axis, a), without(axis, b), without(axis, c)) != 0) return axis;
  }
  return -1;
}

bool segments_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const int abc = medial::orientation(a, b, c), abd = medial::orientation(a, b, d);
  const int cda = medial::orientation(c, d, a), cdb = medial::orientation(c, d, b);
  if (abc == 0 && abd == 0) {  // on one line
    if (lexicographic_less(b, a)) std::swap(a, b);
    if (lexicographic_less(d, c)) std::swap(c, d);
    return !lexicographic_less(b, c) && !lexicographic_less(d, a);
  }
  return abc * abd <= 0 && cda * cdb <= 0;
}

bool flat_segment_meets_triangle(Vec2 p, Vec2 q, const std::array<Vec2, 3>& triangle) {
  for (std::size_t i = 0; i < 3; ++i)
    if (segments_meet(p, q, triangle[i], triangle[(i + 1) % 3])) return true;
  const int first = medial::orientation(triangle[0], triangle[1], p);
  return first == medial::orientation(triangle[1], triangle[2], p) &&
         first == medial::orientation(triangle[2], triangle[0], p);
}

}  // namespace

int orientation(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 ad = a - d, bd = b - d, cd = c - d;
  const double bc1 = bd.y * cd.z, bc2 = bd.z * cd.y;
  const double ca1 = cd.y * ad.z, ca2 = cd.z * ad.y;
  const double ab1 = ad.y * bd.z, ab2 = ad.z * bd.y;
  const double volume = ad.x * (bc1 - bc2) + bd.x * (ca1 - ca2) + cd.x * (ab1 - ab2);
  const double size = std::abs(ad.x) * (std::abs(bc1) + std::abs(bc2)) +
                      std::abs(bd.x) * (std::abs(ca1) + std::abs(ca2)) +
                      std::abs(cd.x) * (std::abs(ab1) + std::abs(ab2));
  // With u = epsilon / 2: three roundings of the differences, two of products, three of sums on the
  // way of each term, so less than (8 + 64 u) u of the sum of sizes; u more for that sum's own
  // seven roundings. Underflow adds less than the smallest normal number.
  constexpr double u = std::numeric_limits<double>::epsilon() / 2;
  constexpr double relative = (16 + 256 * u) * u;
  const double error = relative * size + std::numeric_limits<double>::min();
  if (volume > error) return -1;
  if (volume < -error) return 1;
  for (int axis = 0; axis < 3; ++axis)  // faces of boxes
    if (a[axis] == b[axis] && a[axis] == c[axis] && a[axis] == d[axis]) return 0;
  if (a == d || b == d || c == d || a == b || b == c || a == c) return 0;
  return exact_orientation({a, b, c, d});
}

bool segment_meets_triangle(Vec3 p, Vec3 q, const Vec3 (&triangle)[3]) {
  const Vec3 a = triangle[0], b = triangle[1], c = triangle[2];
  const int at_p = orientation(a, b, c, p);
  const int at_q = orientation(a, b, c, q);
  if (at_p * at_q > 0) return false;
  if (at_p == 0 && at_q == 0) {
    const int axis = flat_axis(a, b, c);
    if (axis < 0) return false;
    return flat_segment_meets_triangle(without(axis, p), without(axis, q),
                                       {without(axis, a), without(axis, b), without(axis, c)});
  }
  const int ab = orientation(p, q, a, b);
  const int bc = orientation(p, q, b, c);
  const int ca = orientation(p, q, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

bool triangles_meet(const Vec3 (&a)[3], const Vec3 (&b)[3]) {
  // Triangles wholly on one side of the other's plane are the common case.
  const int side0 = orientation(b[0], b[1], b[2], a[0]);
  if (side0 != 0 && side0 == orientation(b[0], b[1], b[2], a[1]) &&
      side0 == orientation(b[0], b[1], b[2], a[2]))
    return false;
  for (int i = 0; i < 3; ++i) {
    if (segment_meets_triangle(a[i], a[(i + 1) % 3], b)) return true;
    if (segment_meets_triangle(b[i], b[(i + 1) % 3], a)) return true;
  }
  return false;
}

bool line_crosses(Vec2 at, const Vec3 (&triangle)[3]) {
  bool crosses = false;
  for (int i = 0; i < 3; ++i) {
    Vec2 a = without(0, triangle[i]), b = without(0, triangle[(i + 1) % 3]);
    if ((a.y > at.y) == (b.y > at.y)) continue;
    if (a.y > b.y) std::swap(a, b);
    if (medial::orientation(a, b, at) > 0) crosses = !crosses;
  }
  return crosses;
}

bool same_side(Vec3 u, Vec3 v, Vec3 a, Vec3 b) {
  const int axis = flat_axis(u, v, a);
  if (axis < 0) return false;
  return medial::orientation(without(axis, u), without(axis, v), without(axis, a)) ==
         medial::orientation(without(axis, u), without(axis, v), without(axis, b));
}

}  // namespace medial::volume
