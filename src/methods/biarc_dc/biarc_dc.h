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
  std::uint64_t only_vertices = 0;  ///< divided sub-shapes with reflex vertices only
};

/// The method `biarc-dc` (docs/biarc-dc.md). Requires what compute() has checked: a shape without
/// holes. Cut short, with any content, where the caller cancels. An axis that rounding may have
/// misled is verified; where that fails the method restarts with another seed. Errors: unsupported,
/// with the place, where no attempt passes; internal where no disk divides a part of the shape.
/// Expected O(n log n) where the diameter of the axis is proportional to n, and O(n^2) in the worst
/// case.
Result<MedialAxis> run(const Problem& problem, Report* report = nullptr);

}  // namespace medial::biarc_dc
