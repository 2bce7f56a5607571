#pragma once

#include <cstdint>
#include <vector>

#include "medial/shape.h"

namespace medial {

/// The exterior of a shape: a rectangular enclosure minus the shape.
struct Exterior {
  Shape shape;
  /// Of each point: whether it belongs to the enclosure. The sources of the other points are those
  /// of the original shape's points.
  std::vector<bool> of_enclosure;
  /// Of each point: the loop of the original shape that it was on; 0xFFFFFFFF for the enclosure's.
  std::vector<std::uint32_t> of_loop;
};

/// The exterior within an enclosure that is `margin` away from the shape's bounding box on all
/// sides. Requires margin > 0. Errors: those of build_shape().
Result<Exterior> exterior_of(const Shape& shape, double margin);

/// The smallest distance from the enclosure, in spacings of doubles. With less, rounding could move
/// the enclosure onto the shape, or its corners onto each other.
constexpr double least_room = 1024;

/// The smallest margin: a share of the box, but at least `least_room`.
double least_margin_for(const Box& box);

/// The margin for an option: `margin`, or half of the box's longer side if it is 0; at least the
/// smallest margin.
double margin_for(const Box& box, double margin);

/// The same. Errors: invalid_option (below the smallest margin, or above 1e6 diagonals of the box).
Result<double> checked_margin_for(const Box& box, double margin);

}  // namespace medial
