#include "methods/biarc_dc/sound.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/threads.h"
#include "site/bisector.h"

namespace medial::biarc_dc {
namespace {

/// Disks smaller than this, of a local frame about one unit large, are where rounding decides.
constexpr double narrow = 0x1p-26;

class Checker {
 public:
  Checker(const Skeleton& skeleton, const Context& context, double slack)
      : skeleton_(skeleton), outline_(context.outline), tree_(context.tree), slack_(slack) {}

  bool is_empty(const Disk& disk, std::uint32_t component) const {
    const SiteOutline::SiteRange cycle = outline_.cycles[component];
    return !tree_.nearest(disk.center, disk.radius - slack_, cycle.first, cycle.last);
  }
  bool is_right(const Skeleton::Bone& edge) const {
    const Disk &from = skeleton_.nodes[edge.from], &to = skeleton_.nodes[edge.to];
    if (!touches_both(edge, from) || !touches_both(edge, to) || !feet_advance(edge)) return false;
    // Two disks near to each other cover those between them, but for slivers.
    if (distance(from.center, to.center) < 0.5 * std::min(from.radius, to.radius)) return true;
    const Disk middle = middle_of(edge);
    return touches_both(edge, middle) && is_empty(middle, skeleton_.component[edge.from]);
  }
  /// Whether an edge may end in a disk: all that lies between its two sites lies on the disk's
  /// circle, and one of that, or of the two, is a convex arc.
  bool ends_at_arc(const Skeleton::Bone& edge, const Disk& leaf) const {
    return lies_on(leaf, edge.right, edge.left) || lies_on(leaf, edge.left, edge.right);
  }

 private:
  /// Whether the feet move forward on the right site and backward on the left one, but for what the
  /// tolerance leaves open.
  bool feet_advance(const Skeleton::Bone& edge) const {
    const auto advances = [&](const site::Site& site, Vec2 a, Vec2 b) {
      const double open = 4 * slack_;
      // Round a vertex, normals turn to the right.
      if (site.is_vertex())
        return cross(b - site.point, a - site.point) >= -open * distance(site.point, a);
      // Next to an arc's centre, feet are less certain than centres.
      const double size =
          std::min(site::view_of_arc(site, a).size, site::view_of_arc(site, b).size);
      return (site::carrier_parameter(site, b) - site::carrier_parameter(site, a)) * size >= -open;
    };
    const Vec2 from = skeleton_.nodes[edge.from].center, to = skeleton_.nodes[edge.to].center;
    return advances(outline_.sites[edge.right], from, to) &&
           advances(outline_.sites[edge.left], to, from);
  }
  /// The disk in the middle of an edge.
  Disk middle_of(const Skeleton::Bone& edge) const {
    const Disk &from = skeleton_.nodes[edge.from], &to = skeleton_.nodes[edge.to];
    const auto control =
        site::control_of(outline_.sites[edge.left], outline_.sites[edge.right], from, to);
    const double scale = 0.5 / (1 + control.weight), inner = 2 * control.weight;
    return {scale * (from.center + to.center + inner * control.point.center),
            scale * (from.radius + to.radius + inner * control.point.radius)};
  }
  /// From the inside. Edges at one part of a cut site may have grown into the other.
  bool touches_both(const Skeleton::Bone& edge, const Disk& disk) const {
    const auto touches = [&](std::uint32_t site) {
      const site::Site& own = outline_.sites[site];
      const auto is_radius = [&](double away) { return std::abs(away - disk.radius) <= slack_; };
      return is_radius(site::carrier_distance(own, disk.center)) &&
             (outline_.is_cut(site) ||
              is_radius(std::sqrt(site::squared_distance(own, disk.center))));
    };
    return touches(edge.right) && touches(edge.left);
  }
  bool lies_on(const Disk& disk, std::uint32_t first, std::uint32_t last) const {
    constexpr int most_steps = 64;
    const auto cycle =
        std::find_if(outline_.cycles.begin(), outline_.cycles.end(),
                     [&](const SiteOutline::SiteRange& c) { return first <= c.last; });
    const auto touches = [&](Vec2 p) {
      return std::abs(distance(p, disk.center) - disk.radius) <= 2 * slack_;
    };
    const auto is_on = [&](const site::Site& one) {
      return touches(one.point) && touches(one.at(0.5 * one.length)) && touches(one.end());
    };
    bool has_arc = false;
    for (const std::uint32_t side : {first, last})
      has_arc |= outline_.sites[side].curvature > 0 && is_on(outline_.sites[side]);
    for (int step = 0; step < most_steps; ++step) {
      first = first == cycle->last ? cycle->first : first + 1;
      if (first == last) return has_arc;
      if (!is_on(outline_.sites[first])) return false;
      has_arc |= outline_.sites[first].curvature > 0;
    }
    return false;
  }

  const Skeleton& skeleton_;
  const SiteOutline& outline_;
  const site::BoundaryTree& tree_;
  double slack_;
};

/// Whether holds(i) for all i below `count`.
template <class Holds>
bool all_of(std::size_t count, const Holds& holds) {
  constexpr std::size_t grain = 2048;
  std::atomic<bool> all = true;
  parallel_ranges(count, grain, [&](std::size_t i, std::size_t end) {
    for (; i < end && all; ++i)
      if (!holds(i)) all = false;
  });
  return all;
}

std::ptrdiff_t corner_count(const SiteOutline& outline) {
  std::ptrdiff_t corners = 0;
  for (std::size_t i = 0; i < outline.sites.size(); ++i)
    corners += outline.disk_after[i] == none && outline.joints[i] == Joint::corner ? 1 : 0;
  return corners;
}

}  // namespace

bool is_sound(const Skeleton& skeleton, const Context& context, double slack) {
  const Checker checker(skeleton, context, slack);
  std::vector<std::uint8_t> degree(skeleton.nodes.size());
  for (const Skeleton::Bone& edge : skeleton.edges)
    for (const std::uint32_t node : {edge.from, edge.to})
      if (degree[node] < 2) ++degree[node];
  const auto corners = std::count_if(skeleton.nodes.begin(), skeleton.nodes.end(),
                                     [](const Disk& disk) { return disk.radius == 0; });
  const auto is_node_right = [&](std::size_t i) {
    const Disk& disk = skeleton.nodes[i];
    if (disk.radius == 0) return degree[i] == 1;
    return disk.radius > narrow && checker.is_empty(disk, skeleton.component[i]);
  };
  const auto is_edge_right = [&](std::size_t i) {
    const Skeleton::Bone& edge = skeleton.edges[i];
    for (const std::uint32_t node : {edge.from, edge.to})
      if (const Disk& disk = skeleton.nodes[node];
          degree[node] == 1 && disk.radius > 0 && !checker.ends_at_arc(edge, disk))
        return false;
    return checker.is_right(edge);
  };
  return corner_count(context.outline) == corners && all_of(skeleton.nodes.size(), is_node_right) &&
         all_of(skeleton.edges.size(), is_edge_right);
}

}  // namespace medial::biarc_dc
