#pragma once

// One tile of a shape, for engines that give tiles to many machines, and for compute_in_tiles().

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "medial/compute.h"
#include "medial/tiles.h"

namespace medial {

/// A quadtree of square windows. Level 0 is the root; windows at the rim are open outwards.
struct TileGrid {
  static constexpr int most_levels = 10;
  Box box;         ///< of the shape: the square has its lower left corner and its longer side
  int levels = 0;  ///< below the root: 4^levels leaves
  double side() const { return std::max(box.high.x - box.low.x, box.high.y - box.low.y); }
  Box window(int level, std::uint32_t column, std::uint32_t row) const;
  /// The distance that tiles keep from the borders of windows: a share of a leaf's side, far above
  /// rounding.
  double slack() const { return std::ldexp(side(), -20 - levels); }
};

/// A straight edge of the boundary, with the interior on its left. Edges are numbered along each
/// loop.
struct TileEdge {
  Vec2 from, to;
  std::uint64_t number = 0;
};

/// An edge of the axis, from its lower site to its higher one. All tiles use the same number for a
/// node, and for a site: 2 k for edge k, 2 k + 1 for the vertex where it begins.
struct TileAxisEdge {
  std::array<std::uint64_t, 2> node, site;  ///< see Edge
  std::array<Disk, 2> disk;                 ///< of the nodes
  std::array<std::uint32_t, 2> degree;      ///< of the nodes: their number of edges in the axis
  Disk control;
  double weight = 1;
};

/// The error for options that tiles do not support or that are out of range, and for too many
/// levels; none if all are valid.
std::optional<Error> refuse_grid(const TileGrid& grid, const Options& options);

/// The leaves that an edge meets or almost meets, by column and row.
std::vector<std::array<std::uint32_t, 2>> leaves_of(const TileGrid& grid, const TileEdge& edge);

struct TilePart {
  std::vector<TileAxisEdge> axis;  ///< final
  std::vector<TileEdge> open;      ///< edges that disks that are not final can touch, by number
};

/// Computes one tile. `edges`, sorted by number and distinct, are all edges that meet the window of
/// a leaf, or the open edges of the four children of another tile. Uses the tolerance (relative to
/// the grid's box), threads and cancel of the options. O(n log n) expected. Errors: those of
/// refuse_grid() and of voronoi_diagram().
Result<TilePart> axis_of_tile(std::span<const TileEdge> edges, const TileGrid& grid, int level,
                              std::uint32_t column, std::uint32_t row, const Options& options = {});

/// The axis of a shape whose point k is the start of edge k, from the final edges of all tiles, in
/// any order; edges may be repeated. Errors: internal (edges are missing).
Result<MedialAxis> join_tiles(const Shape& shape, std::vector<TileAxisEdge> edges,
                              const Options& options = {});

}  // namespace medial
