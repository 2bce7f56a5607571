#pragma once

#include "medial/shape.h"
#include "medial/vec2.h"

namespace medial {

/// How far two shapes are apart.
struct ShapeDistance {
  double area = 0;         ///< of the first
  double other_area = 0;   ///< of the second
  double from_first = 0;   ///< largest distance from the first's boundary to the second's
  double from_second = 0;  ///< and back
  Vec2 worst;              ///< where on a boundary the larger of the two is
  /// The Hausdorff distance of the two boundaries.
  double hausdorff() const { return from_first > from_second ? from_first : from_second; }
};

/// Measures both boundaries, at their vertices and at `samples` points inside each edge: a lower
/// bound, less than the distance of two samples too small. 0 where both are empty, infinite where
/// one is. O(n log n) expected.
ShapeDistance shape_distance(const Shape& first, const Shape& second, int samples = 7);

}  // namespace medial
