#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace medial {

/// A real number known as `value`, off by at most `error` (infinite where nothing is known):
/// running error analysis. The operations below keep that true whatever they round. In double, what
/// an operation rounds away is computed itself (Dekker, Knuth; fused multiply-add), so numbers that
/// double represents, such as those of an integer grid, keep the error 0, and a sum of them that is
/// zero is known to be zero. Requires round to nearest, and numbers below 1e300 in size.
template <class Real>
struct Bounded {
  using Size = Real;  ///< of bounds
  Real value{0};
  Real error{0};

  Bounded() = default;
  /// Exact.
  explicit Bounded(double exact) : value(exact) {}
  Bounded(Real approximate, Real bound) : value(std::move(approximate)), error(std::move(bound)) {}

  /// -1, 0 or 1, where the bound decides.
  std::optional<int> sign() const {
    if (value > error) return 1;
    if (value < -error) return -1;
    if (value == 0 && error == 0) return 0;
    return std::nullopt;
  }
  bool positive() const { return value > error; }
  /// The largest size that the number can have, and the smallest.
  Real most() const { return abs_of(value) + error; }
  Real least() const { return std::max(Real(0), Real(abs_of(value) - error)); }

  static Real abs_of(const Real& x) { return x < 0 ? Real(-x) : x; }
};

/// How an arithmetic rounds: bounds for what is lost by one operation.
template <class Real>
struct Rounding;

template <>
struct Rounding<double> {
  /// Errors are sums and products of positive numbers with less than sixteen roundings each.
  static constexpr double widen = 1 + 0x1p-48;
  /// Below this, products lose what fused multiply-add cannot tell.
  static constexpr double tiny = 0x1p-900, lost = 0x1p-1000;

  static double of_sum(double a, double b, double sum) {
    const double b_part = sum - a, a_part = sum - b_part;
    return std::abs((a - a_part) + (b - b_part));
  }
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

template <class Real>
Bounded<Real> operator-(const Bounded<Real>& a) {
  return {Real(-a.value), a.error};
}

template <class Real>
Bounded<Real> operator+(const Bounded<Real>& a, const Bounded<Real>& b) {
  Real sum = a.value + b.value;
  Real error = a.error + b.error + Rounding<Real>::of_sum(a.value, b.value, sum);
  error *= Rounding<Real>::widen;
  return {std::move(sum), std::move(error)};
}

template <class Real>
Bounded<Real> operator-(const Bounded<Real>& a, const Bounded<Real>& b) {
  return a + (-b);
}

template <class Real>
Bounded<Real> operator*(const Bounded<Real>& a, const Bounded<Real>& b) {
  Real product = a.value * b.value;
  Real error = Rounding<Real>::of_product(a.value, b.value, product);
  error += a.most() * b.error + Bounded<Real>::abs_of(b.value) * a.error;
  error *= Rounding<Real>::widen;
  return {std::move(product), std::move(error)};
}

/// Nothing is known where the divisor may be zero.
template <class Real>
Bounded<Real> operator/(const Bounded<Real>& a, const Bounded<Real>& b) {
  const Real divisor = b.least();
  if (!(divisor > 0)) return {Real(0), Real(std::numeric_limits<double>::infinity())};
  Real quotient = a.value / b.value;
  Real error = Rounding<Real>::of_quotient(a.value, b.value, quotient);
  error += (a.error + Bounded<Real>::abs_of(quotient) * b.error) / divisor;
  error *= Rounding<Real>::widen;
  return {std::move(quotient), std::move(error)};
}

/// The square root of a number that is not negative, though its bound may not tell.
template <class Real>
Bounded<Real> root_of(const Bounded<Real>& a) {
  using std::sqrt;
  if (!(a.value > a.error)) {
    const Real above = a.value + a.error;
    if (above <= 0) return {};  // not where nothing is known
    Real half = sqrt(above) * Rounding<Real>::widen / 2;
    return {half, half};
  }
  Real root = sqrt(a.value);
  Real error = Rounding<Real>::of_root(a.value, root);
  error += a.error / root;
  error *= Rounding<Real>::widen;
  return {std::move(root), std::move(error)};
}

}  // namespace medial
