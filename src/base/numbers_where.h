#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/memory.h"

namespace medial {

/// The numbers below `count` for which `holds` is true, increasing. It is asked once for each, on
/// all threads, in blocks: small ones where it is slow, so that few numbers still use all of them.
template <std::size_t block = 1 << 12, class Holds>
WorkVector<std::uint32_t> numbers_where(std::size_t count, const Holds& holds) {
  std::vector<std::vector<std::uint32_t>> found((count + block - 1) / block);
  parallel_for(found.size(), [&](std::size_t i) {
    std::array<std::uint32_t, block> some;
    std::size_t size = 0;
    for (std::size_t k = i * block; k < std::min(count, (i + 1) * block); ++k) {
      some[size] = static_cast<std::uint32_t>(k);
      size += holds(k) ? 1 : 0;  // without a branch that could be guessed wrong
    }
    found[i].assign(some.begin(), some.begin() + static_cast<std::ptrdiff_t>(size));
  });
  std::size_t size = 0;
  for (const auto& some : found) size += some.size();
  WorkVector<std::uint32_t> all;
  all.reserve(size);
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace medial
