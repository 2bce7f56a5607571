#pragma once

// The axis of one shape in tiles that know nothing of each other, for shapes that no machine holds
// (docs/tiles.md): what a tile cannot finish is passed on to the tile around it, up to the root.

#include "medial/compute.h"

namespace medial {

/// A quadtree of windows over a box. Level 0 is the root; windows at the rim are open outwards.
struct TileGrid {
  static constexpr int most_levels = 10;
  Box box;         ///< of the shape
  int levels = 0;  ///< below the root: 4^levels leaves
  Box window(int level, std::uint32_t column, std::uint32_t row) const;
  /// What rounding may not move a disk by: all tiles keep off their windows' borders by that.
  double slack() const;
};

/// A straight edge of the boundary, with the interior on its left. Numbers follow each loop.
struct TileEdge {
  Vec2 from, to;
  std::uint64_t number = 0;
};

/// An edge of the axis. Tiles have the same numbers for the same node, and for the same site: 2 k
/// for edge k, 2 k + 1 for the vertex where it begins.
struct TileAxisEdge {
  std::array<std::uint64_t, 2> node, site;  ///< see Edge
  std::array<Disk, 2> disk;                 ///< of the nodes
  Disk control;
  double weight = 1;
};

struct TilePart {
  std::vector<TileAxisEdge> axis;  ///< final
  std::vector<TileEdge> open;      ///< what disks that are not final can touch, by number
};

/// One tile: a leaf has all edges that its window meets, other tiles the open ones of their four
/// children, each once. Uses of the options tolerance, relative to the grid's box, threads and
/// cancel. O(n log n) expected for n edges. Errors: those of voronoi_diagram().
Result<TilePart> axis_of_tile(std::span<const TileEdge> edges, const TileGrid& grid, int level,
                              std::uint32_t column, std::uint32_t row, const Options& options = {});

/// The axis of a shape whose point k is the start of edge k, from the final edges of all tiles, in
/// any order; an edge may be there twice. Errors: internal, where they are not one axis.
Result<MedialAxis> join_tiles(const Shape& shape, std::vector<TileAxisEdge> edges,
                              const Options& options = {});

/// What the tiles of one level had to do.
struct TileLevel {
  std::uint64_t tiles = 0;      ///< with edges
  std::uint64_t edges = 0;      ///< of the boundary, in all of them
  std::uint64_t most = 0;       ///< in one of them
  std::uint64_t axis = 0;       ///< final edges of the axis
};

/// The axis of a shape of straight edges by tiles on one machine: that of compute(), but for the
/// order of nodes and edges, and for rounding. `report` gets a row a level, the root first. Errors:
/// those of compute(); unsupported (arcs; edges within 64 tolerances); invalid_option (levels
/// outside of [0, 10], windows of some tolerances, options other than tolerance, threads, progress
/// and cancel).
Result<MedialAxis> compute_in_tiles(const Shape& shape, int levels, const Options& options = {},
                                    std::vector<TileLevel>* report = nullptr);

}  // namespace medial
