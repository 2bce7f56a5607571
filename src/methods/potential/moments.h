#pragma once

#include <array>
#include <cstddef>

#include "medial/geometry.h"

namespace medial::potential {

/// The product of two complex numbers.
constexpr Vec2 product(Vec2 a, Vec2 b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
constexpr Vec2 conjugate(Vec2 a) { return {a.x, -a.y}; }

/// Moments of a set of charges about a point, as complex numbers: with w from the point to a
/// charge, the sums of w^j conj(w)^k for j + k up to the degree. They are independent of the order
/// of the force.
class Moments {
 public:
  static constexpr std::size_t degree = 12;
  /// The index of the first moment for each difference of j and k.
  static constexpr auto row = [] {
    std::array<std::size_t, degree + 2> begins{};
    for (std::size_t more = 0; more <= degree; ++more)
      begins[more + 1] = begins[more] + (degree - more) / 2 + 1;
    return begins;
  }();
  static constexpr std::size_t count = row.back();

  /// The moment with j = k + more; exchanging j and k conjugates it. Requires more + 2 k <= degree.
  Vec2 operator()(std::size_t more, std::size_t k) const { return values_[row[more] + k]; }

  /// Adds a charged segment, from `start` along its unit tangent.
  void add(Vec2 start, Vec2 tangent, double length);
  /// Adds charges whose moments are known about a point at the distance `shift`.
  void add(const Moments& other, Vec2 shift);

 private:
  std::array<Vec2, count> values_{};
};

}  // namespace medial::potential
