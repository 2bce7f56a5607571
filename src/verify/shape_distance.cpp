#include <algorithm>
#include <limits>

#include "medial/verify.h"
#include "verify/boundary_edge.h"
#include "verify/distance_tree.h"

namespace medial {
namespace {

using verify_detail::BoundaryEdge;

/// The largest distance from a boundary to what the tree holds, and where.
double directed(const Shape& from, const verify_detail::DistanceTree& to, int samples,
                double smallest, Vec2& worst) {
  double largest = -1, expected = smallest;
  const auto measure = [&](Vec2 p) {
    const double d = to.distance(p, expected);
    expected = std::max(d, smallest);
    if (d <= largest) return;
    largest = d;
    worst = p;
  };
  for (std::size_t i = 0; i < from.loop_count(); ++i) {
    const auto loop = from.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const BoundaryEdge edge{loop[k], loop[k + 1 < loop.size() ? k + 1 : 0],
                              from.bulge(from.loop_begin[i] + k)};
      measure(edge.start);
      const double length = verify_detail::length_of(edge);
      for (int s = 1; s <= samples; ++s)
        measure(verify_detail::point_at(edge, length * s / (samples + 1)));
    }
  }
  return largest;
}

}  // namespace

ShapeDistance shape_distance(const Shape& first, const Shape& second, int samples) {
  ShapeDistance result;
  if (!first.points.empty()) result.area = area(first);
  if (!second.points.empty()) result.other_area = area(second);
  if (first.points.empty() != second.points.empty()) {
    result.from_first = result.from_second = std::numeric_limits<double>::infinity();
    return result;
  }
  if (first.points.empty()) return result;
  const double smallest = 1e-9 * diagonal(bounding_box(first));
  const verify_detail::DistanceTree tree(first), other(second);
  Vec2 worst_of_second;
  result.from_first = directed(first, other, samples, smallest, result.worst);
  result.from_second = directed(second, tree, samples, smallest, worst_of_second);
  if (result.from_second > result.from_first) result.worst = worst_of_second;
  return result;
}

}  // namespace medial
