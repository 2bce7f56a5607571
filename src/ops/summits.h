#pragma once

#include "medial/axis.h"

namespace medial::ops {

/// Whether the radius along some edge exceeds the radii of both ends, which happens only between
/// two arcs.
bool has_summits(const MedialAxis& axis);

/// Divides such edges where their radius is largest, so that the largest radius along every edge is
/// at a node. Existing nodes and edges keep their indices; the second halves and the new nodes
/// (site_change) are appended. O(edges).
void divide_at_summits(MedialAxis& axis);

}  // namespace medial::ops
