#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "medial/shape.h"

namespace medial {

/// The one tolerance of a computation, in units of the input: disks with residuals below it touch.
///
/// `relative` is the user's, against the diagonal; 0 asks for the default, 4e-15, which is some
/// sixteen roundings of a coordinate of the diagonal's size. No tolerance is smaller than twice the
/// spacing of doubles at the largest coordinate: the input itself is not known better.
inline double tolerance_for(const Box& box, double relative) {
  constexpr double default_relative = 4e-15;
  const double largest = std::max(
      {std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
  const double spacing = largest * std::numeric_limits<double>::epsilon();
  return std::max((relative > 0 ? relative : default_relative) * diagonal(box), 2 * spacing);
}

}  // namespace medial
