#pragma once

#include <algorithm>
#include <cmath>

#include "medial/geometry.h"
#include "site/site.h"

namespace medial::site {

/// Whether the normal at the joint of two sites that join smoothly is taken from the second one.
inline bool by_second(const Site& first, const Site& second) {
  // The longer edge has the more accurate direction; its disks reach over the shorter edge by at
  // most turn * length. The disks of the rounder edge reach over the flatter one by at most turn^2
  // / (2 bend); if that is less, its normal is used.
  const double a = first.curvature, b = second.curvature, bend = std::abs(a - b);
  const bool edges = !first.is_vertex() && !second.is_vertex();
  const double shorter = std::min(first.length, second.length);
  const bool by_rounder = edges && std::max(a, b) > 0 &&
                          std::abs(cross(first.end_normal(), second.normal())) < 2 * bend * shorter;
  return by_rounder ? b > a : second.length > first.length;
}

/// The smooth joint of two consecutive sites: the point and the inward unit normal.
struct SmoothPlace {
  Vec2 point;
  Vec2 normal;
};
inline SmoothPlace smooth_place(const Site& before, const Site& after) {
  return {before.is_vertex() ? before.point : after.point,
          by_second(before, after) ? after.normal() : before.end_normal()};
}

}  // namespace medial::site
