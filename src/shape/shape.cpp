#include "medial/shape.h"

#include <algorithm>

#include "base/arc.h"

namespace medial {

std::size_t Shape::component_count() const { return loop_count() - hole_count(); }

std::size_t Shape::hole_count() const {
  return static_cast<std::size_t>(std::count(hole.begin(), hole.end(), true));
}

Ring ring_of(const Shape& shape, std::size_t loop) {
  const auto points = shape.loop(loop);
  Ring ring{{points.begin(), points.end()}, shape.hole[loop] ? RingRole::hole : RingRole::outer};
  if (!shape.bulges.empty()) {
    const auto bulges = std::span(shape.bulges).subspan(shape.loop_begin[loop], points.size());
    ring.bulges.assign(bulges.begin(), bulges.end());
  }
  return ring;
}

std::vector<Ring> rings_of(const Shape& shape) {
  std::vector<Ring> rings;
  rings.reserve(shape.loop_count());
  for (std::size_t i = 0; i < shape.loop_count(); ++i) rings.push_back(ring_of(shape, i));
  return rings;
}

namespace {

/// Calls `visit` with every edge that is not straight.
template <class Visitor>
void for_each_arc(const Shape& shape, const Visitor& visit) {
  if (shape.bulges.empty()) return;
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const std::uint32_t begin = shape.loop_begin[i];
    const std::uint32_t end = shape.loop_begin[i + 1];
    for (std::uint32_t v = begin; v < end; ++v) {
      if (shape.bulges[v] == 0) continue;
      visit(BulgeArc{shape.points[v], shape.points[v + 1 < end ? v + 1 : begin], shape.bulges[v]});
    }
  }
}

}  // namespace

Box bounding_box(const Shape& shape) {
  if (shape.points.empty()) return {};
  Box box{shape.points[0], shape.points[0]};
  for (const Vec2 point : shape.points) box.add(point);
  if (shape.bulges.empty()) return box;
  for_each_arc(shape, [&](const BulgeArc& arc) {
    // No further from its chord than an arc is high, and than the points below are rounded.
    const Vec2 chord = arc.chord();
    const double height =
        (0.51 * std::abs(arc.bulge) + 1e-14) * (std::abs(chord.x) + std::abs(chord.y));
    const auto [left, right] = std::minmax(arc.start.x, arc.end.x);
    const auto [low, high] = std::minmax(arc.start.y, arc.end.y);
    if (left - height > box.low.x && right + height < box.high.x && low - height > box.low.y &&
        high + height < box.high.y)
      return;
    if (const auto point = parallel_point(arc, {1, 0})) {
      box.low.y = std::min(box.low.y, point->y);
      box.high.y = std::max(box.high.y, point->y);
    }
    if (const auto point = parallel_point(arc, {0, 1})) {
      box.low.x = std::min(box.low.x, point->x);
      box.high.x = std::max(box.high.x, point->x);
    }
  });
  return box;
}

double area(const Shape& shape) {
  double sum = 0;
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    // Relative to a vertex of the loop, or far from the origin the digits cancel.
    const std::span<const Vec2> loop = shape.loop(i);
    double twice = 0;
    for (std::size_t k = 2; k < loop.size(); ++k) {
      twice += cross(loop[k - 1] - loop[0], loop[k] - loop[0]);
    }
    sum += twice / 2;
  }
  for_each_arc(shape, [&](const BulgeArc& arc) { sum += area_beside_chord(arc); });
  return sum;
}

}  // namespace medial
