#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.h"
#include "medial/image.h"
#include "medial/shape.h"

namespace medial::brushfire {

/// Pixels of a row next to each other, first..last, of one component of the shape.
struct Run {
  std::uint32_t row = 0, first = 0, last = 0;
  std::uint32_t component = 0;
};

/// The pixels whose centres lie inside the shape, in the order of increasing x within increasing y.
/// Of centres on the boundary those on its left and lower sides (with y upwards) count. Arcs are
/// taken as chords within a thousandth of a pixel. O(edges + crossings of edges and rows, sorted).
std::vector<Run> runs_inside(const Shape& shape, const raster::Grid& grid);

/// The runs as an image as large as the grid, with row 0 of the grid in its first row.
Image image_of(const std::vector<Run>& runs, const raster::Grid& grid);

}  // namespace medial::brushfire
