#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/memory.h"

namespace medial {

/// The increasing numbers below `count` for which `holds` is true. Calls `holds` once per number,
/// on all threads, in blocks. Choose small blocks if `holds` is slow, so that few numbers still use
/// all threads.
template <std::size_t block = 1 << 12, class Holds>
WorkVector<std::uint32_t> numbers_where(std::size_t count, const Holds& holds) {
  using Block = std::array<std::uint32_t, block>;
  const auto find = [&](std::size_t begin, Block& some) {
    std::size_t size = 0;
    for (std::size_t k = begin; k < std::min(count, begin + block); ++k) {
      some[size] = static_cast<std::uint32_t>(k);
      size += holds(k) ? 1 : 0;  // without a branch to mispredict
    }
    return std::span(some).first(size);
  };
  WorkVector<std::uint32_t> all;
  if (count <= block) {  // no lists: they would slow down small shapes
    Block some;
    const auto numbers = find(0, some);
    all.assign(numbers.begin(), numbers.end());
    return all;
  }
  std::vector<std::vector<std::uint32_t>> found((count + block - 1) / block);
  parallel_for(found.size(), [&](std::size_t i) {
    Block some;
    const auto numbers = find(i * block, some);
    found[i].assign(numbers.begin(), numbers.end());
  });
  std::size_t size = 0;
  for (const auto& some : found) size += some.size();
  all.reserve(size);
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace medial
