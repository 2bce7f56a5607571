#pragma once

#include <cstdint>
#include <optional>

#include "methods/lee/diagram.h"

namespace medial::lee {

/// Computes the diagram of a list of chains, [first, end), in closed form. This is possible if its
/// boundary is convex and one disk, not larger than `radius_limit`, touches all of its segments
/// within `slack`, as in a regular polygon: every bisector of neighbours ends in that disk, and all
/// others have no length, except that of the first and the last element. The list must turn enough
/// to determine the disk well, unless the disk is `known` from the list before; `known` is set to
/// this list's disk. Returns the edge between the first and the last element. Otherwise returns
/// `none`, mostly at once, and leaves the diagram unchanged. Requires at least two chains, none of
/// which has been merged. O(chains).
std::uint32_t fan_of(Diagram& diagram, std::uint32_t first, std::uint32_t end, double radius_limit,
                     double slack, std::optional<Disk>& known);

}  // namespace medial::lee
