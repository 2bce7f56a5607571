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

/// Force lines are followed up to this order: there is still a force between parallel sides some
/// widths long, and minima are few.
constexpr double line_order = 24;

/// Skeletons of ever higher orders tend to the medial axis ([ahuja1997], Section 3.2). The
/// axis' points count as those of this order.
constexpr double limit_order = 512;

/// The skeletons of all components in the limit of high orders: points of the medial axis, at most
/// this share of a region's size apart. `local` leads from the axis' coordinates to the regions'.
std::vector<Skeleton> limits_of(const MedialAxis& exact, std::span<const Region> regions,
                                const LocalFrame& local, double step);

/// Only the branch of a limit to which the force of this order leads from a place in the region.
Skeleton branch_at(const Skeleton& limit, const Charges& charges, Vec2 from, double order,
                   double step);

/// Only the links of a skeleton with an end in the box.
Skeleton part_within(const Skeleton& skeleton, const Box& box);

/// Follows a limit down to the n-skeleton: order by order, each point moves across its valley, and
/// branchings with their neighbours. Points at a tip go where their valley ends; others without a
/// valley move as their neighbours do. Parts and cycles stay.
Skeleton descended(Skeleton skeleton, const Charges& charges, const SuccessorOptions& options);

}  // namespace medial::potential
