#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/spatial_order.h"
#include "medial/geometry.h"

namespace medial {

/// The squared distance from a point to a box; infinite for the empty box.
inline double squared_distance(const Box& box, Vec2 p) {
  const double dx = std::max({box.low.x - p.x, p.x - box.high.x, 0.0});
  const double dy = std::max({box.low.y - p.y, p.y - box.high.y, 0.0});
  return dx * dx + dy * dy;
}

/// The levels of a tree: bounds of `fan_out` leaves each, then of `fan_out` of these bounds, up to
/// a single bound. `bound_of` gives the bound of a leaf by its number. A bound has add(bound).
/// O(n).
template <class BoundOf>
auto bound_levels(std::size_t count, std::size_t fan_out, const BoundOf& bound_of) {
  using Bound = std::decay_t<decltype(bound_of(0))>;
  std::vector<std::vector<Bound>> levels;
  const auto add_level = [&](std::size_t below, const auto& bound_below) {
    std::vector<Bound> level;
    level.reserve((below + fan_out - 1) / fan_out);
    for (std::size_t i = 0; i < below; i += fan_out) {
      Bound& all = level.emplace_back(bound_below(i));
      for (std::size_t k = i + 1; k < std::min(i + fan_out, below); ++k) all.add(bound_below(k));
    }
    levels.push_back(std::move(level));
  };
  add_level(count, bound_of);
  while (levels.back().size() > 1) {
    const std::vector<Bound>& below = levels.back();
    add_level(below.size(), [&below](std::size_t k) -> const Bound& { return below[k]; });
  }
  return levels;
}

/// A tree of boxes that finds the boxes that meet another box.
class BoxTree {
 public:
  /// O(n log n).
  explicit BoxTree(std::span<const Box> boxes)
      : BoxTree(boxes, spatial_order(places_of(boxes), fan_out)) {}

  /// Uses a given order, such as the boxes' own or one along a curve. Faster to build, but less
  /// tight. O(n).
  BoxTree(std::span<const Box> boxes, std::vector<std::uint32_t> order) : order_(std::move(order)) {
    std::vector<Box>& leaves = levels_.emplace_back();
    leaves.reserve(boxes.size());
    for (const std::uint32_t i : order_) leaves.push_back(boxes[i]);
    if (leaves.size() < 2) return;
    for (auto& level :
         bound_levels(order_.size(), fan_out, [&](std::size_t k) { return boxes[order_[k]]; }))
      levels_.push_back(std::move(level));
  }

  /// Calls visit(i) for each box i that meets `query`, which `visit` may shrink. O(log n) per box
  /// found if boxes are small or overlap little.
  template <class Visit>
  void find(const Box& query, const Visit& visit) const {
    if (!order_.empty()) find_below(levels_.size() - 1, 0, query, visit);
  }

  /// Calls visit(i, j) once for each pair of boxes that meet. O(n + k) for k pairs if boxes are
  /// small or overlap little.
  template <class Visit>
  void find_pairs(const Visit& visit) const {
    if (!order_.empty()) pairs_within(levels_.size() - 1, 0, visit);
  }

  /// The centres of the boxes.
  static std::vector<Vec2> places_of(std::span<const Box> boxes) {
    std::vector<Vec2> places;
    places.reserve(boxes.size());
    for (const Box& box : boxes) places.push_back(midpoint(box.low, box.high));
    return places;
  }

 private:
  static constexpr std::size_t fan_out = 8;

  static bool meet(const Box& a, const Box& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
  }

  template <class Visit>
  void find_below(std::size_t level, std::size_t i, const Box& query, const Visit& visit) const {
    if (!meet(levels_[level][i], query)) return;
    if (level == 0) return visit(order_[i]);
    const std::size_t end = std::min((i + 1) * fan_out, levels_[level - 1].size());
    for (std::size_t k = i * fan_out; k < end; ++k) find_below(level - 1, k, query, visit);
  }

  std::size_t end_below(std::size_t level, std::size_t i) const {
    return std::min((i + 1) * fan_out, levels_[level - 1].size());
  }

  template <class Visit>
  void pairs_within(std::size_t level, std::size_t i, const Visit& visit) const {
    if (level == 0) return;
    const std::size_t end = end_below(level, i);
    for (std::size_t k = i * fan_out; k < end; ++k) {
      pairs_within(level - 1, k, visit);
      for (std::size_t m = k + 1; m < end; ++m) pairs_between(level - 1, k, m, visit);
    }
  }

  /// Visits the pairs below two nodes of one level.
  template <class Visit>
  void pairs_between(std::size_t level, std::size_t i, std::size_t j, const Visit& visit) const {
    const Box &a = levels_[level][i], &b = levels_[level][j];
    if (!meet(a, b)) return;
    if (level == 0) return visit(order_[i], order_[j]);
    const std::vector<Box>& below = levels_[level - 1];
    const std::size_t end = end_below(level, j);
    for (std::size_t k = i * fan_out; k < end_below(level, i); ++k) {
      if (!meet(below[k], b)) continue;
      for (std::size_t m = j * fan_out; m < end; ++m) pairs_between(level - 1, k, m, visit);
    }
  }

  std::vector<std::uint32_t> order_;
  std::vector<std::vector<Box>> levels_;  ///< from the boxes themselves up to one
};

}  // namespace medial
