#pragma once

#include "medial/axis.h"

namespace medial::ops {

/// Whether the radius along some edge exceeds that of both of its ends: only between two arcs.
bool has_summits(const MedialAxis& axis);

/// Divides such edges where their radius is largest, so that the largest radius along every edge is
/// that of a node. What was there keeps its index; the second halves and the new nodes
/// (site_change) come behind. O(edges).
void divide_at_summits(MedialAxis& axis);

}  // namespace medial::ops
