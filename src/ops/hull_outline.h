#pragma once

#include <cstdint>
#include <vector>

#include "medial/axis.h"
#include "medial/shape.h"

namespace medial::ops {

/// Of the error of a pack: what it leaves for the chords of arcs.
constexpr double chord_share = 1.0 / 16;

/// Rings around which the non-zero rule finds the union of the convex hulls of the disks at the
/// ends of each edge, and of the disks of nodes without edges, within `chord` (positive; or 1e-7
/// of a disk's radius where there are more than 64 disks). What the rings wind around, they wind
/// around counter-clockwise only. Disks are moved at random, by far less than `chord`: should edges
/// of the rings lie on each other nevertheless, another seed helps. O(n log n) and at most 4096
/// points for each end of an edge, or 2^18 in all.
std::vector<Ring> outline_of_hulls(const MedialAxis& axis, double chord, std::uint64_t seed = 0);

}  // namespace medial::ops
