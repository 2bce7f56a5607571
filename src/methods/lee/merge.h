#pragma once

#include <cstdint>

#include "medial/axis.h"
#include "methods/lee/arc_contacts.h"
#include "methods/lee/diagram.h"

namespace medial::lee {

/// Merges the diagrams of two lists of chains, [first, middle) and [middle, end), along their merge
/// curve, which starts at the convex vertex between them, or at the disk of the bridge. Requires
/// first < middle < end, and chains of one loop. Each step leaves a Voronoi polygon for good, and
/// each edge is dropped at most once: O(elements of both). Returns the last edge of the merge
/// curve, or `none` if rounding has broken a diagram: then neither can be used any more.
std::uint32_t merge(Diagram& diagram, std::uint32_t first, std::uint32_t middle, std::uint32_t end,
                    const MergeLimits& limits, Statistics& statistics);

}  // namespace medial::lee
