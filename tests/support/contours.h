#pragma once

// Smooth contours that several tests share.

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "medial/contour.h"
#include "support/generate.h"

namespace medial::test {

/// From the angle `start` once around, with half axes a along x and b along y.
inline Contour ellipse(double a, double b, double start = 0, Vec2 center = {0, 0}) {
  Contour contour;
  contour.ellipse_to(center, {a, 0}, {0, b}, start, start + 2 * std::numbers::pi);
  return contour;
}

/// A closed curve of 4 to 6 cubics whose tangent is continuous and whose curvature is not: the
/// inner control points are the corners of a random star, and pieces meet on every second edge of
/// it.
inline Contour smooth_outline(std::uint64_t seed) {
  Random random(seed);
  const auto pieces = static_cast<std::size_t>(random.integer(4, 6));
  const std::size_t n = 2 * pieces;
  std::vector<Vec2> star;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi / static_cast<double>(n) *
                         (static_cast<double>(i) + random.between(-0.4, 0.4));
    const double radius = random.between(0.4, 1);
    star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  std::vector<Vec2> joints;
  for (std::size_t i = 0; i < pieces; ++i)
    joints.push_back(star[2 * i + 1] +
                     random.between(0.2, 0.8) * (star[(2 * i + 2) % n] - star[2 * i + 1]));
  Contour contour;
  contour.start_at(joints[pieces - 1]);
  for (std::size_t i = 0; i < pieces; ++i)
    contour.bezier_to(std::array{star[2 * i], star[2 * i + 1], joints[i]});
  return contour;
}

}  // namespace medial::test
