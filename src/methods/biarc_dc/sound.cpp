#include "methods/biarc_dc/sound.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>

#include "base/threads.h"
#include "site/bisector.h"

namespace medial::biarc_dc {
namespace {

constexpr std::size_t grain = 2048;

bool is_empty(const Context& context, const Disk& disk, std::uint32_t component, double slack) {
  const SiteOutline::SiteRange cycle = context.outline.cycles[component];
  return !context.tree.nearest(disk.center, disk.radius - slack, cycle.first, cycle.last);
}

/// Whether a cutting disk has divided a site: edges at one part may have grown into the other.
bool is_cut(const SiteOutline& outline, std::uint32_t site) {
  return outline.disk_after[site] != none || (site > 0 && outline.disk_after[site - 1] != none);
}

bool touches_both(const Context& context, const Skeleton& skeleton, const Skeleton::Bone& edge,
                  double slack) {
  for (const std::uint32_t node : {edge.from, edge.to})
    for (const std::uint32_t site : {edge.right, edge.left}) {
      const Disk& disk = skeleton.nodes[node];
      const site::Site& own = context.outline.sites[site];
      const double away = is_cut(context.outline, site)
                              ? site::carrier_distance(own, disk.center)
                              : std::sqrt(site::squared_distance(own, disk.center));
      if (!(std::abs(away - disk.radius) <= slack)) return false;
    }
  return true;
}

/// The disk in the middle of an edge.
Disk middle_of(const Context& context, const Skeleton& skeleton, const Skeleton::Bone& edge) {
  const Disk &from = skeleton.nodes[edge.from], &to = skeleton.nodes[edge.to];
  const auto control = site::control_of(context.outline.sites[edge.left],
                                        context.outline.sites[edge.right], from, to);
  const double scale = 0.5 / (1 + control.weight), inner = 2 * control.weight;
  return {scale * (from.center + to.center + inner * control.point.center),
          scale * (from.radius + to.radius + inner * control.point.radius)};
}

/// Whether holds(i) for all i below `count`.
template <class Holds>
bool all_of(std::size_t count, const Holds& holds) {
  std::atomic<bool> all = true;
  parallel_ranges(count, grain, [&](std::size_t i, std::size_t end) {
    for (; i < end && all; ++i)
      if (!holds(i)) all = false;
  });
  return all;
}

}  // namespace

bool is_sound(const Skeleton& skeleton, const Context& context, double slack) {
  const SiteOutline& outline = context.outline;
  std::ptrdiff_t corners = 0;
  for (std::size_t i = 0; i < outline.sites.size(); ++i)
    corners += outline.disk_after[i] == none && outline.joints[i] == Joint::corner ? 1 : 0;
  const auto leaves = std::count_if(skeleton.nodes.begin(), skeleton.nodes.end(),
                                    [](const Disk& disk) { return disk.radius == 0; });
  const auto is_right = [&](std::size_t i) {
    const Skeleton::Bone& edge = skeleton.edges[i];
    if (!touches_both(context, skeleton, edge, slack)) return false;
    return outline.cutting_disks.empty() || is_empty(context, middle_of(context, skeleton, edge),
                                                     skeleton.component[edge.from], slack);
  };
  return corners == leaves && all_of(skeleton.edges.size(), is_right) &&
         all_of(skeleton.nodes.size(), [&](std::size_t i) {
           return is_empty(context, skeleton.nodes[i], skeleton.component[i], slack);
         });
}

}  // namespace medial::biarc_dc
