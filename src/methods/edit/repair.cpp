#include "methods/edit/repair.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "methods/checks.h"
#include "methods/disks/collect.h"
#include "methods/disks/merge_ties.h"
#include "methods/disks/tie_fit.h"
#include "site/bisector.h"
#include "site/boundary_tree.h"

namespace medial::edit {
namespace {

using disks::BridgeEnd;
using disks::Element;

/// The largest error of a border's disk, in tolerances: that of the node of a tie.
constexpr double border_error = 16;
/// A bound on the error of any disk, in the local frame.
constexpr double loose = 0x1p-20;

/// The window's sites for exact decisions; valid as long as the window and the rings exist. If the
/// next site is outside the window, `next` of a site is the site itself.
exact::SiteLoops outline_of(const Rings& rings, const Window& window) {
  const std::vector<std::uint32_t>& names = window.names;
  exact::SiteLoops outline;
  outline.sites.work_out = [&rings, &names](std::uint32_t i) -> exact::ExactSite {
    const std::uint32_t vertex = names[i] / 2;
    if (!Rings::is_edge(names[i])) return {rings.local(vertex), rings.local(vertex)};
    return {rings.local(vertex), rings.local(rings.corner_after(vertex)), rings[vertex].bulge};
  };
  outline.passes.assign(names.size(), false);
  for (std::uint32_t i = 0; i < names.size(); ++i) {
    const std::uint32_t vertex = names[i] / 2, after = rings.next_site(names[i]);
    const bool is_edge = Rings::is_edge(names[i]);
    const std::uint32_t end = is_edge ? rings.corner_after(vertex) : vertex;
    const site::Joint joint = rings[end].joint;
    const auto place = std::lower_bound(names.begin(), names.end(), after);
    const bool is_inside = place != names.end() && *place == after;
    outline.next.push_back(is_inside ? static_cast<std::uint32_t>(place - names.begin()) : i);
    outline.passes[i] =
        is_inside && (!is_edge || joint == site::Joint::smooth || joint == site::Joint::reflex);
  }
  outline.has_arcs = true;
  for (std::uint32_t i = 0; i < names.size(); ++i) {
    const exact::ExactSite site = outline.sites[i];
    outline.is_wide = outline.is_wide || exact::is_wide(site.start, site.end) ||
                      exact::is_wide(site.end, site.start);
  }
  outline.loop_begin = {0, static_cast<std::uint32_t>(names.size())};
  return outline;
}

class Repairer {
 public:
  Repairer(const Rings& rings, const AxisGraph& graph, const Window& window,
           const Measures& measures)
      : rings_(rings),
        graph_(graph),
        borders_(window.borders),
        window_(window),
        boundary_(window.boundary),
        measures_(measures),
        sites_([this] { return outline_of(rings_, window_); }, measures.fine_tolerance,
               measures.radius_limit, window.boundary) {}

  std::optional<Repair> run(std::vector<std::uint32_t>& doubtful) {
    if (boundary_.has_arcs && has_doubtful_points()) return std::nullopt;
    const site::BoundaryTree tree(boundary_.sites);
    std::vector<std::unique_ptr<disks::Chunk>> chunks;
    chunks.push_back(walk(tree));
    if (!chunks[0]->lost.empty() || !ends_well(*chunks[0], doubtful)) return std::nullopt;
    disks::Graph part = disks::collect(chunks, boundary_.bridges, 0, boundary_.has_arcs);
    if (degree_of_first(part) != 1) {
      doubtful.push_back(borders_[0].node);
      return std::nullopt;
    }
    disks::merge_ties(tree, sites_, measures_.tolerance, part);
    const std::vector<std::uint32_t> nodes = border_nodes(part);
    if (std::count(nodes.begin(), nodes.end(), none) > 0) return std::nullopt;
    find_moved(part, nodes, doubtful);
    if (!doubtful.empty()) return std::nullopt;
    if (boundary_.has_arcs) {
      disks::remove_spurs(boundary_, measures_.tolerance, part, nodes);
      disks::find_doubts(boundary_, tree, measures_.tolerance, part);
      if (!part.lost.empty()) return std::nullopt;  // compute() measures, and may walk again
    }
    return result(part, doubtful);
  }

 private:
  std::unique_ptr<disks::Chunk> walk(const site::BoundaryTree& tree) {
    return disks::walk_part({sites_, tree}, boundary_.bridges[0].disk,
                            border_error * measures_.fine_tolerance);
  }

  /// Whether the window has tiny edges or joints that are almost smooth. Next to them compute() may
  /// need to measure the axis.
  bool has_doubtful_points() const {
    const auto edge = [&](std::uint32_t v) -> BulgeArc {
      return {rings_.local(v), rings_.local(rings_.corner_after(v)), rings_[v].bulge};
    };
    const auto is_doubtful = [&](std::uint32_t v) {
      return is_almost_smooth(rings_[v].joint, edge(rings_.corner_before(v)), edge(v),
                              measures_.fine_tolerance);
    };
    return std::any_of(window_.names.begin(), window_.names.end(), [&](std::uint32_t name) {
      const std::uint32_t vertex = name / 2;
      return Rings::is_edge(name) && (is_tiny_edge(edge(vertex)) || is_doubtful(vertex) ||
                                      is_doubtful(rings_.corner_after(vertex)));
    });
  }

  /// Adds the nodes of borders that merge_ties() has merged with other nodes, and so moved.
  void find_moved(const disks::Graph& part, const std::vector<std::uint32_t>& nodes,
                  std::vector<std::uint32_t>& doubtful) const {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Disk &own = part.nodes[nodes[i]].disk, &old = graph_.disk(borders_[i].node);
      if (!(own.center == old.center) || own.radius != old.radius)
        doubtful.push_back(borders_[i].node);
    }
  }

  /// Whether the walk reached all bridges, and each border along an edge.
  bool ends_well(const disks::Chunk& chunk, std::vector<std::uint32_t>& doubtful) const {
    std::vector<std::uint32_t> count(boundary_.bridges.size(), 0);
    count[0] = 1;
    for (const BridgeEnd& end : chunk.bridge_ends) {
      ++count[end.bridge];
      if (end.bridge < borders_.size() && end.edge == BridgeEnd::no_edge)
        doubtful.push_back(borders_[end.bridge].node);
    }
    for (std::size_t i = 0; i < count.size(); ++i)
      if (count[i] != (i < borders_.size() ? 1 : 2)) return false;
    return doubtful.empty();
  }

  static std::size_t degree_of_first(const disks::Graph& part) {
    std::size_t degree = 0;
    for (const Edge& link : part.edges)
      for (const std::uint32_t node : link.node) degree += node == 0 ? 1 : 0;
    return degree;
  }

  /// The border to which a link between these sites of the boundary leads, or none.
  std::uint32_t border_between(std::uint32_t right, std::uint32_t left) const {
    if (right == boundary_.runs[0].last && left == 0) return 0;
    if (right + 2 != left || boundary_.elements[right + 1] != Element::bridge) return none;
    const std::uint32_t bridge = boundary_.originals[right + 1];
    return bridge < borders_.size() ? bridge : none;
  }

  /// The node at which the part ends at each border; none if it does not end there. The walk begins
  /// at the first border.
  std::vector<std::uint32_t> border_nodes(const disks::Graph& part) const {
    const WorkVector<std::uint8_t> degree = disks::degrees_of(part);
    std::vector<std::uint32_t> nodes(borders_.size(), none);
    if (degree[0] == 1) nodes[0] = 0;
    for (const Edge& link : part.edges)
      for (std::size_t k = 0; k < 2; ++k) {
        if (degree[link.node[k]] != 1) continue;
        // as seen on the way to the node
        const std::uint32_t right = link.site[k], left = link.site[1 - k];
        const std::uint32_t border = border_between(right, left);
        if (border != none && border != 0) nodes[border] = link.node[k];
      }
    return nodes;
  }

  std::optional<Repair> result(const disks::Graph& part,
                               std::vector<std::uint32_t>& doubtful) const {
    Repair repair;
    for (const Node& node : part.nodes) repair.disks.push_back(node.disk);
    repair.old_nodes.assign(part.nodes.size(), none);
    const std::vector<std::uint32_t> nodes = border_nodes(part);
    for (std::size_t i = 0; i < borders_.size(); ++i) {
      if (nodes[i] == none) return std::nullopt;
      repair.old_nodes[nodes[i]] = borders_[i].node;
    }
    for (const Edge& link : part.edges) {
      if (!touches(part, link)) return std::nullopt;
      repair.edges.push_back({link.node, {name_of(link.site[0]), name_of(link.site[1])}, {}, 1});
    }
    find_doubtful(repair, doubtful);
    if (!doubtful.empty()) return std::nullopt;
    for (std::size_t i = 0; i < part.edges.size(); ++i) {
      const Edge& link = part.edges[i];
      const site::Control control =
          site::control_of(boundary_.sites[link.site[0]], boundary_.sites[link.site[1]],
                           disk_of(repair, link.node[0]), disk_of(repair, link.node[1]));
      repair.edges[i].control = control.point;
      repair.edges[i].weight = control.weight;
    }
    return repair;
  }

  /// The disk of a node; for a border's node the disk of the existing axis.
  const Disk& disk_of(const Repair& repair, std::uint32_t node) const {
    const std::uint32_t old = repair.old_nodes[node];
    return old == none ? repair.disks[node] : graph_.disk(old);
  }

  std::uint32_t name_of(std::uint32_t site) const {
    return window_.names[boundary_.originals[site]];
  }

  /// Whether the disks at the ends of an edge touch its sites, though perhaps other pieces of them.
  /// Next to arcs, several near ties may add up to more than one tolerance: compute() measures such
  /// an axis.
  bool touches(const disks::Graph& part, const Edge& link) const {
    const double slack = boundary_.has_arcs ? 2 * measures_.tolerance : loose;
    const auto touches_site = [&](const Disk& disk, const site::Site& site) {
      return std::abs(std::sqrt(site::squared_distance(site, disk.center)) - disk.radius) <= slack;
    };
    for (const std::uint32_t node : link.node)
      for (const std::uint32_t i : link.site)
        if (const Disk& disk = part.nodes[node].disk; !touches_site(disk, boundary_.sites[i]))
          if (!touches_site(disk, rings_.site_near(name_of(i), disk.center))) return false;
    const auto [left, right] = link.site;
    return !disks::strays_at_centre(boundary_.sites[left], boundary_.sites[right],
                                    part.nodes[link.node[0]].disk, part.nodes[link.node[1]].disk,
                                    slack);
  }

  /// Adds the nodes of borders that merge_ties() might merge with their new neighbours if the edges
  /// between them were inside the window.
  void find_doubtful(const Repair& repair, std::vector<std::uint32_t>& doubtful) const {
    constexpr std::size_t enough = 3;  // edges: one of them has a third site
    std::vector<std::array<std::uint32_t, enough>> edges(repair.disks.size());
    std::vector<std::uint8_t> count(repair.disks.size(), 0);
    for (std::uint32_t i = 0; i < repair.edges.size(); ++i)
      for (const std::uint32_t node : repair.edges[i].node)
        if (count[node] < enough) edges[node][count[node]++] = i;
    for (const AxisGraph::Edge& edge : repair.edges)
      for (std::size_t k = 0; k < 2; ++k) {
        const std::uint32_t border = repair.old_nodes[edge.node[k]], inner = edge.node[1 - k];
        if (border == none) continue;
        if (graph_.degree(border) < enough || count[inner] < enough) {
          if (rings_.has_arcs() && may_be_hub(edge, graph_.disk(border), repair.disks[inner]))
            doubtful.push_back(border);
          continue;
        }
        std::uint32_t before = none, after = none;
        const auto take = [&](const std::array<std::uint32_t, 2>& sites, std::uint32_t& third) {
          for (const std::uint32_t site : sites)
            if (site != edge.site[0] && site != edge.site[1]) third = site;
        };
        for (const std::uint32_t i : edges[inner]) take(repair.edges[i].site, before);
        graph_.for_edges_at(
            border, [&](std::uint32_t i, std::size_t) { take(graph_.edge(i).site, after); });
        if (may_be_one(repair.disks[inner], graph_.disk(border),
                       {edge.site[0], edge.site[1], before, after}))
          doubtful.push_back(border);
      }
  }

  /// Whether a disk may be an arc's own circle: it has its curvature and passes through both ends.
  bool is_own_circle(const site::Site& site, const Disk& disk) const {
    constexpr double alike = 0x1p-33, tolerances = 1 << 12;
    const double slack = tolerances * measures_.fine_tolerance;
    const auto is_on_disk = [&](Vec2 p) {
      return std::abs(distance(p, disk.center) - disk.radius) <= slack;
    };
    return site.curvature > 0 &&
           std::abs(site.curvature * disk.radius - 1) <= std::min(slack * site.curvature, alike) &&
           is_on_disk(site.point) && is_on_disk(site.end());
  }

  /// Whether merge_ties() may merge two nodes of which at least one does not branch: either they
  /// are closer than their disks may move, or the border's disk is the own circle of an arc.
  bool may_be_hub(const AxisGraph::Edge& edge, const Disk& border, const Disk& inner) const {
    constexpr double reach = 16;  // tolerances
    std::array<Vec2, 2> outward;
    for (std::size_t i = 0; i < 2; ++i) {
      const site::Site site = rings_.site_near(edge.site[i], border.center);
      if (is_own_circle(site, border)) return true;
      outward[i] = site::outward(site, border.center);
    }
    const double play = 2 / norm(outward[0] - outward[1]);
    return !(distance(border.center, inner.center) > reach * measures_.tolerance * play);
  }

  /// Whether one disk may touch four sites within the tolerance if each of two disks touches three
  /// of them, by the rule of merge_ties().
  bool may_be_one(const Disk& from, const Disk& to,
                  const std::array<std::uint32_t, 4>& sites) const {
    if (std::count(sites.begin(), sites.end(), none) > 0) return true;
    for (const Disk& disk : {from, to}) {
      std::array<disks::ContactOf<double>, 4> contacts;
      for (std::size_t i = 0; i < sites.size(); ++i)
        contacts[i] = disks::contact_of(rings_.site_near(sites[i], disk.center), disk);
      if (!(std::abs(disks::Dependency<double>(contacts).level) > 2 * measures_.tolerance))
        return true;
    }
    return false;
  }

  const Rings& rings_;
  const AxisGraph& graph_;
  const std::vector<Border>& borders_;
  const Window& window_;
  const disks::Boundary& boundary_;
  const Measures& measures_;
  const disks::ExactSites sites_;
};

}  // namespace

std::optional<Repair> repair(const Rings& rings, const AxisGraph& graph, const Window& window,
                             const Measures& measures, std::vector<std::uint32_t>& doubtful) {
  return Repairer(rings, graph, window, measures).run(doubtful);
}

}  // namespace medial::edit
