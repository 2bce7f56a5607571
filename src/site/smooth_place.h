#pragma once

#include <algorithm>
#include <cmath>

#include "medial/geometry.h"
#include "site/site.h"

namespace medial::site {

/// Of two sites, one after the other, that join smoothly, whether the normal of the second one
/// counts for both.
inline bool by_second(const Site& first, const Site& second) {
  // Of two edges the longer one knows its direction better, and its disks reach over the shorter
  // one by turn * length at most. The rounder one's reach over the flatter one by turn^2 / (2 bend)
  // at most: its normal counts where that is less.
  const double a = first.curvature, b = second.curvature, bend = std::abs(a - b);
  const bool edges = !first.is_vertex() && !second.is_vertex();
  const double shorter = std::min(first.length, second.length);
  const bool by_rounder = edges && std::max(a, b) > 0 &&
                          std::abs(cross(first.end_normal(), second.normal())) < 2 * bend * shorter;
  return by_rounder ? b > a : second.length > first.length;
}

/// Where two sites, one after the other, join smoothly: the point and the inward unit normal.
struct SmoothPlace {
  Vec2 point;
  Vec2 normal;
};
inline SmoothPlace smooth_place(const Site& before, const Site& after) {
  return {before.is_vertex() ? before.point : after.point,
          by_second(before, after) ? after.normal() : before.end_normal()};
}

}  // namespace medial::site
