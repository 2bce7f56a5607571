#pragma once

#include <cstdint>
#include <string_view>

#include "medial/shape.h"

namespace medial::raster {

/// How many pixels along the longer side of a shape do for a method of pixels, where its axis at
/// `resolution` has not one part for each component and one cycle for each hole; 0: none that is
/// known. For `ridge` each loop spans a pixel then; for `brushfire` it is tried, up to sixteen
/// times as many.
std::uint32_t pixels_that_do(const Shape& shape, std::string_view method, double resolution);

}  // namespace medial::raster
