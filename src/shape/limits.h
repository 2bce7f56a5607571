#pragma once

// What coordinates the library takes: one pair of numbers for the engines and the certificate.

#include <cmath>
#include <optional>

#include "medial/error.h"
#include "medial/planar_graph.h"
#include "medial/shape.h"

namespace medial {

/// No coordinate may be larger than this in size,
constexpr double largest_coordinate = 1e100;
/// and none but zero smaller than this in size, or than this share of the largest coordinate.
///
/// Different coordinates then differ by their spacing at least: 1e-116 in units of the input, and
/// in the local frame, where the largest is about 1, as well. So the squares of all differences and
/// the products of any two of them lie between 1e-232 and 1e201 (or are zero): nothing that is
/// divided by them overflows or vanishes.
constexpr double smallest_coordinate = 1e-100;

/// Whether a finite coordinate is within them.
inline bool is_within_limits(double value) {
  const double size = std::abs(value);
  return size <= largest_coordinate && (size == 0 || size >= smallest_coordinate);
}

/// The first coordinate of a shape that is beyond the limits, as an error `unsupported` with its
/// place; none where all are within them. O(n).
std::optional<Error> beyond_limits(const Shape& shape);

/// The same of a planar graph and a box around it.
std::optional<Error> beyond_limits(const PlanarGraph& planar_graph, const Box& box);

}  // namespace medial
