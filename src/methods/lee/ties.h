#pragma once

#include <optional>

#include "methods/lee/graph.h"

namespace medial::lee {

/// Where more than three elements touch one disk up to rounding, a tie, the merges broke it some
/// way: a few Voronoi points lie close together, some of them far less exactly known than the disk
/// that touches all. Such points all become that disk, and the edges between them have no length,
/// wherever one disk touches all their elements within half of the tolerance. O(doubtful edges), or
/// O(nodes) where there is a tie.
void join_ties(Graph& graph, double tolerance);

/// A disk of a polygon's diagram that rounding has made wrong, if there is one: at the inner end of
/// an edge on which a foot moves backward by more than `slack`, whatever disks the ties have
/// become; or that reaches over the boundary by more, among those that touch three elements close
/// together of a nearly round boundary with very many sides, as seen by elements that are a power
/// of two away. O(N), and O(log N) for each of the latter.
std::optional<Disk> find_overreach(const Graph& graph, double slack);

/// Whether the disk of every node touches its three elements, and reaches over none that the next
/// nodes' disks touch, nor a foot moves backward, all by `slack` at most. A diagram of which that
/// holds everywhere is right, as a triangulation is Delaunay's where each two triangles beside each
/// other are. False, too, where many points are close together. O(N).
bool is_right_locally(const Graph& graph, double slack);

}  // namespace medial::lee
