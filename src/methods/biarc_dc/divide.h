#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "methods/biarc_dc/maximal_disk.h"
#include "methods/biarc_dc/subshape.h"

namespace medial::biarc_dc {

/// The result of the divide step: the combinatorics of the axis, before any curve or branching
/// point is computed. Its size is O(sites).
struct Division {
  /// The dividing disks, those that cut holes first. Their centres connect the base cases.
  std::vector<Disk> disks;
  std::vector<std::uint32_t> component;             ///< of each disk
  std::vector<std::array<std::uint32_t, 2>> equal;  ///< pairs of disks found to be equal
  std::vector<BaseShape> base_shapes;               ///< without caps
  std::uint64_t caps = 0;
  std::uint64_t random_disks = 0;      ///< disks of maximaldisk that divided,
  std::uint64_t branching_disks = 0;   ///< and of maximaldisk*
  std::uint64_t multi_branchings = 0;  ///< disks with four contacts or more
  std::uint64_t only_vertices = 0;     ///< divisions of sub-shapes that have only reflex vertices
  std::uint64_t divided_elements = 0;  ///< sum over all divided sub-shapes
};

/// Algorithm 4 up to the base cases, with stacks instead of recursion, on all of the caller's
/// threads. The division is the same for any number of threads. If the caller cancels, it stops
/// early, with any content. Returns none if rounding leaves a sub-shape that no disk divides.
std::optional<Division> divide(Context& context, std::uint64_t seed, const Options& options);

}  // namespace medial::biarc_dc
