#pragma once

#include <vector>

#include "medial/axis.h"
#include "medial/geometry.h"

namespace medial {

/// Removes from the axis of an exterior all that the enclosure, a rectangle, has added: the marked
/// sites; the edges that have such a site or, if edges have no sites, whose disks touch the
/// enclosure; and the nodes left without edges. Updates the kinds of the remaining nodes. O(size of
/// the axis).
void drop_enclosure(const std::vector<bool>& site_of_enclosure, const Box& enclosure,
                    MedialAxis& axis);

}  // namespace medial
