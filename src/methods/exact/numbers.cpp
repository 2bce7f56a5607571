#include "methods/exact/numbers.h"

#include <algorithm>
#include <span>
#include <utility>

namespace medial::exact {
namespace {

using Factors = std::vector<Rational>;
using View = std::span<const Rational>;

bool is_zero(const Rational& value) { return value.is_zero(); }

/// Half as many factors, as long as the last root is not needed.
void trim(Factors& factors) {
  while (factors.size() > 1 &&
         std::all_of(factors.begin() + static_cast<std::ptrdiff_t>(factors.size() / 2),
                     factors.end(), is_zero))
    factors.resize(factors.size() / 2);
  if (factors.size() == 1 && is_zero(factors[0])) factors.clear();
}

Factors sum(View a, View b, bool subtract) {
  Factors result(a.begin(), a.end());
  if (result.size() < b.size()) result.resize(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (subtract)
      result[i] -= b[i];
    else
      result[i] += b[i];
  }
  return result;
}

/// The index of the last root of a number with this many factors, which is not rational.
std::size_t last_root(std::size_t factors) {
  std::size_t root = 0;
  while ((std::size_t{2} << root) < factors) ++root;
  return root;
}

Factors product(const RootField* field, View a, View b) {
  if (a.empty() || b.empty()) return {};
  if (a.size() < b.size()) std::swap(a, b);
  if (a.size() == 1) return {a[0] * b[0]};
  const std::size_t half = a.size() / 2;
  const View a0 = a.first(half), a1 = a.subspan(half);
  Factors low, high;
  if (b.size() <= half) {
    low = product(field, a0, b);
    high = product(field, a1, b);
  } else {
    const View b0 = b.first(half), b1 = b.subspan(half);
    Factors both = product(field, a1, b1);
    const Rational& radicand = field->radicand(last_root(a.size()));
    for (Rational& factor : both) factor *= radicand;
    low = sum(product(field, a0, b0), both, false);
    high = sum(product(field, a0, b1), product(field, a1, b0), false);
  }
  low.resize(half);
  high.resize(half);
  low.insert(low.end(), std::make_move_iterator(high.begin()), std::make_move_iterator(high.end()));
  return low;
}

Bounded<Precise> bounded_rational(const Rational& value) {
  const Bounded<Precise> near{Precise(value)};
  return {near.value, near.most() * Bounded<Precise>::unit};
}

Bounded<Precise> bounded_number(const RootField* field, View factors) {
  if (factors.empty()) return {};
  if (factors.size() == 1) return bounded_rational(factors[0]);
  const std::size_t half = factors.size() / 2;
  return bounded_number(field, factors.first(half)) +
         field->approximate_root(last_root(factors.size())) *
             bounded_number(field, factors.subspan(half));
}

int sign_of(const RootField* field, Factors factors);

/// The sign of a + b sqrt(square), from the signs of numbers without that root.
template <class Square>
int combined_sign(int a, int b, const Square& sign_of_difference) {
  if (a == 0 || b == 0 || a == b) return a != 0 ? a : b;
  return a * sign_of_difference();  // of a^2 - b^2 square
}

int sign_of(const RootField* field, Factors factors) {
  trim(factors);
  if (factors.empty()) return 0;
  if (factors.size() == 1) return factors[0].sign();
  if (const auto sign = bounded_number(field, factors).sign()) return *sign;
  const std::size_t half = factors.size() / 2;
  const View a = View(factors).first(half), b = View(factors).subspan(half);
  return combined_sign(sign_of(field, {a.begin(), a.end()}), sign_of(field, {b.begin(), b.end()}),
                       [&] {
                         Factors squared = product(field, b, b);
                         for (Rational& factor : squared)
                           factor *= field->radicand(last_root(factors.size()));
                         return sign_of(field, sum(product(field, a, a), squared, true));
                       });
}

/// The square root of a whole number that is the square of one. A square that is odd but for powers
/// of four is one more than a multiple of eight.
bool whole_root(const Integer& square, Integer& root) {
  if (square.is_zero()) return true;
  const auto twos = lsb(square);
  if (twos % 2 != 0 || Integer(square >> twos) % 8 != 1) return false;
  Integer rest;
  root = sqrt(square, rest);
  return rest.is_zero();
}

/// The square root of a rational number that is the square of one.
bool rational_root(const Rational& square, Rational& root) {
  Integer top, bottom;
  if (!whole_root(numerator(square), top) || !whole_root(denominator(square), bottom)) return false;
  root = Rational(top, bottom);
  return true;
}

}  // namespace

RootNumber::RootNumber(const RootField* field, std::vector<Rational> factors)
    : field_(field), factors_(std::move(factors)) {
  trim(factors_);
}

RootNumber operator+(const RootNumber& a, const RootNumber& b) {
  return {a.field_ != nullptr ? a.field_ : b.field_, sum(a.factors_, b.factors_, false)};
}

RootNumber operator-(const RootNumber& a, const RootNumber& b) {
  return {a.field_ != nullptr ? a.field_ : b.field_, sum(a.factors_, b.factors_, true)};
}

RootNumber operator-(const RootNumber& a) { return RootNumber() - a; }

RootNumber operator*(const RootNumber& a, const RootNumber& b) {
  const RootField* field = a.field_ != nullptr ? a.field_ : b.field_;
  return {field, product(field, a.factors_, b.factors_)};
}

int RootNumber::sign() const { return sign_of(field_, factors_); }

Bounded<Precise> RootNumber::bounded() const { return bounded_number(field_, factors_); }

RootNumber RootField::root(const RootNumber& rational) {
  if (rational.factors_.empty()) return {};
  const Rational& square = rational.factors_[0];
  Rational found;
  if (rational_root(square, found)) return RootNumber(std::move(found));
  for (std::size_t i = 0; i < radicands_.size(); ++i) {
    if (!rational_root(square / radicands_[i], found)) continue;
    std::vector<Rational> factors(std::size_t{2} << i);
    factors[std::size_t{1} << i] = std::move(found);
    return {this, std::move(factors)};
  }
  radicands_.push_back(square);
  roots_.push_back(root_of(bounded_rational(square)));
  const std::size_t last = radicands_.size() - 1;
  std::vector<Rational> factors(std::size_t{2} << last);
  factors[std::size_t{1} << last] = 1;
  return {this, std::move(factors)};
}

int sign_with_root(const RootNumber& a, const RootNumber& b, const RootNumber& square) {
  const Bounded<Precise> near = a.bounded() + b.bounded() * root_of(square.bounded());
  if (const auto sign = near.sign(); sign && *sign != 0) return *sign;
  return combined_sign(a.sign(), square.sign() == 0 ? 0 : b.sign(),
                       [&] { return (a * a - b * b * square).sign(); });
}

}  // namespace medial::exact
