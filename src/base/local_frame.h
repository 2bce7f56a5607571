#pragma once

#include <algorithm>
#include <cmath>

#include "base/tolerance.h"
#include "medial/geometry.h"

namespace medial {

/// A local frame in which a shape is about one unit large and close to the origin. Mapping a point
/// of the input to the frame is exact (a subtraction that does not round, then a power of two), and
/// so is mapping it back.
struct LocalFrame {
  Vec2 origin;
  double scale = 1;    ///< local units per input unit: a power of two
  double inverse = 1;  ///< 1 / scale

  Vec2 to_local(Vec2 p) const { return {scale * (p.x - origin.x), scale * (p.y - origin.y)}; }
  Vec2 to_input(Vec2 p) const { return {inverse * p.x + origin.x, inverse * p.y + origin.y}; }
};

namespace detail {
/// An origin for one axis such that subtracting it from any number in [low, high] is exact. By
/// Sterbenz's lemma, this holds if high <= 2 low (or mirrored); otherwise the origin is zero.
inline double exact_origin(double low, double high) {
  if (low > 0 && high <= 2 * low) return low;
  if (high < 0 && low >= 2 * high) return high;
  return 0;
}
}  // namespace detail

/// The frame for a box. If the box is away from zero, its larger side has a local length in [1, 2);
/// otherwise, the largest local coordinate is in [1, 2).
inline LocalFrame frame_of(const Box& box) {
  LocalFrame frame;
  frame.origin = {detail::exact_origin(box.low.x, box.high.x),
                  detail::exact_origin(box.low.y, box.high.y)};
  const double extent = std::max(
      std::max(std::abs(box.low.x - frame.origin.x), std::abs(box.high.x - frame.origin.x)),
      std::max(std::abs(box.low.y - frame.origin.y), std::abs(box.high.y - frame.origin.y)));
  int exponent = 0;
  std::frexp(extent, &exponent);
  // Both the scale and its inverse must be normal numbers.
  exponent = std::min(1000, std::max(-1000, exponent - 1));
  frame.scale = std::ldexp(1.0, -exponent);
  frame.inverse = std::ldexp(1.0, exponent);
  return frame;
}

/// An upper bound of the radii of all disks inside the shape: half of the box's smaller side, plus
/// an allowance for rounding and for the spacing of the coordinates, by which the extreme point of
/// an arc on each side may be off.
inline double radius_limit(const Box& box, const LocalFrame& frame) {
  const double width = box.high.x - box.low.x, height = box.high.y - box.low.y;
  return frame.scale * (0.5 * std::min(width, height) * (1 + 0x1p-20) + spacing_in(box));
}

}  // namespace medial
