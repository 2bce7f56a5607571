#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "medial/geometry.h"

namespace medial {

/// The largest coordinate of a box, in size, and the spacing of doubles there.
inline double largest_coordinate_in(const Box& box) {
  return std::max(
      {std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
}
inline double spacing_in(const Box& box) {
  return largest_coordinate_in(box) * std::numeric_limits<double>::epsilon();
}

/// The one tolerance of a computation, in units of the input: disks with residuals below it touch.
///
/// `relative` is the user's, against the diagonal; 0 asks for the default, 4e-15, which is some
/// sixteen roundings of a coordinate of the diagonal's size. No tolerance is smaller than twice the
/// spacing of doubles at the largest coordinate: the input itself is not known better.
inline double tolerance_for(const Box& box, double relative) {
  constexpr double default_relative = 4e-15;
  const double judged = relative > 0 ? relative : default_relative;
  return std::max(judged * diagonal(box), 2 * spacing_in(box));
}

/// A tolerance as Options::tolerance of what lies in this box.
constexpr double largest_relative_tolerance = 1e-3;
inline double relative_tolerance(double tolerance, const Box& box) {
  return std::min(largest_relative_tolerance, tolerance / diagonal(box));
}

}  // namespace medial
