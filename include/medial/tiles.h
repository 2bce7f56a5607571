#pragma once

#include "medial/compute.h"

namespace medial {

/// What the tiles of one level had to do.
struct TileLevel {
  std::uint64_t tiles = 0;  ///< with edges
  std::uint64_t edges = 0;  ///< of the boundary, in all of them
  std::uint64_t most = 0;   ///< in one of them
  std::uint64_t axis = 0;   ///< final edges of the axis
};

/// The axis of a shape of straight edges by a quadtree of 4^levels tiles that know nothing of each
/// other (docs/tiles.md): that of compute(), but for the order of nodes and edges, and rounding.
/// `report` gets a row a level, the root first. Of the options it takes tolerance, threads,
/// progress and cancel. Errors: those of compute(); unsupported (arcs; edges within 64 tolerances);
/// invalid_option (levels outside of [0, 10]; tiles of some tolerances).
Result<MedialAxis> compute_in_tiles(const Shape& shape, int levels, const Options& options = {},
                                    std::vector<TileLevel>* report = nullptr);

}  // namespace medial
