#pragma once

// The numbers of exact decisions: Bounded<Twofold>, Bounded<Precise>, Bounded<Wide> and rational
// ones.

#ifdef MEDIAL_WITHOUT_GMP
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#else
#include <boost/multiprecision/gmp.hpp>
#include <boost/multiprecision/mpfr.hpp>
#endif
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "base/twofold.h"

namespace medial {

namespace exact {

// Of GMP and MPFR where there are these libraries, which are faster; otherwise of Boost's headers.
// Both compute the same, on the stack.
#ifdef MEDIAL_WITHOUT_GMP
using Rational = boost::multiprecision::cpp_rational;
template <unsigned digits>
using Backend = boost::multiprecision::cpp_bin_float<digits>;
#else
using Rational = boost::multiprecision::mpq_rational;
template <unsigned digits>
using Backend =
    boost::multiprecision::mpfr_float_backend<digits, boost::multiprecision::allocate_stack>;
#endif
template <unsigned digits>
using Float = boost::multiprecision::number<Backend<digits>, boost::multiprecision::et_off>;
/// At least 256 bits.
using Precise = Float<78>;
/// At least 2,304 bits: beside 1, the product of two lengths of 2^-1074 with 156 bits of it.
using Wide = Float<694>;

// Operators copy their results, which takes as long as a sum.
#ifdef MEDIAL_WITHOUT_GMP
template <class Real>
void add(const Real& a, const Real& b, Real& sum) {
  sum = a + b;
}
template <class Real>
void subtract(const Real& a, const Real& b, Real& rest) {
  rest = a - b;
}
template <class Real>
void multiply(const Real& a, const Real& b, Real& product) {
  product = a * b;
}
#else
template <class Real>
void add(const Real& a, const Real& b, Real& sum) {
  mpfr_add(sum.backend().data(), a.backend().data(), b.backend().data(), MPFR_RNDN);
}
template <class Real>
void subtract(const Real& a, const Real& b, Real& rest) {
  mpfr_sub(rest.backend().data(), a.backend().data(), b.backend().data(), MPFR_RNDN);
}
template <class Real>
void multiply(const Real& a, const Real& b, Real& product) {
  mpfr_mul(product.backend().data(), a.backend().data(), b.backend().data(), MPFR_RNDN);
}
#endif

}  // namespace exact

/// As for Twofold, but the bounds are rough and quick: with 256 bits there is room.
template <unsigned digits>
struct Bounded<exact::Float<digits>> {
  using Real = exact::Float<digits>;
  using Size = long double;  // its exponents have room for products of many small coordinates
  Real value{0};
  Size error = 0;

  Bounded() = default;
  explicit Bounded(double exact) : value(exact) {}
  explicit Bounded(Real exact) : value(std::move(exact)) {}
  Bounded(Real approximate, Size bound) : value(std::move(approximate)), error(bound) {}

  std::optional<int> sign() const {
    if (magnitude() > widen * error) return value > 0 ? 1 : -1;
    if (error == 0 && value == 0) return 0;
    return std::nullopt;
  }
  bool positive() const { return sign() == 1; }
  Size most() const { return widen * (magnitude() + error); }
  Size least() const { return std::max<Size>(0, magnitude() / widen - error); }

  /// Every operation is correctly rounded to three bits more at least.
  static constexpr Size unit = digits == 78 ? 0x1p-256L : 0x1p-2302L;
  /// Bounds are sums and products of positive numbers with a few roundings each.
  static constexpr Size widen = 1 + 0x1p-48L;

  friend Bounded operator-(const Bounded& a) {
    Bounded result = a;
    result.value.backend().negate();
    return result;
  }
  friend Bounded operator+(const Bounded& a, const Bounded& b) {
    Bounded result{Unset{}};
    exact::add(a.value, b.value, result.value);
    result.round(a.error + b.error);
    return result;
  }
  friend Bounded operator-(const Bounded& a, const Bounded& b) {
    Bounded result{Unset{}};
    exact::subtract(a.value, b.value, result.value);
    result.round(a.error + b.error);
    return result;
  }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    const auto of = [](const Bounded& one, Size off) { return off == 0 ? 0 : one.most() * off; };
    Bounded result{Unset{}};
    exact::multiply(a.value, b.value, result.value);
    result.round(of(a, b.error) + of(b, a.error));
    return result;
  }
  friend Bounded operator/(const Bounded& a, const Bounded& b) {
    const Size divisor = b.least();
    if (!(divisor > 0)) return {Real(0), std::numeric_limits<Size>::infinity()};
    const Size size = a.most() / divisor;  // a quotient's error grows by its size
    return rounded(a.value / b.value, (a.error + size * b.error) / divisor);
  }
  friend Bounded root_of(const Bounded& a) {
    if (a.value == 0 && a.error == 0) return {};
    if (!(a.least() > 0)) {
      const Size half = std::sqrt(std::max<Size>(a.most(), 0)) / 2;
      return {Real(half), widen * half};
    }
    return rounded(sqrt(a.value), a.error / std::sqrt(a.least()));
  }

 private:
  struct Unset {};
  explicit Bounded(Unset) : value() {}

  /// A result that is off by `before` before it is rounded.
  void round(Size before) { error = widen * (before + unit * magnitude()); }
  static Bounded rounded(Real value, Size error) {
    Bounded result(std::move(value), 0);
    result.round(error);
    return result;
  }
  /// Off by two roundings at most, for which `widen` has room.
  Size magnitude() const {
#ifdef MEDIAL_WITHOUT_GMP
    return std::abs(static_cast<Size>(value));
#else
    // mpfr_get_ld() takes ten times as long, for 0, too.
    const mpfr_srcptr number = value.backend().data();
    if (mpfr_zero_p(number) != 0) return 0;
    if (mpfr_regular_p(number) == 0) return std::abs(static_cast<Size>(value));
    constexpr int bits = std::numeric_limits<mp_limb_t>::digits;
    const auto* limbs = static_cast<const mp_limb_t*>(mpfr_custom_get_significand(number));
    const auto count = (mpfr_get_prec(number) + bits - 1) / bits;
    const auto exponent = static_cast<int>(mpfr_custom_get_exp(number));
    // x87's format is a limb with a leading one and an exponent; std::ldexp() takes ten times as
    // long as to put them together.
    constexpr bool is_x87 = std::numeric_limits<Size>::digits == 64 && bits == 64;
    if constexpr (is_x87) {
      constexpr int bias = 16382, largest = 32767;
      if (exponent > -bias && exponent < largest - bias) {
        const std::uint64_t leading = limbs[count - 1];
        const auto biased = static_cast<std::uint16_t>(exponent + bias);
        Size size = 0;
        std::memcpy(&size, &leading, sizeof leading);
        std::memcpy(reinterpret_cast<char*>(&size) + sizeof leading, &biased, sizeof biased);
        return size;
      }
    }
    constexpr Size limb = bits == 64 ? 0x1p64L : 0x1p32L;
    const Size leading =
        static_cast<Size>(limbs[count - 1]) * limb + static_cast<Size>(limbs[count - 2]);
    return std::ldexp(leading, exponent - 2 * bits);
#endif
  }
};

namespace exact {

/// The same number with fewer digits.
template <class Real>
Bounded<Twofold> twofold_of(const Bounded<Real>& number) {
  const auto high = static_cast<double>(number.value);
  const auto low = static_cast<double>(Real(number.value - high));
  const auto error = static_cast<double>(number.error) + 0x1p-104 * std::abs(high);
  return {Twofold(high) + Twofold(low), (1 + 0x1p-48) * error + Rounding::lost};
}

}  // namespace exact
}  // namespace medial
