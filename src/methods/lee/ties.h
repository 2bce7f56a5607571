#pragma once

#include "methods/lee/graph.h"

namespace medial::lee {

/// Where more than three elements touch one disk up to rounding, a tie, the merges broke it some
/// way: a few Voronoi points lie close together, some of them far less exactly known than the disk
/// that touches all. Such points all become that disk, and the edges between them have no length,
/// wherever one disk touches all their elements within half of the tolerance. O(doubtful edges), or
/// O(nodes) where there is a tie.
void join_ties(Graph& graph, double tolerance);

/// Whether the disk of every node touches its three elements, and reaches over none that the next
/// nodes' disks touch, nor a foot moves backward, all by `slack` at most. A diagram of which that
/// holds everywhere is right, as a triangulation is Delaunay's where each two triangles beside each
/// other are. False, too, where points are close together that are not one: errors of many may add
/// up, and a mirror image may join others. O(N).
bool is_right_locally(const Graph& graph, double slack);

}  // namespace medial::lee
