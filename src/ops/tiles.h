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
  /// A share of a leaf's side, far above rounding: so far tiles keep off the borders of windows.
  double slack() const { return std::ldexp(side(), -20 - levels); }
};

/// A straight edge of the boundary, with the interior on its left. Numbers follow each loop.
struct TileEdge {
  Vec2 from, to;
  std::uint64_t number = 0;
};

/// An edge of the axis, from its lower site to its higher one. Tiles have the same numbers for the
/// same node, and for the same site: 2 k for edge k, 2 k + 1 for the vertex where it begins.
struct TileAxisEdge {
  std::array<std::uint64_t, 2> node, site;  ///< see Edge
  std::array<Disk, 2> disk;                 ///< of the nodes
  std::array<std::uint32_t, 2> degree;      ///< of the nodes: how many edges the axis has there
  Disk control;
  double weight = 1;
};

/// What tiles cannot take, if anything: options out of their range, and too many levels for them.
std::optional<Error> refuse_grid(const TileGrid& grid, const Options& options);

/// The leaves that an edge meets, or comes near to: column and row of each.
std::vector<std::array<std::uint32_t, 2>> leaves_of(const TileGrid& grid, const TileEdge& edge);

struct TilePart {
  std::vector<TileAxisEdge> axis;  ///< final
  std::vector<TileEdge> open;      ///< what disks that are not final can touch, by number
};

/// One tile: a leaf has all edges that its window meets, other tiles the open ones of their four
/// children, by number and each once. Uses of the options the tolerance, relative to the grid's
/// box, threads and cancel. O(n log n) expected. Errors: those of refuse_grid() and of
/// voronoi_diagram().
Result<TilePart> axis_of_tile(std::span<const TileEdge> edges, const TileGrid& grid, int level,
                              std::uint32_t column, std::uint32_t row, const Options& options = {});

/// The axis of a shape whose point k is the start of edge k, from the final edges of all tiles, in
/// any order; an edge may be there twice. Errors: internal, where edges are missing.
Result<MedialAxis> join_tiles(const Shape& shape, std::vector<TileAxisEdge> edges,
                              const Options& options = {});

}  // namespace medial
