#pragma once

// Smooth contours that several tests share.

#include <numbers>

#include "medial/contour.h"

namespace medial::test {

/// From the angle `start` once around, with half axes a along x and b along y.
inline Contour ellipse(double a, double b, double start = 0, Vec2 center = {0, 0}) {
  Contour contour;
  contour.ellipse_to(center, {a, 0}, {0, b}, start, start + 2 * std::numbers::pi);
  return contour;
}

}  // namespace medial::test
