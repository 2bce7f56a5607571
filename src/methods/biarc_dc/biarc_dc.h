#pragma once

#include <array>
#include <cstdint>

#include "medial/axis.h"
#include "methods/biarc_dc/subshape.h"
#include "methods/problem.h"

namespace medial::biarc_dc {

/// How the division went.
struct Report {
  std::array<std::uint64_t, base_case_count> base_cases{};  ///< by BaseCase
  std::uint64_t random_disks = 0;                           ///< divisions by maximaldisk,
  std::uint64_t branching_disks = 0;                        ///< and by maximaldisk*
  std::uint64_t multi_branchings = 0;                       ///< disks with four contacts or more
  std::uint64_t only_vertices = 0;     ///< divided sub-shapes with reflex vertices only
  std::uint64_t divided_elements = 0;  ///< of all divided sub-shapes together
};

/// The method `biarc-dc` (docs/biarc-dc.md). Cut short, with any content, where the caller cancels.
/// An axis that rounding may have misled, or that is not sound (sound.h), is verified; where that
/// fails, or no disk divides a part of the shape, the method restarts with another seed. Error:
/// unsupported, with the place, where no attempt passes. Expected O(n log n).
Result<MedialAxis> run(const Problem& problem, Report* report = nullptr);

}  // namespace medial::biarc_dc
