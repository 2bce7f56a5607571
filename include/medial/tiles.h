#pragma once

#include "medial/compute.h"

namespace medial {

/// Of one level: tiles with edges, edges of the boundary in all and in the largest, final ones.
struct TileLevel {
  std::uint64_t tiles = 0, edges = 0, most = 0, axis = 0;
};

/// compute() of straight edges by 4^levels tiles that know nothing of each other, docs/tiles.md, in
/// another order of nodes and edges; `report` gets a row a level, the root first. Errors: also
/// unsupported (arcs; edges within 64 tolerances), invalid_option (levels outside of [0, 10]; tiles
/// of some tolerances; options but for tolerance, threads, progress and cancel).
Result<MedialAxis> compute_in_tiles(const Shape& shape, int levels, const Options& options = {},
                                    std::vector<TileLevel>* report = nullptr);

}  // namespace medial
