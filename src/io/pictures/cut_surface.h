#pragma once

#include <vector>

#include "io/pictures/canvas.h"
#include "medial/io/write.h"

namespace medial::io {

/// The surface after a cut, simulated: the height at the middle of each pixel of a picture, row by
/// row, 0 where nothing is cut.
std::vector<double> surface_after(const Document<CarveItem>& file, const Viewport& viewport);

/// The same with light from the upper left, as pixels 0xRRGGBB.
std::vector<std::uint32_t> shaded(const std::vector<double>& heights, const Viewport& viewport);

}  // namespace medial::io
