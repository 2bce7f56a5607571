#pragma once

#include <optional>
#include <vector>

#include "methods/disks/collect.h"
#include "methods/edit/window.h"

namespace medial::edit {

/// What the search for the new part of an axis goes by, all in the local frame.
struct Measures {
  double tolerance = 0;       ///< that of the axis
  double fine_tolerance = 0;  ///< that the local coordinates allow
  double radius_limit = 0;
};

/// The new part of an axis: its edges name nodes of its own and sites by their numbers in Rings.
struct Repair {
  std::vector<Disk> disks;
  std::vector<std::uint32_t> old_nodes;  ///< of each node: that of the axis at a border, or none
  std::vector<AxisGraph::Edge> edges;
};

/// Walks what the window encloses. None where the walk loses its way; where it ends so near to a
/// border that more of the axis may change, that border's node is added to `doubtful`.
std::optional<Repair> repair(const Rings& rings, const AxisGraph& graph, const Window& window,
                             const Measures& measures, std::vector<std::uint32_t>& doubtful);

}  // namespace medial::edit
