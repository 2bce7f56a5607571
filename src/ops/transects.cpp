#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/arc.h"
#include "medial/measure.h"

namespace medial {

namespace {

/// The centres of a path's disks at lengths in any order.
std::vector<Vec2> points_along(const MedialAxis& axis, const AxisPath& path,
                               const std::vector<double>& lengths) {
  std::vector<std::size_t> order(lengths.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&lengths](std::size_t a, std::size_t b) { return lengths[a] < lengths[b]; });
  std::vector<double> sorted;
  for (const std::size_t i : order) sorted.push_back(std::clamp(lengths[i], 0.0, path.length));
  const std::vector<LocalWidth> found = widths_along(axis, path, sorted);
  std::vector<Vec2> points(lengths.size());
  for (std::size_t k = 0; k < order.size(); ++k) points[order[k]] = found[k].disk.center;
  return points;
}

/// Where a line p + t d, |d| = 1, crosses an edge of at most half a circle, as t; at most two, else
/// infinite.
std::array<double, 2> crossings(Vec2 p, Vec2 d, const BulgeArc& edge) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const Vec2 chord = edge.chord(), w = p - edge.start;
  if (edge.bulge == 0) {
    const double slant = cross(d, chord);
    const double on_edge = cross(d, w) / slant;
    const bool crosses = slant != 0 && on_edge >= 0 && on_edge <= 1;
    return {crosses ? cross(chord, w) / slant : none, none};
  }
  // With the normal n at the start and the curvature k, a place q from there is on the circle where
  // k q.q = 2 n.q. Nothing is divided by k alone: the arc may be as flat as it likes.
  const Vec2 n = left_of(start_tangent(edge));
  const double k = curvature(edge), b = dot(n - k * w, d), c = dot(k * w - 2 * n, w);
  const double square = b * b - k * c;
  if (square < 0) return {none, none};
  const double root = b + std::copysign(std::sqrt(square), b);
  // The arc lies beyond its chord.
  const auto on_arc = [&](double t) {
    return cross(chord, w + t * d) * edge.bulge <= 0 ? t : none;
  };
  return {on_arc(root / k), on_arc(c / root)};
}

/// The first points of the boundary on both sides of p; where there is none, `otherwise`.
std::array<Vec2, 2> cast(const Shape& shape, Vec2 p, Vec2 left, std::array<Vec2, 2> otherwise) {
  constexpr double none = std::numeric_limits<double>::infinity();
  double nearest[2] = {none, none};
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const std::uint32_t begin = shape.loop_begin[i], end = shape.loop_begin[i + 1];
    for (std::uint32_t k = begin; k < end; ++k) {
      const Vec2 next = shape.points[k + 1 < end ? k + 1 : begin];
      for (const double t : crossings(p, left, {shape.points[k], next, shape.bulge(k)}))
        if (std::fabs(t) < nearest[t < 0]) nearest[t < 0] = std::fabs(t);
    }
  }
  if (nearest[0] < none) otherwise[0] = p + nearest[0] * left;
  if (nearest[1] < none) otherwise[1] = p - nearest[1] * left;
  return otherwise;
}

}  // namespace

std::vector<LocalWidth> transects_along(const Shape& shape, const MedialAxis& axis,
                                        const AxisPath& path, std::span<const double> lengths) {
  std::vector<LocalWidth> transects = widths_along(axis, path, lengths);
  std::vector<double> before, after;
  for (const LocalWidth& at : transects) {
    before.push_back(at.along - at.disk.radius);
    after.push_back(at.along + at.disk.radius);
  }
  const std::vector<Vec2> from = points_along(axis, path, before);
  const std::vector<Vec2> to = points_along(axis, path, after);
  for (std::size_t i = 0; i < transects.size(); ++i) {
    const Vec2 course = to[i] - from[i];
    const double length = norm(course);
    if (!(length > 0)) continue;
    transects[i].feet =
        cast(shape, transects[i].disk.center, (1 / length) * left_of(course), transects[i].feet);
  }
  return transects;
}

}  // namespace medial
