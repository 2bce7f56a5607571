#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "medial/geometry.h"

namespace medial::edit {

/// A tree of boxes whose boxes can change. A change updates the ancestors that it affects, in O(log
/// n). The boxes are stored by number; consecutive numbers should be close in the plane.
class BoxLevels {
 public:
  std::size_t size() const { return levels_.empty() ? 0 : levels_[0].size(); }

  /// The box of all boxes.
  Box all() const { return levels_.empty() ? Box::nothing() : levels_.back()[0]; }

  /// Sets the box of an existing number, or of the next new one.
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

  /// The number of the element nearest to a point and nearer than a limit. `squared(number)`
  /// returns its squared distance.
  template <class Squared>
  std::uint32_t nearest(Vec2 p, const Squared& squared, double limit = endless) const {
    Nearest best{none, limit};
    if (!levels_.empty()) nearest_below(levels_.size() - 1, 0, p, squared, best);
    return best.number;
  }

 private:
  static constexpr std::size_t fan_out = 8;
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  static constexpr double endless = std::numeric_limits<double>::infinity();
  struct Nearest {
    std::uint32_t number;
    double squared;
  };

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

  static double squared_distance(const Box& box, Vec2 p) {
    const double x = std::max({box.low.x - p.x, p.x - box.high.x, 0.0});
    const double y = std::max({box.low.y - p.y, p.y - box.high.y, 0.0});
    return x * x + y * y;
  }
  template <class Squared>
  void nearest_below(std::size_t level, std::size_t i, Vec2 p, const Squared& squared,
                     Nearest& best) const {
    if (level == 0) {
      const auto number = static_cast<std::uint32_t>(i);
      const double away = squared(number);
      if (away < best.squared) best = {number, away};
      return;
    }
    const std::vector<Box>& below = levels_[level - 1];
    std::array<std::pair<double, std::size_t>, fan_out> order;  // by increasing distance
    std::size_t count = 0;
    for (std::size_t k = i * fan_out; k < std::min((i + 1) * fan_out, below.size()); ++k) {
      if (below[k].is_nothing()) continue;
      const double away = squared_distance(below[k], p);
      std::size_t place = count++;
      for (; place > 0 && order[place - 1].first > away; --place) order[place] = order[place - 1];
      order[place] = {away, k};
    }
    for (std::size_t k = 0; k < count && order[k].first < best.squared; ++k)
      nearest_below(level - 1, order[k].second, p, squared, best);
  }

  std::vector<std::vector<Box>> levels_;  ///< from the boxes themselves up to the root
};

}  // namespace medial::edit
