#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "methods/biarc_dc/maximal_disk.h"
#include "methods/biarc_dc/subshape.h"

namespace medial::biarc_dc {

/// What the divide step leaves: the combinatorics of the axis, before any curve or branching point
/// is worked out. Its size is O(sites).
struct Division {
  /// The dividing disks, the cutting disks of holes first; their centres glue the base cases
  /// together.
  std::vector<Disk> disks;
  std::vector<std::uint32_t> component;             ///< of each disk
  std::vector<std::array<std::uint32_t, 2>> equal;  ///< pairs of disks found to be the same one
  std::vector<BaseShape> base_shapes;               ///< but no caps
  std::uint64_t caps = 0;
  std::uint64_t random_disks = 0;      ///< of maximaldisk that divided,
  std::uint64_t branching_disks = 0;   ///< of maximaldisk*
  std::uint64_t multi_branchings = 0;  ///< disks with four contacts or more
  std::uint64_t only_vertices = 0;     ///< divisions of sub-shapes with reflex vertices only
  std::uint64_t divided_elements = 0;  ///< of all divided sub-shapes together
};

/// Algorithm 4 up to the base cases, by stacks in place of recursion, on all threads of the
/// caller's: the division is the same for any number of them. Stops, with any content, where the
/// caller cancels; nothing where rounding leaves a sub-shape that no disk divides.
std::optional<Division> divide(Context& context, std::uint64_t seed, const Options& options);

}  // namespace medial::biarc_dc
