#pragma once

#include "medial/compute.h"

namespace medial {

/// One level: tiles with edges; boundary edges in all, and in the largest; final axis edges.
struct TileLevel {
  std::uint64_t tiles = 0, edges = 0, most = 0, axis = 0;
};

/// Like compute() for straight edges, by 4^levels independent tiles (docs/tiles.md); the order of
/// nodes and edges differs. `report` gets one row per level, root first. Errors: also
/// invalid_option (arcs; levels outside [0, 10]; tiles as small as some tolerances; options other
/// than tolerance, threads, progress and cancel).
Result<MedialAxis> compute_in_tiles(const Shape& shape, int levels, const Options& options = {},
                                    std::vector<TileLevel>* report = nullptr);

}  // namespace medial
