#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/local_frame.h"
#include "medial/axis.h"
#include "methods/potential/charges.h"
#include "methods/potential/skeleton.h"
#include "methods/potential/successor.h"

namespace medial::potential {

/// The highest order of force lines: there is still a force between parallel sides that are some
/// widths long, and there are few minima.
constexpr double line_order = 24;

/// Skeletons of increasing order converge to the medial axis ([ahuja1997], Section 3.2). The points
/// of the axis count as points of this order.
constexpr double limit_order = 512;

/// The skeletons of all components in the limit of high orders: points of the medial axis, with a
/// spacing of at most `share` of a region's size. `local` maps the axis' coordinates to those of
/// the regions.
std::vector<Skeleton> limits_of(const MedialAxis& exact, std::span<const Region> regions,
                                const LocalFrame& local, double step);

/// The branch of a limit to which the force of this order leads from a place in the region.
Skeleton branch_at(const Skeleton& limit, const Charges& charges, Vec2 from, double order,
                   double step);

/// The links of a skeleton with an end in the box.
Skeleton part_within(const Skeleton& skeleton, const Box& box);

/// Follows a limit down to the n-skeleton. Order by order, each point moves across its valley, and
/// branchings move with their neighbours. Points at a tip move to the end of their valley; other
/// points without a valley move like their neighbours. Parts and cycles stay.
Skeleton descended(Skeleton skeleton, const Charges& charges, const SuccessorOptions& options);

}  // namespace medial::potential
