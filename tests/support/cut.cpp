#include "support/cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/arc.h"
#include "verify/boundary_edge.h"

namespace medial::test {

double Cutter::depth_at(Vec2 p, Vec2 at, double deep) const {
  const double beyond = distance(p, at) - tip;
  if (beyond <= 0) return deep;
  return slope > 0 ? deep - beyond / slope : -std::numeric_limits<double>::infinity();
}

double Cutter::depth_at(Vec2 p, const std::vector<ToolPath>& paths) const {
  double deepest = 0;
  for (const ToolPath& path : paths)
    for (const ToolPoint& point : path.points)
      deepest = std::max(deepest, depth_at(p, point.point, -point.z));
  // Only moves that may reach deeper than their ends are looked at closely.
  for (const ToolPath& path : paths) {
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
      const ToolPoint &a = path.points[i], &b = path.points[i + 1];
      if (a.point == b.point) {
        deepest = std::max(deepest, depth_at(p, a.point, std::max(-a.z, -b.z)));
        continue;
      }
      if (a.z == b.z) {
        const BulgeArc move{a.point, b.point, a.bulge};
        const Vec2 nearest = verify_detail::point_at(move, verify_detail::foot_at(move, p));
        deepest = std::max(deepest, depth_at(p, nearest, -a.z));
        continue;
      }
      // The depth is a concave function along a straight move: thirds close in on its top.
      const auto at = [&](double t) {
        return depth_at(p, a.point + t * (b.point - a.point), -(a.z + t * (b.z - a.z)));
      };
      // No point of the move comes nearer than this.
      const double least =
          std::max(0.0, verify_detail::distance_to_segment(p, a.point, b.point) - tip);
      const double most = std::max(-a.z, -b.z);
      if (slope > 0 && most - least / slope <= deepest) continue;
      double low = 0, high = 1;
      for (int k = 0; k < 80; ++k) {
        const double t = low + (high - low) / 3, u = high - (high - low) / 3;
        (at(t) < at(u) ? low : high) = at(t) < at(u) ? t : u;
      }
      deepest = std::max({deepest, at(0), at(1), at(low)});
    }
  }
  return deepest;
}

}  // namespace medial::test
