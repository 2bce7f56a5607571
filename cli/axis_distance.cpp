#include "cli/axis_distance.h"

#include <algorithm>

namespace medial::cli {

AxisDistance distance_between(const MedialAxis& axis, const MedialAxis& exact, double step,
                              double leaf) {
  AxisDistance result;
  if (axis.edges.empty() || exact.edges.empty()) return result;
  const AxisLocator to_exact(exact), to_axis(axis);
  double weight = 0;
  for (const Edge& edge : axis.edges) {
    const std::vector<Disk> samples = sample_by_step(axis, edge, step);
    const double share = length(axis, edge) / static_cast<double>(samples.size());
    for (const Disk& disk : samples) {
      const AxisPoint nearest = to_exact.nearest(disk.center);
      result.largest = std::max(result.largest, nearest.distance);
      result.mean += share * nearest.distance;
      weight += share;
      if (nearest.distance <= result.away) continue;
      const bool near_leaf =
          std::any_of(exact.nodes.begin(), exact.nodes.end(), [&](const Node& node) {
            return node.kind == NodeKind::leaf && distance(node.disk.center, disk.center) < leaf;
          });
      if (!near_leaf) result.away = nearest.distance;
    }
  }
  if (weight > 0) result.mean /= weight;
  for (const Edge& edge : exact.edges)
    for (const Disk& disk : sample_by_step(exact, edge, step))
      result.uncovered = std::max(result.uncovered, to_axis.nearest(disk.center).distance);
  return result;
}

}  // namespace medial::cli
