#pragma once

#include <vector>

#include "medial/axis.h"
#include "medial/error.h"
#include "medial/shape.h"

namespace medial::io {

/// The union of the convex hulls of the disks at the ends of each edge, and of the disks of nodes
/// without edges, through GEOS: outer rings and holes on a grid of `chord` / 64 or finer, whose
/// arcs are chords within `chord` inside of them. Errors: no_area (nothing but points), internal
/// (GEOS fails).
Result<std::vector<Ring>> union_of_hulls(const MedialAxis& axis, double chord);

}  // namespace medial::io
