#pragma once

// The limits of coordinates, for the engines and the certificate.

#include <cmath>
#include <optional>

#include "medial/error.h"
#include "medial/planar_graph.h"
#include "medial/shape.h"

namespace medial {

/// The largest absolute coordinate.
constexpr double largest_coordinate = 1e100;
/// The smallest absolute coordinate other than zero, both absolute and relative to the largest one.
///
/// Different coordinates then differ by at least their spacing: 1e-116, both in units of the input
/// and in the local frame, where the largest coordinate is about 1. So the squares of all
/// differences and their products are zero or between 1e-232 and 1e201, and quotients by them
/// neither overflow nor underflow.
constexpr double smallest_coordinate = 1e-100;

/// Whether a finite coordinate is within the limits.
inline bool is_within_limits(double value) {
  const double size = std::abs(value);
  return size <= largest_coordinate && (size == 0 || size >= smallest_coordinate);
}

/// An error `unsupported` with the place of the first coordinate of a shape beyond the limits; none
/// if all are within them. O(n).
std::optional<Error> beyond_limits(const Shape& shape);

/// The same for a planar graph and a box around it.
std::optional<Error> beyond_limits(const PlanarGraph& planar_graph, const Box& box);

}  // namespace medial
