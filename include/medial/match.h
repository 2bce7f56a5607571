#pragma once

// How alike two shapes are by their axes, however they are turned, mirrored or scaled.

#include <array>
#include <cstddef>

#include "medial/features.h"
#include "medial/shape.h"

namespace medial {

/// A shape in a few numbers without units, the same for its rotated, scaled and mirrored images:
/// distributions over the axis by their quantiles. Every piece of the axis counts by its length,
/// less where its erosion thickness is hardly more than noise of the boundary. Lengths are over the
/// root of the mean square of distances from the axis's centre.
struct ShapeSignature {
  static constexpr std::size_t quantiles = 24;
  using Quantiles = std::array<double, quantiles>;
  Quantiles center{};     ///< distances from the centre
  Quantiles pairs{};      ///< distances between two places of the axis
  Quantiles depth{};      ///< how far from the middle of the shape along the axis
  Quantiles radius{};     ///< radii, over their mean
  double thickness = 0;   ///< logarithm of the mean radius
  double length = 0;      ///< logarithm of the axis's length
  double ends = 0;        ///< log(1 + ends), each counted as its branch is
  double cycles = 0;      ///< log(1 + holes)
  double elongation = 0;  ///< logarithm of the quotient of the axes of inertia
};

/// The diagonal of a speck's bounding box at most, as a share of the square root of the area.
constexpr double speck_share = 0.1;

/// The shape without its specks, holes and components that are small against it: however small they
/// are, the axis goes around holes. Components stay where nothing else is there. O(n).
Shape without_specks(const Shape& shape, double share = speck_share);

/// O(edges log(edges)). `features` are the axis's own. Take the axis of without_specks().
ShapeSignature signature_of(const MedialAxis& axis, const AxisFeatures& features);

/// 0 for the same shape, about 1 for two shapes at random; symmetric.
double dissimilarity(const ShapeSignature& a, const ShapeSignature& b);

}  // namespace medial
