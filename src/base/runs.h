#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace medial {

/// Calls visit(begin, end) for each run [begin, end) of set bits in a row of words, from the left
/// to the right. Bits beyond `width` must be 0. O(words + runs).
template <class Visit>
void for_each_run(std::span<const std::uint64_t> row, std::int64_t width, const Visit& visit) {
  std::int64_t begin = -1;
  for (std::size_t w = 0; w < row.size(); ++w) {
    std::uint64_t changes = row[w] ^ (begin >= 0 ? ~std::uint64_t{0} : 0);
    while (changes != 0) {
      const int bit = std::countr_zero(changes);
      const std::int64_t x = static_cast<std::int64_t>(w) * 64 + bit;
      if (begin < 0) {
        begin = x;
      } else {
        visit(begin, x);
        begin = -1;
      }
      // From here on, search for the opposite value.
      changes = ~changes & (~std::uint64_t{0} << bit);
    }
  }
  if (begin >= 0) visit(begin, width);
}

/// Sets the bits first..last of a row of words.
inline void set_bits(std::span<std::uint64_t> row, std::uint32_t first, std::uint32_t last) {
  for (std::uint32_t w = first / 64; w <= last / 64; ++w) {
    std::uint64_t bits = ~std::uint64_t{0};
    if (w == first / 64) bits &= ~std::uint64_t{0} << (first % 64);
    if (w == last / 64) bits &= ~std::uint64_t{0} >> (63 - last % 64);
    row[w] |= bits;
  }
}

}  // namespace medial
