#pragma once

#include <algorithm>
#include <vector>

#include "medial/geometry.h"

namespace medial {

/// The convex hull of points, counter-clockwise, without collinear points (Andrew's monotone
/// chain). O(n log n).
inline std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Vec2> hull;
  for (const bool back : {false, true}) {
    const std::size_t first = hull.size();
    for (const Vec2 p : points) {
      while (hull.size() >= first + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    if (!back) std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace medial
