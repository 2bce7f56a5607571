#pragma once

#include <cstdint>
#include <optional>

#include "methods/lee/diagram.h"

namespace medial::lee {

/// The diagram of a list of chains, [first, end), in closed form where its boundary is convex and
/// one disk, not larger than `radius_limit`, touches all of its segments but for `slack`, as in a
/// regular polygon: every bisector of neighbours ends in that disk, and all others but that of the
/// first and the last element have no length. Only where the list turns enough to determine the
/// disk well, or where it is `known` already: the disk of the list before, and of this one
/// afterwards. Returns the edge between the first and the last element, or `none`, then mostly at
/// once, and the diagram is unchanged. Requires at least two chains, and that none of them has been
/// merged. O(chains).
std::uint32_t fan_of(Diagram& diagram, std::uint32_t first, std::uint32_t end, double radius_limit,
                     double slack, std::optional<Disk>& known);

}  // namespace medial::lee
