#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "medial/geometry.h"

namespace medial::edit {

/// Boxes in the order of their numbers, in a tree whose boxes can change: a change is passed up as
/// far as it matters, in O(log n). Neighbours in number should be neighbours in the plane.
class BoxLevels {
 public:
  std::size_t size() const { return levels_.empty() ? 0 : levels_[0].size(); }

  /// Sets a box, of an old number or of the next new one.
  void set(std::uint32_t number, const Box& box) {
    put(0, number, box);
    std::size_t i = number;
    for (std::size_t level = 0; levels_[level].size() > 1; ++level) {
      const std::vector<Box>& below = levels_[level];
      i /= fan_out;
      Box all = Box::nothing();
      for (std::size_t k = i * fan_out; k < std::min((i + 1) * fan_out, below.size()); ++k)
        all.add(below[k]);
      if (level + 1 < levels_.size() && i < levels_[level + 1].size() &&
          is_same(levels_[level + 1][i], all))
        return;
      put(level + 1, i, all);
    }
  }

  /// Calls visit(number) for each box that meets `query`.
  template <class Visit>
  void find(const Box& query, const Visit& visit) const {
    if (!levels_.empty()) find_below(levels_.size() - 1, 0, query, visit);
  }

 private:
  static constexpr std::size_t fan_out = 8;

  static bool meet(const Box& a, const Box& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
  }
  static bool is_same(const Box& a, const Box& b) { return a.low == b.low && a.high == b.high; }

  void put(std::size_t level, std::size_t i, const Box& box) {
    if (level == levels_.size()) levels_.emplace_back(1, box);
    if (i == levels_[level].size()) levels_[level].push_back(box);
    levels_[level][i] = box;
  }

  template <class Visit>
  void find_below(std::size_t level, std::size_t i, const Box& query, const Visit& visit) const {
    if (!meet(levels_[level][i], query)) return;
    if (level == 0) return visit(static_cast<std::uint32_t>(i));
    const std::size_t end = std::min((i + 1) * fan_out, levels_[level - 1].size());
    for (std::size_t k = i * fan_out; k < end; ++k) find_below(level - 1, k, query, visit);
  }

  std::vector<std::vector<Box>> levels_;  ///< from the boxes themselves up to one
};

}  // namespace medial::edit
