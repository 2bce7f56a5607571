#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.h"
#include "medial/raster.h"
#include "medial/shape.h"

namespace medial::brushfire {

/// The pixels whose centres lie inside the shape, a set for each component, in the order of
/// increasing x within increasing y. Of centres on the boundary those on its left and lower sides
/// (with y upwards) count. Arcs are taken as chords within a thousandth of a pixel. O(edges +
/// crossings of edges and rows, sorted).
std::vector<raster::PixelRun> runs_inside(const Shape& shape, const raster::Grid& grid);

/// The runs as an image as large as the grid, with row 0 of the grid in its first row.
Image image_of(const std::vector<raster::PixelRun>& runs, const raster::Grid& grid);

}  // namespace medial::brushfire
