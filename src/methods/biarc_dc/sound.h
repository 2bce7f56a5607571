#pragma once

#include "methods/biarc_dc/conquer.h"
#include "methods/biarc_dc/maximal_disk.h"

namespace medial::biarc_dc {

/// Whether an axis is right as far as its nodes can tell: no disk reaches over a site by more than
/// `slack`; the disks at both ends of an edge touch the edge's two sites; each convex corner is a
/// leaf. Two such disks contain all disks of the edge between them, but for what lies between the
/// feet on the two sites; where that may be a hole, the disk in the middle counts as well.
/// O(n log n) expected, a tenth of the whole.
bool is_sound(const Skeleton& skeleton, const Context& context, double slack);

}  // namespace medial::biarc_dc
