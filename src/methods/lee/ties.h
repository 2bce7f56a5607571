#pragma once

#include "methods/lee/graph.h"

namespace medial::lee {

/// Joins ties. If more than three elements touch one disk up to rounding, the merges broke the tie
/// in some way: a few Voronoi points are close together, some of them far less accurate than the
/// disk that touches all elements. If one disk touches all their elements within half of the
/// tolerance, all these points become that disk, and the edges between them have no length.
/// O(doubtful edges), or O(nodes) if there is a tie.
void join_ties(Graph& graph, double tolerance);

/// Whether, within `slack`, the disk of every node touches its three elements and reaches over no
/// element that the disks of adjacent nodes touch, and no foot moves backward. A diagram for which
/// this holds everywhere is correct, just as a triangulation is a Delaunay triangulation if every
/// two adjacent triangles satisfy the condition. Also false if distinct points are close together:
/// many errors may add up, and a mirror image may join other points. O(N).
bool is_right_locally(const Graph& graph, double slack);

}  // namespace medial::lee
