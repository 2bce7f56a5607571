#pragma once

#include <memory>
#include <vector>

#include "engines/disks/boundary.h"
#include "engines/disks/walk.h"
#include "medial/axis.h"

namespace medial::disks {

/// Joins the walk's chunks into one graph: numbers the nodes, glues the axis at the cuts (whose
/// disks are no nodes of it), works out the edges' curves and the nodes' kinds, and goes back to
/// the input's units. Empties the chunks as it goes, so that nothing is in memory twice.
void collect(std::vector<std::unique_ptr<Chunk>>& chunks, const Boundary& boundary,
             std::size_t cut_count, const Frame& frame, MedialAxis& axis);

}  // namespace medial::disks
