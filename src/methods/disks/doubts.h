#pragma once

#include "methods/disks/boundary.h"
#include "methods/disks/collect.h"
#include "site/boundary_tree.h"

namespace medial::disks {

/// Notes among a graph's lost sites where it may be wrong next to arcs: where disks reach over
/// sites, and where edges may run backward. O(n log n).
void find_doubts(const Boundary& boundary, const site::BoundaryTree& tree, double tolerance,
                 Graph& graph);

}  // namespace medial::disks
