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

/// In spacings of doubles: with less room, rounding moves an enclosure onto what it encloses, or
/// its own corners onto each other.
constexpr double least_room = 1024;

/// The least margin: a share of the box, and no less than that room.
double least_margin_for(const Box& box);

/// The margin that options ask for: `margin`, or where that is 0 half of the box's longer side, and
/// not less than the least one.
double margin_for(const Box& box, double margin);

/// The same. Errors: invalid_option, below the least one or above 1e6 of the box's diagonal.
Result<double> checked_margin_for(const Box& box, double margin);

}  // namespace medial
