#pragma once

#include "methods/biarc_dc/conquer.h"
#include "methods/biarc_dc/maximal_disk.h"

namespace medial::biarc_dc {

/// Whether an axis is right as far as this can tell: no disk of a node or in the middle of an edge
/// reaches over a site by more than `slack`, or is too small for rounding not to matter; an edge's
/// disks touch its two sites, its feet move along the boundary, and no edge is missing around a
/// node, which together make an axis (docs/exact.md); each convex corner is a leaf, and each other
/// leaf is the centre of an arc of locally largest curvature. O(n log n) expected, a fifth of the
/// whole.
bool is_sound(const Skeleton& skeleton, const Context& context, double slack);

}  // namespace medial::biarc_dc
