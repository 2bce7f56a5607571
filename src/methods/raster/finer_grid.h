#pragma once

#include <cstdint>
#include <string_view>

#include "medial/shape.h"

namespace medial::raster {

/// The number of pixels along the longer side of a shape with which a method on pixels succeeds, if
/// its axis at `resolution` does not have one part per component and one cycle per hole; 0 if none
/// is known. For `ridge`, each loop spans a pixel then; for `brushfire`, this is tried, with up to
/// sixteen times as many pixels.
std::uint32_t pixels_that_do(const Shape& shape, std::string_view method, double resolution);

}  // namespace medial::raster
