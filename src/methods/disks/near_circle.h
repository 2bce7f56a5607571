#pragma once

#include "methods/disks/boundary.h"
#include "methods/disks/collect.h"

namespace medial::disks {

/// Whether a disk is an arc's own circle, within `slack`: as round, and through both ends. Two arcs
/// on both sides of an apex, as curves have them, are small, and not that much alike.
bool is_own_circle(const site::Site& site, const Disk& disk, double slack);

/// Whether disks of the axis are, within `slack`, the own circles of several arcs at once: an edge
/// that lies in the centre of an arc, or ends there with other arcs inside. Rounding may then
/// decide what the axis is. O(edges).
bool is_in_centers(const Boundary& boundary, const Graph& graph, double slack);

}  // namespace medial::disks
