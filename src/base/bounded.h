#pragma once

namespace medial {

/// How double rounds: bounds for what is lost by one operation.
struct Rounding {
  /// Errors are sums and products of positive numbers with less than sixteen roundings each.
  static constexpr double widen = 1 + 0x1p-48;
  /// Below this, products lose what fused multiply-add cannot tell.
  static constexpr double tiny = 0x1p-900, lost = 0x1p-1000;

  /// What a sum leaves over, exactly (Knuth).
  static double rest_of_sum(double a, double b, double sum) {
    const double b_part = sum - a, a_part = sum - b_part;
    return (a - a_part) + (b - b_part);
  }
};

/// A real number known as `value`, off by at most `error` (infinite where nothing is known):
/// running error analysis. Its operations keep that true whatever they round; its sign() is -1, 0
/// or 1 where the bound decides, most() and least() are the largest and the smallest size that the
/// number can have, and root_of() is the root of one that is not negative, though its bound may not
/// tell. Requires round to nearest, and numbers below 1e300 in size.
template <class Real>
struct Bounded;

}  // namespace medial
