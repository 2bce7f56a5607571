#pragma once

#include <cstdint>
#include <vector>

#include "medial/axis.h"
#include "medial/shape.h"

namespace medial::ops {

/// The share of the error of a pack for the chords of arcs.
constexpr double chord_share = 1.0 / 16;

/// Rings that bound, by the non-zero rule, the union of the convex hulls of the disks at the ends
/// of each edge, and of the disks of nodes without edges, within `chord` (positive; or 1e-7 of a
/// disk's radius if there are more than 64 disks). No point has a negative winding number. Disks
/// are moved at random, by much less than `chord`; if edges of the rings coincide nevertheless, use
/// another seed. O(n log n), and at most 4096 points for each end of an edge, or 2^18 in all.
std::vector<Ring> outline_of_hulls(const MedialAxis& axis, double chord, std::uint64_t seed = 0);

}  // namespace medial::ops
