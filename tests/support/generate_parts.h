#pragma once

// Shared by the generators of shapes.

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "support/generate.h"

namespace medial::test {

inline constexpr double two_pi = 2 * std::numbers::pi;

inline Vec2 polar(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

inline Vec2 turned(Vec2 p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

template <class T>
void shuffle(Random& random, std::vector<T>& items) {
  for (std::size_t i = items.size(); i > 1; --i) {
    const auto j = static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(i) - 1));
    std::swap(items[i - 1], items[j]);
  }
}

}  // namespace medial::test
