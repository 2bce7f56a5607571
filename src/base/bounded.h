#pragma once

namespace medial {

/// Bounds for the rounding error of one operation in double.
struct Rounding {
  /// Error bounds are sums and products of positive numbers with less than sixteen roundings each.
  static constexpr double widen = 1 + 0x1p-48;
  /// Below `tiny`, a fused multiply-add does not give the exact error of a product.
  static constexpr double tiny = 0x1p-900, lost = 0x1p-1000;

  /// The exact rounding error of a sum (Knuth).
  static double rest_of_sum(double a, double b, double sum) {
    const double b_part = sum - a, a_part = sum - b_part;
    return (a - a_part) + (b - b_part);
  }
};

/// A real number within `error` of `value` (infinite if nothing is known), for running error
/// analysis: every operation bounds its own rounding. sign() is -1, 0 or 1 if the bound decides.
/// most() and least() bound the number's absolute value. root_of() requires a number that is not
/// negative, even if its bound does not show that. Requires round to nearest, and absolute values
/// below 1e300.
template <class Real>
struct Bounded;

}  // namespace medial
