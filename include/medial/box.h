#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "medial/vec2.h"

namespace medial {

/// A rectangle along the axes.
struct Box {
  Vec2 low;
  Vec2 high;

  /// What holds nothing yet, to be added to.
  static constexpr Box nothing() {
    constexpr double endless = std::numeric_limits<double>::infinity();
    return {{endless, endless}, {-endless, -endless}};
  }
  bool is_nothing() const { return !(low.x <= high.x); }
  /// Grows to hold a point, or another box.
  void add(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  void add(const Box& box) {
    low = {std::min(low.x, box.low.x), std::min(low.y, box.low.y)};
    high = {std::max(high.x, box.high.x), std::max(high.y, box.high.y)};
  }
};

inline double diagonal(const Box& box) {
  return std::hypot(box.high.x - box.low.x, box.high.y - box.low.y);
}

}  // namespace medial
