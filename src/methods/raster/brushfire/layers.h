#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.h"
#include "medial/shape.h"

namespace medial::brushfire {

/// The runs in layers, each in order, so that runs of two sets in one layer never touch, not even
/// at a corner: if two components that touch on the grid were thinned together, they would become
/// one. One layer if nothing touches. O(runs log runs).
std::vector<std::vector<raster::PixelRun>> layers_of(const std::vector<raster::PixelRun>& runs);

/// Whether the runs of each component of the shape, as a set of pixels with eight neighbours each,
/// are in one part, with as many holes as the component. O(runs).
bool is_resolved(const Shape& shape, const std::vector<raster::PixelRun>& runs);

}  // namespace medial::brushfire
