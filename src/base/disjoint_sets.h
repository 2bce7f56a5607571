#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "base/memory.h"

namespace medial {

/// Disjoint sets of numbers from 0, each named by its lowest number.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size = 0) : parent_(size), count_(size) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  /// The number of sets.
  std::size_t count() const { return count_; }
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    ++count_;
    return parent_.back();
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Joins two sets. Returns whether they were different.
  bool join(std::uint32_t i, std::uint32_t j) {
    if (!join_uncounted(i, j)) return false;
    --count_;
    return true;
  }
  /// The same without updating count(), for threads that join disjoint ranges of numbers.
  bool join_uncounted(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    if (i == j) return false;
    parent_[std::max(i, j)] = std::min(i, j);
    return true;
  }

 private:
  WorkVector<std::uint32_t> parent_;
  std::size_t count_;
};

}  // namespace medial
