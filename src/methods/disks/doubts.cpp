#include "methods/disks/doubts.h"

#include <cmath>

#include "base/memory.h"

namespace medial::disks {

namespace {

/// Notes the sites that disks at the tips of branches reach over. Where arcs lie on one circle up
/// to rounding, a disk in their centre may touch each of them within the tolerance in turn, and
/// reach over others by more.
void find_intruders(const Boundary& boundary, const site::BoundaryTree& tree, double slack,
                    Graph& graph) {
  const WorkVector<std::uint8_t> degree = degrees_of(graph);
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const auto& [disk, component, kind] = graph.nodes[i];
    if (degree[i] == 2 || disk.radius <= slack) continue;
    const Boundary::SiteRange& run = boundary.runs[component];
    if (const auto hit = tree.nearest(disk.center, disk.radius - slack, run.first, run.last))
      graph.lost.push_back(hit.site);
  }
}

/// Whether the foot on a site moves forward from one disk to another, by the sides of directions.
bool moves_forward(const site::Site& s, Vec2 from, Vec2 to) {
  const Vec2 first = from - s.point, last = to - s.point;
  if (s.is_vertex()) return cross(last, first) > 0;  // round a vertex, normals turn to the right
  if (!s.is_arc()) return dot(s.direction, to - from) > 0;
  const Vec2 normal = s.normal();
  return s.curvature * cross(normal - s.curvature * first, normal - s.curvature * last) > 0;
}

/// Whether an edge may run backward along its sites. Next to the centre of an arc, rounding decides
/// that of an edge no longer than `slack`.
bool may_run_backward(const site::Site& left, const site::Site& right, Vec2 from, Vec2 to,
                      double slack) {
  if (squared_norm(to - from) > slack * slack)
    return !(moves_forward(right, from, to) && moves_forward(left, to, from)) &&
           !(site::foot_advances(right, from, to, slack) &&
             site::foot_advances(left, to, from, slack));
  constexpr double far = 64;
  const auto is_open = [&](const site::Site& s) {
    return s.is_arc() && std::abs(site::carrier_parameter(s, to) -
                                  site::carrier_parameter(s, from)) > far * slack;
  };
  return is_open(left) || is_open(right) || !site::foot_advances(right, from, to, slack) ||
         !site::foot_advances(left, to, from, slack);
}

/// Notes the edges next to arcs that may run backward: what the walk takes for one node leaves open
/// where its disk is, and so in which direction edges lead from there.
void find_backward(const Boundary& boundary, double slack, Graph& graph) {
  for (const Edge& edge : graph.edges) {
    const auto [from, to] = edge.node;
    if (may_run_backward(boundary.sites[edge.site[0]], boundary.sites[edge.site[1]],
                         graph.nodes[from].disk.center, graph.nodes[to].disk.center, slack))
      graph.lost.push_back(edge.site[0]);
  }
}

}  // namespace

void find_doubts(const Boundary& boundary, const site::BoundaryTree& tree, double tolerance,
                 Graph& graph) {
  find_intruders(boundary, tree, 2 * tolerance, graph);
  // A diagram is measured as a whole.
  if (boundary.sides == Sides::one) find_backward(boundary, 4 * tolerance, graph);
}

}  // namespace medial::disks
