#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "medial/geometry.h"

namespace medial {

/// The largest absolute coordinate of a box, and the spacing of doubles there.
inline double largest_coordinate_in(const Box& box) {
  return std::max(
      {std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
}
inline double spacing_in(const Box& box) {
  return largest_coordinate_in(box) * std::numeric_limits<double>::epsilon();
}

/// The tolerance of a computation, in units of the input. A disk touches a site if its residual is
/// below the tolerance.
///
/// `relative` is the user's tolerance relative to the diagonal; 0 stands for the default of 4e-15,
/// about sixteen roundings of a coordinate as large as the diagonal. The result is at least twice
/// the spacing of doubles at the largest coordinate, because the input is no more precise.
inline double tolerance_for(const Box& box, double relative) {
  constexpr double default_relative = 4e-15;
  const double judged = relative > 0 ? relative : default_relative;
  return std::max(judged * diagonal(box), 2 * spacing_in(box));
}

/// Converts a tolerance to Options::tolerance, relative to this box.
constexpr double largest_relative_tolerance = 1e-3;
inline double relative_tolerance(double tolerance, const Box& box) {
  return std::min(largest_relative_tolerance, tolerance / diagonal(box));
}

}  // namespace medial
