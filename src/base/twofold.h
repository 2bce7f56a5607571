#pragma once

// Double-double numbers with error bounds. They make most of the decisions that double cannot make,
// in a tenth of the time of 256 bits.

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/bounded.h"

namespace medial {

/// The unevaluated sum of two doubles, `high` and `low`, where `high` is the double nearest to the
/// sum: at least 106 bits, identical on every platform. Requires round to nearest, like Bounded.
///
/// *Lemma.* The error of an operation is at most the value that it writes to `lost`, up to a factor
/// `widen`. *Proof.* A sum of two doubles equals its rounding plus an error term that is a double,
/// and so does a product (Knuth, Dekker); therefore `split()` is exact. A sum has only two further
/// roundings: those of `lows` and of `rest`, each at most 2^-53 of its result, and none if one of
/// the two summands is zero. A product also rounds `first`, `second` and `cross`, and omits low
/// times low; a product of two doubles is exact. If a product is so small that its error term, or
/// one of the terms, is not a normal number, 2^-1000 exceeds all of these errors. ∎
struct Twofold {
  double high = 0, low = 0;

  Twofold() = default;
  Twofold(double exact) : high(exact) {}  // NOLINT(google-explicit-constructor)
  explicit operator double() const { return high; }
  auto operator<=>(const Twofold&) const = default;

  static Twofold sum(const Twofold& a, const Twofold& b, double& lost) {
    const double whole = a.high + b.high, lows = a.low + b.low;
    const double of_whole = Rounding::rest_of_sum(a.high, b.high, whole), rest = of_whole + lows;
    lost = a.low != 0 && b.low != 0 ? unit * std::abs(lows) : 0;
    if (of_whole != 0 && lows != 0) lost += unit * std::abs(rest);
    return split(whole, rest);
  }
  static Twofold product(const Twofold& a, const Twofold& b, double& lost) {
    const double whole = a.high * b.high;
    double rest = std::fma(a.high, b.high, -whole);
    const bool is_tiny = std::abs(whole) < Rounding::tiny && a.high != 0 && b.high != 0;
    lost = is_tiny ? Rounding::lost : 0;
    if (a.low != 0 || b.low != 0) {
      const double first = a.high * b.low, second = a.low * b.high, cross = first + second;
      rest += cross;
      lost += unit * (std::abs(first) + std::abs(second) + std::abs(rest)) +
              std::abs(a.low * b.low) + Rounding::lost;
    }
    return split(whole, rest);
  }

  friend Twofold operator-(const Twofold& a) { return {-a.high, -a.low}; }
  friend Twofold operator+(const Twofold& a, const Twofold& b) {
    double lost;
    return sum(a, b, lost);
  }
  friend Twofold operator-(const Twofold& a, const Twofold& b) { return a + -b; }
  friend Twofold operator*(const Twofold& a, const Twofold& b) {
    double lost;
    return product(a, b, lost);
  }
  /// A long division of two digits; the root takes one Newton step from the root in double.
  friend Twofold operator/(const Twofold& a, const Twofold& b) {
    const double first = a.high / b.high;
    return split(first, (a - Twofold(first) * b).high / b.high);
  }
  friend Twofold sqrt(const Twofold& a) {
    const double first = std::sqrt(a.high);
    if (!(first > 0)) return first;
    return split(first, (a - Twofold(first) * Twofold(first)).high / (2 * first));
  }
  Twofold& operator+=(const Twofold& other) { return *this = *this + other; }
  Twofold& operator/=(const Twofold& other) { return *this = *this / other; }

 private:
  Twofold(double high_part, double low_part) : high(high_part), low(low_part) {}

  /// Two roundings to nearest.
  static constexpr double unit = 0x1p-52;

  static Twofold split(double whole, double rest) {
    const double high = whole + rest;
    return {high, Rounding::rest_of_sum(whole, rest, high)};
  }
};

/// The error of a quotient and of a root follows from the remainder: a / b - q is (a - q b) / b,
/// and the root of a differs from w by (a - w w) / (root + w).
template <>
struct Bounded<Twofold> {
  Twofold value;
  double error = 0;

  Bounded() = default;
  explicit Bounded(double exact) : value(exact) {}
  Bounded(const Twofold& approximate, double bound) : value(approximate), error(bound) {}

  /// The number of signs on this thread that the bound could not decide. If it has not changed
  /// during a computation, all signs of that computation were certain.
  static inline constinit thread_local std::uint64_t open_signs = 0;

  std::optional<int> sign() const {
    if (std::abs(value.high) > widen * error) return value.high > 0 ? 1 : -1;
    if (value.high == 0 && error == 0) return 0;
    ++open_signs;
    return std::nullopt;
  }
  bool positive() const { return sign() == 1; }
  double most() const { return widen * (std::abs(value.high) + error); }
  double least() const { return std::max(0.0, std::abs(value.high) / widen - error); }

  friend Bounded operator-(const Bounded& a) { return {-a.value, a.error}; }
  friend Bounded operator+(const Bounded& a, const Bounded& b) {
    double lost;
    const Twofold sum = Twofold::sum(a.value, b.value, lost);
    return {sum, widen * (a.error + b.error + lost)};
  }
  friend Bounded operator-(const Bounded& a, const Bounded& b) { return a + -b; }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    double lost;
    const Twofold product = Twofold::product(a.value, b.value, lost);
    const double of_errors =
        (std::abs(a.value.high) + a.error) * b.error + std::abs(b.value.high) * a.error;
    return {product, widen * (of_errors + lost)};
  }
  friend Bounded operator/(const Bounded& a, const Bounded& b) {
    const double divisor = b.least();
    if (!(divisor > 0)) return {0.0, std::numeric_limits<double>::infinity()};
    const Twofold quotient = a.value / b.value;
    const Bounded over = Bounded(a.value, 0) - Bounded(quotient, 0) * Bounded(b.value, 0);
    return {quotient,
            widen * (over.most() + a.error + std::abs(quotient.high) * b.error) / divisor};
  }
  friend Bounded root_of(const Bounded& a) {
    if (!(a.least() > 0)) {
      const double half = std::sqrt(std::max(a.most(), 0.0)) / 2;
      return {half, widen * half};
    }
    const Twofold root = sqrt(a.value);
    const Bounded over = Bounded(a.value, 0) - Bounded(root, 0) * Bounded(root, 0);
    return {root, widen * (over.most() + a.error) / root.high};
  }

 private:
  /// Error bounds are sums and products of positive numbers with less than sixteen roundings each.
  /// The numbers differ from their high parts by at most 2^-53 of these.
  static constexpr double widen = Rounding::widen;
};

}  // namespace medial
