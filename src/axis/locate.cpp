#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "axis/curve.h"
#include "axis/inside.h"
#include "base/arc.h"
#include "base/box_tree.h"
#include "base/predicates.h"
#include "base/spatial_order.h"
#include "medial/query.h"

namespace medial {
namespace {

constexpr std::size_t fan_out = 8;

/// A box around the edge. As its weights are positive, a curve lies in the hull of its control
/// points.
Box box_of(const MedialAxis& axis, const Edge& edge) {
  const Vec2 a = axis.nodes[edge.node[0]].disk.center;
  const Vec2 b = edge.control.center;
  const Vec2 c = axis.nodes[edge.node[1]].disk.center;
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})}};
}

}  // namespace

/// Boxes around fan_out edges each, in spatial order.
struct AxisLocator::Index {
  const MedialAxis* axis = nullptr;
  std::vector<std::uint32_t> order;
  std::vector<std::vector<Box>> levels;

  explicit Index(const MedialAxis& medial_axis) : axis(&medial_axis) {
    std::vector<Vec2> center;
    center.reserve(axis->edges.size());
    for (const Edge& edge : axis->edges) {
      const Box box = box_of(*axis, edge);
      center.push_back(midpoint(box.low, box.high));
    }
    order = spatial_order(center, fan_out);
    levels = bound_levels(order.size(), fan_out,
                          [this](std::size_t k) { return box_of(*axis, axis->edges[order[k]]); });
  }

  /// Visits node `index` of `level`, its children nearest first, unless it is farther than `best`.
  void visit(std::size_t level, std::size_t index, Vec2 p, AxisPoint& best) const {
    if (level == 0) {
      const std::size_t end = std::min((index + 1) * fan_out, order.size());
      for (std::size_t i = index * fan_out; i < end; ++i) {
        const Curve curve = curve_of(*axis, axis->edges[order[i]]);
        const double t = curve.nearest(p);
        // Relative to the curve's origin, before the point is rounded.
        const double d = norm(curve.offset(t) - (p - curve.origin));
        if (d < best.distance || (d == best.distance && order[i] < best.edge))
          best = {{{order[i], t}, curve.at(t)}, d};
      }
      return;
    }
    const std::vector<Box>& boxes = levels[level - 1];
    const std::size_t begin = index * fan_out, end = std::min(begin + fan_out, boxes.size());
    std::array<std::pair<double, std::size_t>, fan_out> child;
    child.fill({std::numeric_limits<double>::infinity(), boxes.size()});
    for (std::size_t i = begin; i < end; ++i)
      child[i - begin] = {std::sqrt(squared_distance(boxes[i], p)), i};
    std::sort(child.begin(), child.end());
    for (std::size_t i = 0; i < end - begin; ++i)
      if (child[i].first <= best.distance) visit(level - 1, child[i].second, p, best);
  }
};

AxisLocator::AxisLocator(const MedialAxis& axis) : index_(std::make_shared<Index>(axis)) {}

AxisPoint AxisLocator::nearest(Vec2 p) const {
  AxisPoint best;
  best.distance = std::numeric_limits<double>::infinity();
  if (!index_->order.empty()) index_->visit(index_->levels.size() - 1, 0, p, best);
  return best;
}

namespace {

/// Whether an edge changes whether p counts as inside: either a ray from p to the right crosses the
/// edge's chord, or p lies between an arc and its chord.
bool is_crossed(Vec2 a, Vec2 b, double bulge, Vec2 p) {
  // By the half-open rule, the ray crosses an upward edge that has p on the left.
  bool crossed = (a.y <= p.y) != (b.y <= p.y) && (orientation(a, b, p) > 0) == (a.y <= p.y);
  if (bulge != 0) {
    // A point on the chord itself counts as on the right; on the left only if the chord points in
    // the ray's direction.
    const Vec2 half = half_angle(bulge), d = b - a;
    const double power = half.y * dot(p - a, p - b) - half.x * cross(d, p - a);  // to the circle
    const int turn = orientation(a, b, p);
    const bool left = turn > 0 || (turn == 0 && d.y == 0 && d.x > 0);
    if (left == (bulge < 0) && power * bulge < 0) crossed = !crossed;
  }
  return crossed;
}

}  // namespace

std::vector<Inside::BoundaryEdge> Inside::edges_of(const Shape& shape) {
  std::vector<BoundaryEdge> edges;
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    for (std::size_t j = 0; j < loop.size(); ++j)
      edges.push_back(
          {loop[j], loop[j + 1 < loop.size() ? j + 1 : 0], shape.bulge(shape.loop_begin[i] + j)});
  }
  return edges;
}

std::vector<Box> Inside::boxes_of(const std::vector<BoundaryEdge>& edges) {
  std::vector<Box> boxes;
  for (const auto& [a, b, bulge] : edges) {
    const double out = std::abs(bulge) * distance(a, b);  // twice the arc's height
    boxes.push_back({{std::min(a.x, b.x) - out, std::min(a.y, b.y) - out},
                     {std::max(a.x, b.x) + out, std::max(a.y, b.y) + out}});
  }
  return boxes;
}

Inside::Inside(const Shape& shape) : edges_(edges_of(shape)), tree_(boxes_of(edges_)) {}

bool Inside::holds(Vec2 p) const {
  bool inside = false;
  tree_.find({p, {std::numeric_limits<double>::infinity(), p.y}}, [&](std::uint32_t i) {
    const auto& [a, b, bulge] = edges_[i];
    if (is_crossed(a, b, bulge, p)) inside = !inside;
  });
  return inside;
}

double clearance(const Shape& shape, Vec2 p) {
  double best = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const Vec2 a = loop[j], b = loop[j + 1 < loop.size() ? j + 1 : 0];
      const Vec2 d = b - a, q = p - a;
      // The distance to the segment: perpendicular, or to the nearer end.
      const double size = norm(d), along = dot(d, q);
      double distance_to_edge = std::abs(cross(d, q)) / size;
      if (along <= 0) distance_to_edge = norm(q);
      if (along >= size * size) distance_to_edge = norm(p - b);
      const double bulge = shape.bulge(shape.loop_begin[i] + j);
      if (bulge != 0) distance_to_edge = distance(foot({a, b, 0, 0, bulge}, p), p);
      best = std::min(best, distance_to_edge);
      if (is_crossed(a, b, bulge, p)) inside = !inside;
    }
  }
  return inside ? best : -best;
}

}  // namespace medial
