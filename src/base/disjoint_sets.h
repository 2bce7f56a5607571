#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace medial {

/// Disjoint sets of numbers from 0, each named by its lowest number.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) {
    while (parent_.size() < count) add();
  }
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace medial
