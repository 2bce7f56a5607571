#pragma once

#include <array>
#include <cstdint>

#include "medial/axis.h"
#include "methods/biarc_dc/subshape.h"
#include "methods/problem.h"

namespace medial::biarc_dc {

/// Counts of the divide step.
struct Report {
  std::array<std::uint64_t, base_case_count> base_cases{};  ///< by BaseCase
  std::uint64_t random_disks = 0;                           ///< divisions by maximaldisk,
  std::uint64_t branching_disks = 0;                        ///< divisions by maximaldisk*
  std::uint64_t multi_branchings = 0;                       ///< disks with four contacts or more
  std::uint64_t only_vertices = 0;     ///< divided sub-shapes that have only reflex vertices
  std::uint64_t divided_elements = 0;  ///< sum over all divided sub-shapes
};

/// The method `biarc-dc` (docs/biarc-dc.md). If the caller cancels, it stops early, with any
/// content. An axis that rounding may have misled, or that is not sound (sound.h), is verified. If
/// verification fails, or no disk divides a part of the shape, the method restarts with another
/// seed. Error: unsupported, with the place, if no attempt passes. Expected O(n log n).
Result<MedialAxis> run(const Problem& problem, Report* report = nullptr);

}  // namespace medial::biarc_dc
