#include "papers/aichholzer_2009/stability.h"

#include <algorithm>
#include <cmath>

#include "medial/query.h"

namespace medial::papers {

Stability stability(const MedialAxis& exact, const MedialAxis& axis, double epsilon) {
  constexpr double largest_cosine = 0.5;
  const AxisLocator locator(axis);
  Stability found;
  for (const Edge& edge : exact.edges)
    for (const double t : {0.25, 0.5, 0.75}) {
      const Disk disk = disk_at(exact, edge, t);
      const Vec2 one = foot(exact.sites[edge.site[0]], disk.center) - disk.center,
                 other = foot(exact.sites[edge.site[1]], disk.center) - disk.center;
      const double cosine = dot(one, other) / (norm(one) * norm(other));
      if (!(cosine <= largest_cosine)) continue;
      const double half = std::sqrt(0.5 * (1 + std::max(-1.0, cosine)));  // cos(xi / 2)
      const double away = locator.nearest(disk.center).distance;
      ++found.points;
      found.largest = std::max(found.largest, away);
      found.worst_share = std::max(found.worst_share, away * (1 - half) / (4 * epsilon));
    }
  return found;
}

}  // namespace medial::papers
