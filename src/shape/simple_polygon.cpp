#include "shape/simple_polygon.h"

#include <algorithm>
#include <utility>

#include "base/predicates.h"

namespace medial {
namespace {

constexpr std::size_t most_points = 24;  ///< beyond them the sweep is as fast

/// Whether the two ends lie strictly on one side of a -> b.
bool on_one_side(Vec2 a, Vec2 b, Vec2 start, Vec2 end) {
  const int side = orientation(a, b, start);
  return side != 0 && side == orientation(a, b, end);
}

/// Of two segments without a common point the line of one has the other strictly on one side,
/// unless both lie on one line: those count as meeting where their boxes meet.
bool may_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto apart = [](double a0, double a1, double b0, double b1) {
    return std::max(a0, a1) < std::min(b0, b1) || std::max(b0, b1) < std::min(a0, a1);
  };
  if (apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y)) return false;
  return !on_one_side(a, b, c, d) && !on_one_side(c, d, a, b);
}

bool is_simple(std::span<const Vec2> points) {
  const std::size_t count = points.size();
  const auto at = [&](std::size_t i) { return points[i < count ? i : i - count]; };
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 a = points[i], b = at(i + 1);
    if (orientation(a, b, at(i + 2)) == 0) return false;  // a spike
    for (std::size_t j = i + 2; j < std::min(count, count - 1 + i); ++j)
      if (may_meet(a, b, points[j], at(j + 1))) return false;
  }
  return true;
}

/// Requires a simple ring.
bool is_counter_clockwise(std::span<const Vec2> points) {
  const auto leftmost = std::min_element(points.begin(), points.end(), lexicographic_less);
  const Vec2 before = leftmost == points.begin() ? points.back() : *(leftmost - 1);
  const Vec2 after = leftmost + 1 == points.end() ? points.front() : *(leftmost + 1);
  return orientation(before, *leftmost, after) > 0;
}

}  // namespace

std::optional<Shape> simple_polygon(std::span<const Ring> rings, CleanRings& cleaned,
                                    ShapeReport& report) {
  if (rings.size() != 1 || cleaned.points.size() > most_points || !cleaned.bulges.empty())
    return std::nullopt;
  const RingRole role = rings[0].role;
  if ((role != RingRole::any && role != RingRole::outer) || !is_simple(cleaned.points))
    return std::nullopt;
  Shape shape;
  shape.points = std::move(cleaned.points);
  shape.sources = std::move(cleaned.sources);
  shape.loop_begin = std::move(cleaned.begin);
  shape.component = {0};
  shape.hole = {false};
  if (is_counter_clockwise(shape.points)) return shape;
  std::reverse(shape.points.begin() + 1, shape.points.end());
  std::reverse(shape.sources.begin() + 1, shape.sources.end());
  report.reversed_rings = 1;
  return shape;
}

}  // namespace medial
