#pragma once

#include <cstdint>
#include <vector>

#include "medial/axis.h"
#include "medial/raster.h"
#include "medial/shape.h"

namespace medial::papers {

/// The spine of an axis without cycles: its longest way, in steps of about `step`.
std::vector<Vec2> spine_of(const MedialAxis& axis, double step);

/// The sum of the turns along a line, in degrees.
double turning(const std::vector<Vec2>& line);

/// The pixels, `side` units wide, whose centres lie in a shape.
Image pixels_of(const Shape& shape, double side);

/// Thinning by Zhang and Suen (1984): two passes in turn delete border pixels from the south-east
/// and from the north-west.
Image thinned(Image image);

/// How many pixels have one neighbour: the ends of lines.
std::uint64_t ends_of(const Image& image);

}  // namespace medial::papers
