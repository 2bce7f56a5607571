#pragma once

#include <optional>

#include "methods/potential/charges.h"
#include "methods/potential/region.h"
#include "methods/potential/skeleton.h"

namespace medial::potential {

/// Coarse to fine ([ahuja1997], Section 4.1.3, Fig. 8): computes the skeleton of a polygon within
/// `coarse` of the boundary. Its points then restart on closer and closer polygons, each within
/// half of the previous distance, and finally on the boundary. The result is the skeleton of the
/// boundary less the branches to features that the first polygon omits. It is connected, with one
/// cycle per hole. None if no polygon is further than a step's accuracy from the boundary. O(n)
/// forces for each of O(log n) polygons and each point.
std::optional<Skeleton> trace_coarse_to_fine(const Region& region, const Charges& charges,
                                             const SkeletonOptions& options, double coarse);

}  // namespace medial::potential
