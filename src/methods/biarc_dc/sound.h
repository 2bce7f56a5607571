#pragma once

#include "methods/biarc_dc/conquer.h"
#include "methods/biarc_dc/maximal_disk.h"

namespace medial::biarc_dc {

/// Whether an axis passes all local tests: no disk of a node, or in the middle of an edge, reaches
/// over a site by more than `slack`, or is so small that rounding matters; the disks of an edge
/// touch its two sites, and its feet move along the boundary; no edge is missing around a node
/// (together, these conditions make an axis: docs/exact.md); each convex corner is a leaf, and each
/// other leaf is the centre of an arc of locally largest curvature. Expected O(n log n), a fifth of
/// the time of the method.
bool is_sound(const Skeleton& skeleton, const Context& context, double slack);

}  // namespace medial::biarc_dc
