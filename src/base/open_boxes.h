#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/box_tree.h"
#include "base/numbers.h"

namespace medial {

/// A set of items with boxes, for finding the nearest item. A tree holds boxes around the remaining
/// items.
class OpenBoxes {
 public:
  /// Starts with all items. O(n log n).
  explicit OpenBoxes(std::vector<Box> boxes)
      : boxes_(std::move(boxes)), left_(boxes_.size(), true) {
    const std::vector<Vec2> places = BoxTree::places_of(boxes_);
    order_ = spatial_order(places, fan_out);
    leaf_of_.resize(order_.size());
    for (std::uint32_t k = 0; k < order_.size(); ++k) leaf_of_[order_[k]] = k;
    if (!boxes_.empty())
      levels_ = bound_levels(order_.size(), fan_out, [this](std::size_t k) { return leaf(k); });
  }
  bool empty() const { return levels_.empty() || levels_.back().front().is_nothing(); }
  /// The remaining item with the lowest number. Requires one. O(n); if no item is inserted again,
  /// all calls together take O(n).
  std::uint32_t first() {
    while (!left_[first_]) ++first_;
    return first_;
  }
  /// O(log n).
  void insert(std::uint32_t i) { put(i, true); }
  void erase(std::uint32_t i) { put(i, false); }

  /// The remaining item nearest to p by `squared_distance_to(i)`, which is at least the squared
  /// distance of its box; of equally near items, the lowest number. Requires one. O(log n) if the
  /// other items are farther away.
  template <class SquaredDistanceTo>
  std::uint32_t nearest(Vec2 p, const SquaredDistanceTo& squared_distance_to) const {
    Nearest best{infinity, 0};
    search(levels_.size() - 1, 0, p, squared_distance_to, best);
    return best.second;
  }

 private:
  using Nearest = std::pair<double, std::uint32_t>;  ///< a squared distance and its item
  static constexpr std::size_t fan_out = 8;

  Box leaf(std::size_t k) const { return left_[order_[k]] ? boxes_[order_[k]] : Box::nothing(); }
  /// The end of the children of box i of a level.
  std::size_t end_of(std::size_t level, std::size_t i) const {
    return std::min((i + 1) * fan_out, level == 0 ? order_.size() : levels_[level - 1].size());
  }
  void put(std::uint32_t which, bool left) {
    left_[which] = left;
    if (left) first_ = std::min(first_, which);
    std::size_t i = leaf_of_[which];
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      i /= fan_out;
      Box& box = levels_[level][i];
      box = Box::nothing();
      for (std::size_t k = i * fan_out; k < end_of(level, i); ++k)
        box.add(level > 0 ? levels_[level - 1][k] : leaf(k));
    }
  }
  /// Searches below box i of a level, nearest boxes first. Distances of boxes may be rounded up.
  template <class SquaredDistanceTo>
  void search(std::size_t level, std::size_t i, Vec2 p,
              const SquaredDistanceTo& squared_distance_to, Nearest& best) const {
    constexpr double rounding = 1 - 0x1p-40;
    std::array<std::pair<double, std::size_t>, fan_out> parts;
    std::size_t count = 0;
    for (std::size_t k = i * fan_out; k < end_of(level, i); ++k) {
      const double near =
          rounding * squared_distance(level > 0 ? levels_[level - 1][k] : leaf(k), p);
      if (near == infinity || near > best.first) continue;
      std::size_t at = count++;
      for (; at > 0 && parts[at - 1].first > near; --at) parts[at] = parts[at - 1];
      parts[at] = {near, k};
    }
    for (std::size_t k = 0; k < count && parts[k].first <= best.first; ++k) {
      const std::size_t part = parts[k].second;
      if (level > 0)
        search(level - 1, part, p, squared_distance_to, best);
      else
        best = std::min(best, {squared_distance_to(order_[part]), order_[part]});
    }
  }

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_, leaf_of_;
  std::vector<bool> left_;
  std::uint32_t first_ = 0;               ///< or more
  std::vector<std::vector<Box>> levels_;  ///< the last one has one box
};

}  // namespace medial
