#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "medial/compute.h"

namespace medial::io {

/// Groups the edges of an axis in parts so that each branch comes whole: the others wait.
class WholeBranches {
 public:
  void add(const AxisPart& part);
  /// Whether enough is new to look for whole branches: as much again as waits, so that none is
  /// looked at more often than O(log n) times.
  bool is_full() const;
  /// Hands out the branches that are whole, with a node of its own at each end of each, `nodes` as
  /// numbers in the whole axis.
  AxisPart take();

 private:
  static constexpr std::size_t least_edges = std::size_t{1} << 15;

  std::vector<bool> waiting_edges() const;

  AxisPart open_;
  /// The nodes between two edges one of which is still to come, by their numbers in the whole axis.
  std::unordered_map<std::uint32_t, std::uint32_t> half_met_;
  std::size_t waiting_ = 0;  ///< edges that the last take() has left
};

}  // namespace medial::io
