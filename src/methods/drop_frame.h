#pragma once

#include <vector>

#include "medial/axis.h"

namespace medial {

/// Takes away what the frame of an exterior has added to its axis: the sites marked, the edges that
/// have one of them, and the nodes that had no other edges. The kinds of the nodes left tell how
/// many edges they have now. O(size of the axis).
void drop_frame(const std::vector<bool>& site_of_frame, MedialAxis& axis);

}  // namespace medial
