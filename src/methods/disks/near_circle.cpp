#include "methods/disks/near_circle.h"

#include <algorithm>
#include <cmath>

#include "base/compat.h"

namespace medial::disks {

bool is_own_circle(const site::Site& site, const Disk& disk, double slack) {
  constexpr double alike = 0x1p-33;
  const auto is_on_disk = [&](Vec2 p) {
    return std::abs(distance(p, disk.center) - disk.radius) <= slack;
  };
  return site.curvature > 0 &&
         std::abs(site.curvature * disk.radius - 1) <= std::min(slack * site.curvature, alike) &&
         is_on_disk(site.point) && is_on_disk(site.end());
}

namespace {

/// Whether an edge's end is the own circle of arcs of several edges of the input, which the axis
/// goes no further into: the sites from one to another one.
bool ends_in_several_arcs(const Boundary& boundary, std::uint32_t first, std::uint32_t last,
                          const Disk& end, double slack) {
  return boundary.originals[first] != boundary.originals[last] &&
         is_own_circle(boundary.sites[first], end, slack);
}

}  // namespace

bool is_in_centers(const Boundary& boundary, const Graph& graph, double slack) {
  if (!boundary.has_arcs) return false;
  return ranges::any_of(graph.edges, [&](const Edge& edge) {
    const auto [left, right] = edge.site;
    const Disk &from = graph.nodes[edge.node[0]].disk, &to = graph.nodes[edge.node[1]].disk;
    for (const std::uint32_t i : {left, right})
      if (is_own_circle(boundary.sites[i], to, slack) &&
          is_own_circle(boundary.sites[i], from, slack))
        return true;
    // The walk leads from where the run's ends are into the range between the two sites.
    const Boundary::SiteRange& run =
        *ranges::lower_bound(boundary.runs, left, {}, &Boundary::SiteRange::last);
    const std::uint32_t behind = left < run.last ? left + 1 : run.first,
                        before = right > run.first ? right - 1 : run.last;
    return (right + 1 < left && ends_in_several_arcs(boundary, right + 1, left - 1, to, slack)) ||
           (behind != right && ends_in_several_arcs(boundary, behind, before, from, slack));
  });
}

}  // namespace medial::disks
