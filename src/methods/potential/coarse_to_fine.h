#pragma once

#include <optional>

#include "methods/potential/charges.h"
#include "methods/potential/region.h"
#include "methods/potential/skeleton.h"

namespace medial::potential {

/// Coarse to fine ([ahuja1997], Section 4.1.3, Fig. 8): the skeleton of a polygon within `coarse`
/// of the border, whose points then restart on polygons that are nearer and nearer to it, each
/// within half of the last one's distance, and on the border at last: the skeleton of the border
/// less the branches of what the first polygon leaves out. Connected, with one cycle for each hole;
/// nothing where no polygon is further than a step's accuracy from the border. O(n) forces for each
/// of O(log n) polygons and each point.
std::optional<Skeleton> trace_coarse_to_fine(const Region& region, const Charges& charges,
                                             const SkeletonOptions& options, double coarse);

}  // namespace medial::potential
