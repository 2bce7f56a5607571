#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "base/predicates.h"
#include "medial/geometry.h"

// Exact tests of how segments and triangles meet.

namespace medial::edit {

inline Box box_of(Vec2 a, Vec2 b) {
  Box box{a, a};
  box.add(b);
  return box;
}

inline bool holds(const Box& box, Vec2 p) {
  return box.low.x <= p.x && p.x <= box.high.x && box.low.y <= p.y && p.y <= box.high.y;
}

struct Triangle {
  std::array<Vec2, 3> corner;

  /// Whether a point is inside or on the boundary. May also return true for points outside if the
  /// corners are collinear.
  bool has(Vec2 p) const {
    Box box = box_of(corner[0], corner[1]);
    box.add(corner[2]);
    if (!holds(box, p)) return false;
    int left = 0, right = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const int side = orientation(corner[i], corner[(i + 1) % 3], p);
      left += side > 0 ? 1 : 0;
      right += side < 0 ? 1 : 0;
    }
    return left == 0 || right == 0;
  }
};

/// The crossing of two segments, as a point of the second one: an end of the first may be far away.
inline Vec2 crossing_of(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto away = [&](Vec2 p) { return std::max(std::abs(p.x - c.x), std::abs(p.y - c.y)); };
  if (away(b) < away(a)) std::swap(a, b);
  const Vec2 half = 0.5 * b - 0.5 * a;  // does not overflow
  const double size = std::max(std::abs(half.x), std::abs(half.y));
  const Vec2 way{half.x / size, half.y / size};
  const double of_c = cross(c - a, way), of_d = cross(d - a, way);
  return c + std::clamp(of_c / (of_c - of_d), 0.0, 1.0) * (d - c);
}

enum class Meeting : std::uint8_t { apart, touch, cross };

/// How two closed segments meet.
inline Meeting meeting(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const int of_a = orientation(c, d, a), of_b = orientation(c, d, b);
  if (of_a * of_b > 0) return Meeting::apart;
  const int of_c = orientation(a, b, c), of_d = orientation(a, b, d);
  if (of_c * of_d > 0) return Meeting::apart;
  if (of_a * of_b < 0 && of_c * of_d < 0) return Meeting::cross;
  const Box first = box_of(a, b), second = box_of(c, d);
  const bool are_apart = first.low.x > second.high.x || second.low.x > first.high.x ||
                         first.low.y > second.high.y || second.low.y > first.high.y;
  return are_apart ? Meeting::apart : Meeting::touch;
}

/// Whether a point is strictly inside a segment.
inline bool lies_inside(Vec2 p, Vec2 a, Vec2 b) {
  return holds(box_of(a, b), p) && orientation(a, b, p) == 0 && strictly_between(a, p, b);
}

/// Whether two segments have more than a point in common.
inline bool run_along(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  if (orientation(a, b, c) != 0 || orientation(a, b, d) != 0) return false;
  const auto lower = [](Vec2 p, Vec2 q) { return lexicographic_less(p, q) ? p : q; };
  const auto higher = [](Vec2 p, Vec2 q) { return lexicographic_less(p, q) ? q : p; };
  return lexicographic_less(higher(lower(a, b), lower(c, d)), lower(higher(a, b), higher(c, d)));
}

/// Whether a direction from the centre is strictly inside the wedge from `from` to `to`,
/// counter-clockwise.
inline bool is_in_wedge(Vec2 center, Vec2 from, Vec2 to, Vec2 p) {
  const int turn = orientation(center, from, to);
  const int after_from = orientation(center, from, p), before_to = orientation(center, p, to);
  if (turn > 0) return after_from > 0 && before_to > 0;
  if (turn < 0) return after_from > 0 || before_to > 0;
  return after_from > 0;
}

/// Whether the ray from a point to the right crosses a segment. The point is inside a ring if an
/// odd number of its edges cross the ray.
inline bool crosses_ray(Vec2 a, Vec2 b, Vec2 p) {
  return (a.y > p.y) != (b.y > p.y) && (orientation(a, b, p) > 0) == (b.y > a.y);
}

/// Whether a ring that does not cross itself, but may touch itself, runs counter-clockwise: no
/// vertex is to the left of its least point, and the ring leaves that point along the lowest edge.
inline bool is_counter_clockwise(std::span<const Vec2> ring) {
  const Vec2 least = *std::min_element(ring.begin(), ring.end(), lexicographic_less);
  Vec2 lowest = least;
  bool leaves = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 before = ring[(i > 0 ? i : ring.size()) - 1],
               after = ring[i + 1 < ring.size() ? i + 1 : 0];
    if (!(ring[i] == least)) continue;
    for (const bool is_out : {false, true}) {
      const Vec2 end = is_out ? after : before;
      if (!(lowest == least) && orientation(least, lowest, end) >= 0) continue;
      lowest = end;
      leaves = is_out;
    }
  }
  return leaves;
}

}  // namespace medial::edit
