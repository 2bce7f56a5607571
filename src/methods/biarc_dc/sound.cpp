#include "methods/biarc_dc/sound.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "base/threads.h"
#include "methods/disks/boundary.h"
#include "site/bisector.h"

namespace medial::biarc_dc {
namespace {

/// In the local frame, which is about one unit large: rounding decides what smaller disks touch.
constexpr double narrow = 0x1p-26;

class Checker {
 public:
  Checker(const Skeleton& skeleton, const Context& context, double slack)
      : skeleton_(skeleton), outline_(context.outline), tree_(context.tree), slack_(slack) {
    for (std::uint32_t i = 0; i < outline_.sites.size() && !outline_.cutting_disks.empty(); ++i)
      if (outline_.is_cut(i)) parts_.push_back(i);
    std::sort(parts_.begin(), parts_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return outline_.originals[a] < outline_.originals[b];
    });
  }

  bool is_empty(const Disk& disk, std::uint32_t component) const {
    const SiteOutline::SiteRange cycle = outline_.cycles[component];
    return !tree_.nearest(disk.center, disk.radius - slack_, cycle.first, cycle.last);
  }
  bool is_right(const Skeleton::Bone& edge) const {
    const Disk &from = skeleton_.nodes[edge.from], &to = skeleton_.nodes[edge.to];
    if (!touches_both(edge, from) || !touches_both(edge, to) || !feet_advance(edge)) return false;
    // Two disks that are close to each other cover the disks between them, except for slivers.
    if (distance(from.center, to.center) < 0.5 * std::min(from.radius, to.radius)) return true;
    const Disk middle = middle_of(edge);
    return touches_both(edge, middle) && is_empty(middle, skeleton_.component[edge.from]);
  }
  /// An edge, as seen from one of its nodes.
  struct Way {
    std::uint32_t right, left;
  };
  /// The edges of all nodes, one node after another.
  struct Ways {
    std::vector<Way> list;
    std::vector<std::uint32_t> begin;

    std::span<Way> from(std::size_t node) {
      return std::span(list).subspan(begin[node], begin[node + 1] - begin[node]);
    }
  };
  Ways ways() const {
    Ways all{std::vector<Way>(2 * skeleton_.edges.size()),
             std::vector<std::uint32_t>(skeleton_.nodes.size() + 1)};
    for (const Skeleton::Bone& edge : skeleton_.edges)
      for (const std::uint32_t node : {edge.from, edge.to}) ++all.begin[node];
    std::partial_sum(all.begin.begin(), all.begin.end(), all.begin.begin());
    for (const Skeleton::Bone& edge : skeleton_.edges) {
      all.list[--all.begin[edge.from]] = {edge.right, edge.left};
      all.list[--all.begin[edge.to]] = {edge.left, edge.right};
    }
    return all;
  }
  /// Whether no edge is missing at a node: counter-clockwise around it, no site remains between the
  /// left site of one edge and the right site of the next one.
  bool are_all(std::uint32_t node, std::span<Way> ways) const {
    for (Way& way : ways) way = {part_at(way.right, node), part_at(way.left, node)};
    std::sort(ways.begin(), ways.end(),
              [](const Way& a, const Way& b) { return a.right < b.right; });
    for (std::size_t i = 0; i < ways.size(); ++i)
      if (!nothing_between(ways[i].left, ways[(i + 1) % ways.size()].right, node)) return false;
    return true;
  }
  /// Whether an edge may end in a disk: everything between its two sites is on the disk's circle,
  /// and some site there, or one of the two, is a convex arc.
  bool ends_at_arc(const Skeleton::Bone& edge, const Disk& leaf) const {
    return lies_on(leaf, edge.right, edge.left) || lies_on(leaf, edge.left, edge.right);
  }

 private:
  /// The part of a site, which cutting disks may have divided, that a node's disk touches.
  std::uint32_t part_at(std::uint32_t site, std::uint32_t node) const {
    const Disk& disk = skeleton_.nodes[node];
    if (!outline_.is_cut(site)) return site;
    const SiteOutline::SiteRange cycle = outline_.cycles[skeleton_.component[node]];
    if (touches_part(disk, site, cycle)) return site;
    const auto [begin, end] =
        std::equal_range(parts_.begin(), parts_.end(), site, [&](std::uint32_t a, std::uint32_t b) {
          return outline_.originals[a] < outline_.originals[b];
        });
    const auto part =
        std::find_if(begin, end, [&](std::uint32_t one) { return touches_part(disk, one, cycle); });
    return part == end ? site : *part;
  }
  /// Whether a disk touches a part of a site, and is in the range of directions of a vertex's copy.
  bool touches_part(const Disk& disk, std::uint32_t i, const SiteOutline::SiteRange& cycle) const {
    const site::Site& part = outline_.sites[i];
    if (!touches(disk, i)) return false;
    if (!part.is_vertex()) return true;
    const auto to_cut = [&](std::uint32_t before) {
      return outline_.cutting_disks[outline_.disk_after[before]].center - part.point;
    };
    const std::uint32_t before = i == cycle.first ? cycle.last : i - 1, after = next(i, cycle);
    const Vec2 first =
        outline_.disk_after[before] == none ? outline_.sites[before].end_normal() : to_cut(before);
    const Vec2 last = outline_.disk_after[i] == none ? outline_.sites[after].normal() : to_cut(i);
    return disks::in_wedge(first, last, disk.center - part.point);
  }
  bool touches(const Disk& disk, std::uint32_t site) const {
    return std::abs(site::gap(outline_.sites[site], disk)) <= 2 * slack_;
  }
  /// Whether a node's disk touches everything from one touched site to the next, or is a point in a
  /// convex corner.
  bool nothing_between(std::uint32_t first, std::uint32_t last, std::uint32_t node) const {
    const Disk& disk = skeleton_.nodes[node];
    const SiteOutline::SiteRange cycle = outline_.cycles[skeleton_.component[node]];
    if (disk.radius == 0)
      return outline_.joints[first] == Joint::corner && next(first, cycle) == last;
    // A cutting disk that is a node touches both parts of a site at one point.
    if (outline_.originals[first] == outline_.originals[last] && outline_.is_cut(first) &&
        outline_.is_cut(last) && !lies_on_circle(disk, first))
      return true;
    while (first != last) {
      const bool is_joined = outline_.disk_after[first] == none;
      // No leaf leads into a blunt joint: a disk that touches both its edges may miss the point
      // itself.
      const bool is_blunt = is_joined && outline_.joints[first] == Joint::blunt;
      if (is_joined && !is_blunt && !is_on(disk, outline_.sites[first].end())) return false;
      first = next(first, cycle);
      if (first == last) break;
      if (!touches(disk, first) ||
          (outline_.sites[first].curvature > 0 && !lies_on_circle(disk, first)))
        return false;
    }
    return true;
  }
  bool is_on(const Disk& disk, Vec2 p) const {
    return std::abs(distance(p, disk.center) - disk.radius) <= 2 * slack_;
  }
  bool lies_on_circle(const Disk& disk, std::uint32_t i) const {
    const site::Site& one = outline_.sites[i];
    return is_on(disk, one.point) && is_on(disk, one.at(0.5 * one.length)) &&
           is_on(disk, one.end());
  }
  static std::uint32_t next(std::uint32_t site, const SiteOutline::SiteRange& cycle) {
    return site == cycle.last ? cycle.first : site + 1;
  }

  /// Whether the feet move forward on the right site and backward on the left one, within the
  /// tolerance.
  bool feet_advance(const Skeleton::Bone& edge) const {
    const Vec2 from = skeleton_.nodes[edge.from].center, to = skeleton_.nodes[edge.to].center;
    const double slack = 4 * slack_;
    return site::foot_advances(outline_.sites[edge.right], from, to, slack) &&
           site::foot_advances(outline_.sites[edge.left], to, from, slack);
  }
  /// The disk at the middle of an edge.
  Disk middle_of(const Skeleton::Bone& edge) const {
    const Disk &from = skeleton_.nodes[edge.from], &to = skeleton_.nodes[edge.to];
    const auto control =
        site::control_of(outline_.sites[edge.left], outline_.sites[edge.right], from, to);
    const double scale = 0.5 / (1 + control.weight), inner = 2 * control.weight;
    return {scale * (from.center + to.center + inner * control.point.center),
            scale * (from.radius + to.radius + inner * control.point.radius)};
  }
  /// Both must be touched from the inside. Edges at one part of a cut site may extend to the other
  /// part.
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
    bool has_arc = false;
    for (const std::uint32_t side : {first, last})
      has_arc |= outline_.sites[side].curvature > 0 && lies_on_circle(disk, side);
    for (int step = 0; step < most_steps; ++step) {
      first = first == cycle->last ? cycle->first : first + 1;
      if (first == last) return has_arc;
      if (!lies_on_circle(disk, first)) return false;
      has_arc |= outline_.sites[first].curvature > 0;
    }
    return false;
  }

  const Skeleton& skeleton_;
  const SiteOutline& outline_;
  const site::BoundaryTree& tree_;
  double slack_;
  std::vector<std::uint32_t> parts_;  ///< sites next to cutting disks, sorted by their originals
};

/// Whether holds(i) is true for all i below `count`.
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
  Checker::Ways ways = checker.ways();
  const auto has_all_edges = [&](std::size_t i) {
    return checker.are_all(static_cast<std::uint32_t>(i), ways.from(i));
  };
  return corner_count(context.outline) == corners && all_of(skeleton.nodes.size(), is_node_right) &&
         all_of(skeleton.edges.size(), is_edge_right) &&
         all_of(skeleton.nodes.size(), has_all_edges);
}

}  // namespace medial::biarc_dc
