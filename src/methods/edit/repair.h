#pragma once

#include <optional>
#include <vector>

#include "methods/disks/collect.h"
#include "methods/edit/window.h"

namespace medial::edit {

/// The limits for computing a new part of an axis, in the local frame.
struct Measures {
  double tolerance = 0;       ///< of the axis
  double fine_tolerance = 0;  ///< the finest that the local coordinates allow
  double radius_limit = 0;
};

/// The new part of an axis. Its edges name nodes of the part, and sites by their numbers in Rings.
struct Repair {
  std::vector<Disk> disks;
  std::vector<std::uint32_t> old_nodes;  ///< for each node: the axis' node at a border, or none
  std::vector<AxisGraph::Edge> edges;
};

/// Walks the inside of a window. Returns none if the walk fails. If an edge ends so close to a
/// border that more of the axis may change, the border's node is added to `doubtful`.
std::optional<Repair> repair(const Rings& rings, const AxisGraph& graph, const Window& window,
                             const Measures& measures, std::vector<std::uint32_t>& doubtful);

}  // namespace medial::edit
