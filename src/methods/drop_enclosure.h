#pragma once

#include <vector>

#include "medial/axis.h"
#include "medial/geometry.h"

namespace medial {

/// Removes what the enclosure of an exterior, a rectangle, has added to its axis: the sites marked,
/// the edges that have one of them, or whose disks touch the enclosure where edges have no sites,
/// and the nodes that had no other edges. The kinds of the nodes left follow their numbers of
/// edges. O(size of the axis).
void drop_enclosure(const std::vector<bool>& site_of_enclosure, const Box& enclosure,
                    MedialAxis& axis);

}  // namespace medial
