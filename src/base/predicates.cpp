#include "base/predicates.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>

#include "base/bounded.h"
#include "base/whole.h"

// g++ 12 gives false warnings about limbs inside cpp_int when its moves are inlined here.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

namespace medial {
namespace {

int sign(double value) { return (value > 0) - (value < 0); }

/// Whether products of two such numbers and their error terms neither overflow nor underflow: an
/// error term is a multiple of 2^(2 (-480 - 52)) = 2^-1064, and a product is at most 2^960.
bool is_moderate(double value) {
  const double magnitude = std::abs(value);
  return magnitude == 0 || (magnitude >= 0x1p-480 && magnitude <= 0x1p480);
}

/// value + error, exactly.
struct Expansion2 {
  double value;
  double error;
};

Expansion2 exact_sum(double a, double b) {
  const double sum = a + b;
  return {sum, Rounding::rest_of_sum(a, b, sum)};
}

/// Requires moderate factors.
Expansion2 exact_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

using Integer = boost::multiprecision::cpp_int;

int orientation_in_integers(Vec2 a, Vec2 b, Vec2 c) {
  const std::array coordinates{a.x, a.y, b.x, b.y, c.x, c.y};
  const int lowest = binary_range(coordinates).lowest;
  std::array<Integer, 6> n;
  for (std::size_t i = 0; i < 6; ++i) n[i] = multiple_of<Integer>(coordinates[i], lowest);
  const Integer left = (n[0] - n[4]) * (n[3] - n[5]), right = (n[1] - n[5]) * (n[2] - n[4]);
  return left.compare(right);
}

template <class Number>
int in_circle_of(const std::array<Number, 6>& d) {
  const Number &ux = d[0], &uy = d[1], &vx = d[2], &vy = d[3], &wx = d[4], &wy = d[5];
  const Number sum = (ux * ux + uy * uy) * (vx * wy - wx * vy) +
                     (vx * vx + vy * vy) * (wx * uy - ux * wy) +
                     (wx * wx + wy * wy) * (ux * vy - vx * uy);
  return (sum > 0) - (sum < 0);
}

template <class Number>
int in_circle_in_integers(const std::array<double, 8>& coordinates, int lowest) {
  std::array<Number, 6> d;
  for (std::size_t i = 0; i < 6; ++i)
    d[i] = multiple_of<Number>(coordinates[i], lowest) -
           multiple_of<Number>(coordinates[6 + i % 2], lowest);
  return in_circle_of(d);
}

}  // namespace

int exact_in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
  const std::array<double, 8> coordinates{a.x, a.y, b.x, b.y, c.x, c.y, p.x, p.y};
  // On grids, the differences are exact and small multiples of one unit.
  std::array<double, 6> differences;
  bool exact = true;
  double largest = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const Expansion2 difference = exact_sum(coordinates[i], -coordinates[6 + i % 2]);
    exact = exact && difference.error == 0;
    differences[i] = difference.value;
    largest = std::max(largest, std::abs(difference.value));
  }
  if (exact && largest > 0x1p-900 && largest < 0x1p900) {
    // With 30 bits each, the sum is below 2^124.
    int exponent = 0;
    std::frexp(largest, &exponent);
    const double scale = std::ldexp(1.0, 30 - exponent);
#ifdef __SIZEOF_INT128__
    __extension__ using Wide = __int128;
#else
    using Wide = boost::multiprecision::int128_t;
#endif
    std::array<Wide, 6> units;
    bool whole = true;
    for (std::size_t i = 0; i < 6; ++i) {
      const double value = scale * differences[i];
      const auto integer = static_cast<std::int64_t>(value);
      whole = whole && static_cast<double>(integer) == value;
      units[i] = integer;
    }
    if (whole) return in_circle_of(units);
  }
  // In units of the lowest bit of all coordinates: of n bits each, the sum has at most 4 n + 8.
  const auto [lowest, highest] = binary_range(coordinates);
  if (highest - lowest <= 120)
    return in_circle_in_integers<boost::multiprecision::int512_t>(coordinates, lowest);
  return in_circle_in_integers<Integer>(coordinates, lowest);
}

int exact_orientation(Vec2 a, Vec2 b, Vec2 c) {
  // Both products are zero, the common case of points on a vertical or horizontal line.
  if ((a.x == c.x || b.y == c.y) && (a.y == c.y || b.x == c.x)) return 0;

  // The differences are often exact (always on integer grids): then compare the exact products. A
  // product's value is its rounding, which is monotone, so different values decide.
  const Expansion2 ax = exact_sum(a.x, -c.x);
  const Expansion2 ay = exact_sum(a.y, -c.y);
  const Expansion2 bx = exact_sum(b.x, -c.x);
  const Expansion2 by = exact_sum(b.y, -c.y);
  if (ax.error == 0 && ay.error == 0 && bx.error == 0 && by.error == 0 && is_moderate(ax.value) &&
      is_moderate(ay.value) && is_moderate(bx.value) && is_moderate(by.value)) {
    const Expansion2 left = exact_product(ax.value, by.value);
    const Expansion2 right = exact_product(ay.value, bx.value);
    if (left.value != right.value) return left.value > right.value ? 1 : -1;
    return sign(left.error - right.error);
  }

  const int compared = orientation_in_integers(a, b, c);
  return (compared > 0) - (compared < 0);
}

}  // namespace medial
