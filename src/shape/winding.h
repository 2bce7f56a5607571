#pragma once

#include <cstdint>
#include <span>

#include "medial/shape.h"
#include "shape/splice.h"

namespace medial {

/// Where a ring has the role `winding`, decides again what is interior: the points about which the
/// rings of that role wind a number of times that is not 0, the even-odd rule for other rings
/// changing that. Edges with the interior on both sides are dropped. Returns the number of rings of
/// which nothing is left. O(n + t log t) for t touching vertices, and as much again for each
/// dropped edge at a touching place, for the edges there.
std::uint64_t apply_winding(std::span<const Ring> rings, Arrangement& arrangement);

}  // namespace medial
