#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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
  static double of_sum(double a, double b, double sum) { return std::abs(rest_of_sum(a, b, sum)); }
  static double of_product(double a, double b, double product) {
    const double off = std::abs(std::fma(a, b, -product));
    return std::abs(product) < tiny && a != 0 && b != 0 ? off + lost : off;
  }
  static double of_quotient(double a, double b, double quotient) {
    const double off = std::abs(std::fma(quotient, b, -a));
    if (off == 0 && (std::abs(a) >= tiny || a == 0)) return 0;
    return (off + lost) / std::abs(b) + std::numeric_limits<double>::min();
  }
  static double of_root(double a, double root) {
    const double off = std::abs(std::fma(root, root, -a));
    return off == 0 && a >= tiny ? 0 : (off + lost) / root;
  }
};

/// A real number known as `value`, off by at most `error` (infinite where nothing is known):
/// running error analysis. Its operations keep that true whatever they round. Requires round to
/// nearest, and numbers below 1e300 in size.
template <class Real>
struct Bounded;

/// What an operation rounds away is computed itself (Dekker, Knuth; fused multiply-add), so numbers
/// that double represents, such as those of an integer grid, keep the error 0, and a sum of them
/// that is zero is known to be zero.
template <>
struct Bounded<double> {
  double value = 0;
  double error = 0;

  Bounded() = default;
  /// Exact.
  explicit Bounded(double exact) : value(exact) {}
  Bounded(double approximate, double bound) : value(approximate), error(bound) {}

  /// -1, 0 or 1, where the bound decides.
  std::optional<int> sign() const {
    if (value > error) return 1;
    if (value < -error) return -1;
    if (value == 0 && error == 0) return 0;
    return std::nullopt;
  }
  bool positive() const { return value > error; }
  /// The largest size that the number can have, and the smallest.
  double most() const { return std::abs(value) + error; }
  double least() const { return std::max(0.0, std::abs(value) - error); }

  friend Bounded operator-(const Bounded& a) { return {-a.value, a.error}; }
  friend Bounded operator+(const Bounded& a, const Bounded& b) {
    const double sum = a.value + b.value;
    return widened(sum, a.error + b.error + Rounding::of_sum(a.value, b.value, sum));
  }
  friend Bounded operator-(const Bounded& a, const Bounded& b) { return a + (-b); }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    const double product = a.value * b.value;
    return widened(product, Rounding::of_product(a.value, b.value, product) +
                                (a.most() * b.error + std::abs(b.value) * a.error));
  }
  /// Nothing is known where the divisor may be zero.
  friend Bounded operator/(const Bounded& a, const Bounded& b) {
    const double divisor = b.least();
    if (!(divisor > 0)) return {0, std::numeric_limits<double>::infinity()};
    const double quotient = a.value / b.value;
    return widened(quotient, Rounding::of_quotient(a.value, b.value, quotient) +
                                 (a.error + std::abs(quotient) * b.error) / divisor);
  }
  /// The square root of a number that is not negative, though its bound may not tell.
  friend Bounded root_of(const Bounded& a) {
    if (!(a.value > a.error)) {
      const double above = a.value + a.error;
      if (above <= 0) return {};  // not where nothing is known
      const double half = std::sqrt(above) * Rounding::widen / 2;
      return {half, half};
    }
    const double root = std::sqrt(a.value);
    return widened(root, Rounding::of_root(a.value, root) + a.error / root);
  }

 private:
  static Bounded widened(double number, double off) { return {number, Rounding::widen * off}; }
};

}  // namespace medial
