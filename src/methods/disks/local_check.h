#pragma once

#include <cstdint>
#include <span>

#include "methods/disks/boundary.h"
#include "methods/disks/collect.h"
#include "site/boundary_tree.h"

namespace medial::disks {

/// Whether all edges of a graph that name one of these sites are right to the tolerance, and none
/// is missing at their ends: disks at their ends and in between touch both of their sites and reach
/// over none, feet move along the boundary, and a node's disk touches all between one edge and the
/// next. Where every other step of a walk is certain, the graph is (docs/exact.md). O(edges), and
/// O(log n) for each of those named.
bool is_right_around(const Boundary& boundary, const site::BoundaryTree& tree, const Graph& graph,
                     std::span<const std::uint32_t> sites, double tolerance);

}  // namespace medial::disks
