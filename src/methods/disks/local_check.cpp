#include "methods/disks/local_check.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/compat.h"
#include "site/bisector.h"

namespace medial::disks {
namespace {

class LocalCheck {
 public:
  LocalCheck(const Boundary& boundary, const site::BoundaryTree& tree, const Graph& graph,
             double tolerance)
      : boundary_(boundary), tree_(tree), graph_(graph), tolerance_(tolerance) {}

  bool holds_around(std::span<const std::uint32_t> sites) {
    std::vector<bool> named(boundary_.sites.size(), false);
    for (const std::uint32_t site : sites) named[site] = true;
    std::vector<bool> at_end(graph_.nodes.size(), false);
    for (const Edge& link : graph_.edges) {
      if (!named[link.site[0]] && !named[link.site[1]]) continue;
      if (!is_right(link)) return false;
      at_end[link.node[0]] = at_end[link.node[1]] = true;
    }
    std::vector<Way> ways;
    for (const Edge& link : graph_.edges)
      for (const std::size_t end : {0, 1})
        if (at_end[link.node[end]])
          ways.push_back({link.node[end], link.site[1 - end], link.site[end]});
    return !ways.empty() && are_all_ways(ways);
  }

 private:
  /// An edge as it leaves a node.
  struct Way {
    std::uint32_t node, right, left;
  };

  const site::Site& site(std::uint32_t i) const { return boundary_.sites[i]; }
  const Disk& disk(std::uint32_t node) const { return graph_.nodes[node].disk; }

  bool is_right(const Edge& link) const {
    const Disk &from = disk(link.node[0]), &to = disk(link.node[1]);
    const site::Control control =
        site::control_of(site(link.site[0]), site(link.site[1]), from, to);
    const Boundary::SiteRange& run = boundary_.runs[graph_.nodes[link.node[0]].component];
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0})
      if (!is_maximal(at(from, control, to, t), link, run)) return false;
    return feet_advance(link, from.center, to.center);
  }

  /// The point of the edge's curve at parameter t.
  static Disk at(const Disk& from, const site::Control& control, const Disk& to, double t) {
    const double a = (1 - t) * (1 - t), b = 2 * t * (1 - t) * control.weight, c = t * t;
    const double all = a + b + c;
    return {(1 / all) * (a * from.center + b * control.point.center + c * to.center),
            (a * from.radius + b * control.point.radius + c * to.radius) / all};
  }

  bool is_maximal(const Disk& disk, const Edge& link, const Boundary::SiteRange& run) const {
    for (const std::uint32_t i : link.site)
      if (!touches(site(i), disk, tolerance_)) return false;
    return !tree_.nearest(disk.center, disk.radius - tolerance_, run.first, run.last);
  }

  /// From its inside.
  static bool touches(const site::Site& site, const Disk& disk, double slack) {
    if (!site.is_vertex() && !(site::carrier_distance(site, disk.center) >= -slack)) return false;
    return std::abs(std::sqrt(site::squared_distance(site, disk.center)) - disk.radius) <= slack;
  }

  /// Whether the feet move forward on the right site and backward on the left one, but for what the
  /// tolerance leaves open.
  bool feet_advance(const Edge& link, Vec2 from, Vec2 to) const {
    const double slack = 4 * tolerance_;
    return site::foot_advances(site(link.site[1]), from, to, slack) &&
           site::foot_advances(site(link.site[0]), to, from, slack);
  }

  /// Whether no edge is missing at the nodes of these ways, all of theirs: counter-clockwise round
  /// a node, nothing is left to walk between the left site of one and the right site of the next.
  bool are_all_ways(std::vector<Way>& ways) const {
    ranges::sort(ways, [](const Way& a, const Way& b) {
      return std::pair(a.node, a.right) < std::pair(b.node, b.right);
    });
    for (auto first = ways.begin(); first != ways.end();) {
      const auto last =
          std::find_if(first, ways.end(), [&](const Way& way) { return way.node != first->node; });
      for (auto way = first; way != last; ++way) {
        const auto next = way + 1 != last ? way + 1 : first;
        if (!nothing_between(way->left, next->right, graph_.nodes[way->node])) return false;
      }
      first = last;
    }
    return true;
  }

  /// Whether a node's disk touches all from a site that it touches to the next such site, or is a
  /// point in a convex corner.
  bool nothing_between(std::uint32_t first, std::uint32_t last, const Node& node) const {
    if (boundary_.originals[first] == boundary_.originals[last]) return true;
    const Boundary::SiteRange& run = boundary_.runs[node.component];
    if (!(node.disk.radius > 0)) return is_corner(first, last, run);
    const double slack = 2 * tolerance_;
    for (std::uint32_t i = first; i != last;) {
      const bool at_bridge = boundary_.elements[i] == Element::bridge;
      // No leaf leads into a blunt joint: a disk that touches both its edges may miss its point.
      const bool blunt = boundary_.joint(i) == site::Joint::blunt;
      if (!at_bridge && !blunt && !is_on(node.disk, site(i).end(), slack)) return false;
      i = i == run.last ? run.first : i + 1;
      if (boundary_.elements[i] == Element::bridge) continue;
      if (at_bridge && !is_on(node.disk, site(i).point, slack)) return false;
      if (i != last && !touches_all(site(i), node.disk, slack)) return false;
    }
    return true;
  }

  bool is_corner(std::uint32_t before, std::uint32_t after, const Boundary::SiteRange& run) const {
    if (before == run.last)
      return after == run.first && run.at_corner && boundary_.joint(before) == site::Joint::corner;
    return after == before + 1 && boundary_.is_corner(before);
  }

  static bool is_on(const Disk& disk, Vec2 p, double slack) {
    return std::abs(distance(p, disk.center) - disk.radius) <= slack;
  }

  static bool touches_all(const site::Site& site, const Disk& disk, double slack) {
    if (site.curvature > 0)
      for (const Vec2 p : {site.at(0), site.at(0.5 * site.length), site.at(site.length)})
        if (!is_on(disk, p, slack)) return false;
    return touches(site, disk, slack);
  }

  const Boundary& boundary_;
  const site::BoundaryTree& tree_;
  const Graph& graph_;
  const double tolerance_;
};

}  // namespace

bool is_right_around(const Boundary& boundary, const site::BoundaryTree& tree, const Graph& graph,
                     std::span<const std::uint32_t> sites, double tolerance) {
  return LocalCheck(boundary, tree, graph, tolerance).holds_around(sites);
}

}  // namespace medial::disks
