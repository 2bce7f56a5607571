#pragma once

// How like two shapes are, by what their axes tell; whatever way they are turned, mirrored or
// scaled.

#include <array>
#include <cstddef>

#include "medial/features.h"

namespace medial {

/// A shape in a few numbers without units, the same for its rotated, scaled and mirrored images.
/// Lengths are over the square root of the shape's area. Five distributions over the axis, each by
/// its quantiles: every piece of the axis counts by its length times its radius, less where erosion
/// thickness tells that it stands for hardly more than noise of the boundary.
struct ShapeSignature {
  static constexpr std::size_t quantiles = 16;
  using Quantiles = std::array<double, quantiles>;
  Quantiles radius{};     ///< how thick the shape is, and where
  Quantiles center{};     ///< how far from its centre of gravity
  Quantiles depth{};      ///< how far from its middle along the axis
  Quantiles erosion{};    ///< how far it reaches out beyond the disk
  Quantiles angle{};      ///< sqrt(1 - (dR/ds)^2): 1 where sides are parallel
  double length = 0;      ///< of the axis, so weighted
  double ends = 0;        ///< log(1 + ends), each so weighted
  double cycles = 0;      ///< log(1 + holes)
  double elongation = 0;  ///< log of the half axes of inertia's quotient
};

/// O(edges log(edges)). `features` are the axis's own.
ShapeSignature signature_of(const MedialAxis& axis, const AxisFeatures& features);

/// How unlike two shapes are: 0 for the same, about 1 for shapes that have nothing in common; no
/// unit, symmetric.
double dissimilarity(const ShapeSignature& a, const ShapeSignature& b);

}  // namespace medial
