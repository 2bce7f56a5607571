#pragma once

// Finite doubles as integer multiples of one power of two, for exact integer arithmetic.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace medial {

/// All numbers are multiples of 2^lowest, and their absolute values are less than 2^highest.
struct BinaryRange {
  int lowest = 2000, highest = -2000;
};

inline BinaryRange binary_range(std::span<const double> numbers) {
  BinaryRange range;
  for (const double number : numbers) {
    if (number == 0) continue;
    int exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(number, &exponent), 53));
    const int trailing = __builtin_ctzll(static_cast<unsigned long long>(mantissa));
    range.lowest = std::min(range.lowest, exponent - 53 + trailing);
    range.highest = std::max(range.highest, exponent);
  }
  return range;
}

/// number / 2^lowest. Requires a whole number.
template <class Integer>
Integer multiple_of(double number, int lowest) {
  if (number == 0) return Integer(0);
  int exponent = 0;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(number, &exponent), 53));
  int shift = exponent - 53 - lowest;
  for (; shift < 0; ++shift) mantissa /= 2;  // the last bits are 0
  Integer result(mantissa);
  result <<= static_cast<unsigned>(shift);
  return result;
}

}  // namespace medial
