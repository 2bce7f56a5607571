#pragma once

#include <vector>

#include "medial/axis.h"

namespace medial {

/// Removes what the enclosure of an exterior has added to its axis: the sites marked, the edges
/// that have one of them, and the nodes that had no other edges. The kinds of the nodes left follow
/// their numbers of edges. O(size of the axis).
void drop_enclosure(const std::vector<bool>& site_of_enclosure, MedialAxis& axis);

}  // namespace medial
