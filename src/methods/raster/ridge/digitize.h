#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/grid.h"
#include "medial/error.h"
#include "methods/raster/ridge/outline.h"

namespace medial::ridge {

/// The largest number of pixels of a grid: three bit maps of this size take 768 MiB.
constexpr std::uint64_t most_pixels = std::uint64_t{1} << 31;
/// The largest number of rows and columns that the boundary may cross: each crossing takes some 400
/// bytes.
constexpr double most_crossings = 0x1p23;

/// The requested grid, with the shape's box in the middle and a margin of at least a pixel. Errors:
/// invalid_option (see PixelGrid), too_large (more than most_pixels), unsupported (pixels smaller
/// than the spacing of the coordinates).
Result<raster::Grid> grid_for(const Box& box, const PixelGrid& wanted);

/// The grid with the local coordinates of its pixels.
struct LocalGrid {
  raster::Grid grid;  ///< in local coordinates
  explicit LocalGrid(const raster::Grid& input, const LocalFrame& frame)
      : grid{frame.to_local(input.origin), input.step * frame.scale, input.columns, input.rows} {}
  /// In units of pixels; pixel centres have whole numbers.
  Vec2 in_pixels(Vec2 local) const {
    return {(local.x - grid.origin.x) / grid.step, (local.y - grid.origin.y) / grid.step};
  }
};

/// The boundary map (A.1.a, step 2 of A.3): along each edge one pixel for each column or row of
/// centres that it passes, whichever are more, as Bresenham draws lines; and each vertex's own.
///
/// Two pixels side by side (of four neighbours) whose centres lie on different sides of the
/// boundary are never both left out.
raster::BitMap boundary_map(const EdgeOutline& outline, const LocalGrid& local);

using raster::PixelRun;

/// The pixels whose centres lie in the shape and that are not in the boundary map, as runs in the
/// order of increasing x within increasing y. Those of one bounded set (of four neighbours) have
/// the same number; sets are numbered by their first runs.
struct InteriorSets {
  raster::BitMap inside;
  std::vector<PixelRun> runs;
  std::uint32_t count = 0;
};
InteriorSets interior_sets(const EdgeOutline& outline, const LocalGrid& local,
                           const raster::BitMap& boundary);

/// The runs of all pixels set, their sets numbered as above.
std::vector<PixelRun> runs_of(const raster::BitMap& map, std::uint32_t& sets);

/// An inner point for each component of the shape by the report's way, where it leads to one
/// (Section III.B, A.3.c): the centroid of the triangle that the highest vertex B makes with its
/// neighbours, cut off at the height of the highest concave vertex. Local coordinates.
std::vector<Vec2> inner_points(const EdgeOutline& outline);

}  // namespace medial::ridge
