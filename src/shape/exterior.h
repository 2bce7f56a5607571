#pragma once

#include <cstdint>
#include <vector>

#include "medial/shape.h"

namespace medial {

/// What lies around a shape and in its holes: a rectangular enclosure less the shape.
struct Exterior {
  Shape shape;
  /// Of each point: whether it is one of the enclosure's. The sources of the others are those of
  /// the original shape's points.
  std::vector<bool> of_enclosure;
  /// Of each point: the loop of the original shape that it was on; 0xFFFFFFFF for the enclosure's.
  std::vector<std::uint32_t> of_loop;
};

/// The exterior within an enclosure that is `margin` away from the shape's bounding box on all
/// sides. Requires margin > 0. Errors: those of build_shape().
Result<Exterior> exterior_of(const Shape& shape, double margin);

/// The margin that options ask for: `margin`, or where that is 0 half of the box's longer side.
double margin_for(const Box& box, double margin);

/// The same. Errors: invalid_option, outside [1e-6, 1e6] of the box's diagonal.
Result<double> checked_margin_for(const Box& box, double margin);

}  // namespace medial
