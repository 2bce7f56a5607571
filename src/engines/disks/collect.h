#pragma once

#include <tbb/concurrent_vector.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "engines/disks/boundary.h"
#include "engines/disks/walk.h"
#include "medial/axis.h"

namespace medial::disks {

/// Joins the walk's chunks into one graph in the local frame, whose edges name sites of the
/// boundary and have no curves yet: numbers the nodes and glues the axis at the cuts (whose disks
/// are no nodes of it). Empties the chunks as it goes, so that nothing is in memory twice.
void collect(std::vector<std::unique_ptr<Chunk>>& chunks, std::size_t cut_count, MedialAxis& axis);

/// Works out the edges' curves and the nodes' kinds, and goes back to the result's numbers of sites
/// and to the input's units. Returns the edges, in any order, with an end that does not touch one
/// of the edge's two sites, give or take `slack` in local units: where cuts divide a site, the
/// piece of it that the edge names. Of soups none are looked for.
tbb::concurrent_vector<std::uint32_t> complete(const Boundary& boundary, const Frame& frame,
                                               double slack, MedialAxis& axis);

/// Whether both ends of an edge touch the edge's two sites, give or take `slack`, in the input's
/// units.
bool touches_its_sites(const MedialAxis& axis, const Edge& edge, double slack);

}  // namespace medial::disks
