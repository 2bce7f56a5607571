#pragma once

#include <cstdint>

#include "engines/lee/diagram.h"

namespace medial::lee {

/// The diagram of a whole loop, the chains [first, end), in closed form where it is convex and one
/// disk touches all of its segments but for `slack`, as that of a regular polygon: every bisector
/// of neighbours ends in that disk, and the others have no length. Returns the terminating
/// bisector's edge, or `none`, then mostly at once, and the diagram is as it was. O(chains).
std::uint32_t fan_of(Diagram& diagram, std::uint32_t first, std::uint32_t end, double slack);

}  // namespace medial::lee
