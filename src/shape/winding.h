#pragma once

#include <cstdint>
#include <span>

#include "medial/shape.h"
#include "shape/splice.h"

namespace medial {

/// If a ring has the role `winding`, determines the interior again: the points with a nonzero
/// winding number of the rings of that role, toggled by the even-odd rule for the other rings.
/// Drops edges with interior on both sides. Returns the number of rings without remaining edges.
/// O(n + t log t) for t touching vertices, plus the number of edges at each touching place for each
/// edge dropped there.
std::uint64_t apply_winding(std::span<const Ring> rings, Arrangement& arrangement);

}  // namespace medial
