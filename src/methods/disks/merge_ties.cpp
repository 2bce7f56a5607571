#include "methods/disks/merge_ties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "base/compat.h"
#include "base/fill_gaps.h"
#include "base/memory.h"
#include "base/numbers.h"
#include "base/threads.h"
#include "methods/disks/tie_fit.h"
#include "site/bisector.h"

namespace medial::disks {
namespace {

using site::Site;

/// Only edges shorter than this, against the radius, are looked at, and no disk moves further: a
/// tie's nodes are off by rounding over an angle, and distances are nearly linear so far.
constexpr double short_edge = 0x1p-7;

/// The largest residual at the one end of an edge, against the bound, that a contact of its other
/// end may have: with the smallest angle between contacts at some 2^-12, the factors of their
/// dependency differ by no more than its square.
constexpr double steepest = 0x1p24;

/// Contacts that belong to a node of many arcs may be so many tolerances off before it is put
/// right.
constexpr double hub_reach = 4;

/// Nodes that have become one.
struct Cluster {
  Fit fit;
  std::uint32_t node = none;  ///< the node that stands for it
  std::vector<Touch> contacts;
  std::vector<std::uint32_t> ends;  ///< of edges, at all its nodes
  bool branching = false;           ///< one of its nodes is
  std::uint64_t spent = 0;          ///< contacts looked at to fit it together with others
  bool merged = false;              ///< it has more than one node
  bool dissolved = false;           ///< its nodes are left as they were
};

class Merger {
 public:
  Merger(const Boundary& boundary, const site::BoundaryTree& tree, double tolerance, Graph& graph)
      : boundary_(boundary), tree_(tree), tolerance_(tolerance), graph_(graph) {}

  void merge() {
    std::vector<std::uint32_t> edges = candidates();
    // Nearest nodes first: what belongs together comes together before anything else is tried.
    const auto length = [&](std::uint32_t e) {
      const auto [from, to] = graph_.links[e].node;
      return squared_norm(graph_.nodes[to].disk.center - graph_.nodes[from].disk.center);
    };
    std::sort(edges.begin(), edges.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double la = length(a), lb = length(b);
      return la != lb ? la < lb : a < b;
    });
    make_clusters(edges);
    std::vector<std::uint32_t> contracted;
    candidates_ = edges;
    std::sort(candidates_.begin(), candidates_.end());
    // Where one edge was refused, others may have been contracted since.
    bool any = true;
    for (int round = 0; round < most_passes && any; ++round) {
      any = false;
      std::vector<std::uint32_t> refused;
      for (const std::uint32_t edge : edges) {
        if (contract(edge)) {
          contracted.push_back(edge);
          any = true;
        } else {
          refused.push_back(edge);
        }
      }
      edges = std::move(refused);
    }
    dissolve_backward();
    std::erase_if(contracted, [&](std::uint32_t e) {
      return clusters_[cluster_of(graph_.links[e].node[0])].dissolved;
    });
    if (!contracted.empty()) remove(contracted);
  }

 private:
  static constexpr int most_passes = 4;

  double bound() const { return 0.5 * tolerance_; }

  /// The numbers below `count` for which `holds` is true, increasing.
  template <class Holds>
  static std::vector<std::uint32_t> filter(std::size_t count, Holds&& holds) {
    constexpr std::size_t block = 1 << 12;
    std::vector<std::vector<std::uint32_t>> found((count + block - 1) / block);
    parallel_for(found.size(), [&](std::size_t i) {
      std::array<std::uint32_t, block> some;
      std::size_t size = 0;
      for (std::size_t k = i * block; k < std::min(count, (i + 1) * block); ++k) {
        some[size] = static_cast<std::uint32_t>(k);
        size += holds(k) ? 1 : 0;  // without a branch that could be guessed wrong
      }
      found[i].assign(some.begin(), some.begin() + static_cast<std::ptrdiff_t>(size));
    });
    std::vector<std::uint32_t> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

  /// The edges that are short against both of their disks: none that leads to a leaf.
  std::vector<std::uint32_t> short_edges() const {
    return filter(graph_.links.size(), [&](std::size_t e) {
      const auto [from, to] = graph_.links[e].node;
      const Disk &a = graph_.nodes[from].disk, &b = graph_.nodes[to].disk;
      const double furthest = short_edge * std::min(a.radius, b.radius);
      return squared_norm(b.center - a.center) < furthest * furthest;
    });
  }

  /// Links the ends of all edges at the nodes of these ones.
  void link_ends(const std::vector<std::uint32_t>& edges) {
    constexpr std::uint32_t skipped = none - 1;
    first_end_ = large_vector(graph_.nodes.size(), skipped);
    for (const std::uint32_t e : edges)
      for (const std::uint32_t node : graph_.links[e].node) first_end_[node] = none;
    next_end_ = uninitialized<std::uint32_t[]>(2 * graph_.links.size());
    prefer_large_pages(next_end_.get(), 2 * graph_.links.size() * sizeof(std::uint32_t));
    for (std::uint32_t end = 0; end < 2 * graph_.links.size(); ++end) {
      std::uint32_t& first = first_end_[graph_.links[end / 2].node[end % 2]];
      if (first == skipped) continue;
      next_end_[end] = first;
      first = end;
    }
  }
  bool is_branching(std::uint32_t node) const {
    const std::uint32_t second = next_end_[first_end_[node]];
    return second != none && next_end_[second] != none;
  }

  /// Short edges between branching nodes whose two sites and one more contact of each end could be
  /// touched by one disk. A necessary condition for contraction, and nearly always false.
  std::vector<std::uint32_t> candidates() {
    std::vector<std::uint32_t> edges = short_edges();
    if (edges.empty()) return edges;
    link_ends(edges);
    std::vector<std::uint32_t> kept = filter(
        edges.size(), [&](std::size_t i) { return could_be_contracted(graph_.links[edges[i]]); });
    for (std::uint32_t& i : kept) i = edges[i];
    return kept;
  }

  bool could_be_contracted(const Link& edge) const {
    const Disk &from = graph_.nodes[edge.node[0]].disk, &to = graph_.nodes[edge.node[1]].disk;
    if (!is_branching(edge.node[0]) || !is_branching(edge.node[1]))
      return boundary_.has_arcs && could_be_at_hub(edge);
    const std::uint32_t after = other_contact(edge, edge.node[1]);
    if (after == none || !(std::abs(near_contact(after, from).residual) <= steepest * bound()))
      return false;
    const std::uint32_t before = other_contact(edge, edge.node[0]);
    if (before == none) return false;
    const Disk middle{midpoint(from.center, to.center), 0.5 * (from.radius + to.radius)};
    std::array<ContactEquation, 4> contacts;
    bool curved = false;
    for (std::size_t i = 0; const std::uint32_t k : {edge.site[0], edge.site[1], before, after}) {
      contacts[i++] = near_contact(k, middle);
      curved = curved || boundary_.sites[k].is_vertex() || boundary_.sites[k].is_arc();
    }
    // From the middle on, distances to vertices deviate from their tangents by so much.
    const double bend = curved ? 0.125 * squared_norm(to.center - from.center) / middle.radius : 0;
    return std::abs(Dependency(contacts).level) <= bound() + bend;
  }

  /// Whether an edge of which not both ends are branching nodes may be due to rounding: it is not
  /// longer than rounding leaves its end open, and the disk of one end nearly touches all that is
  /// touched at the other.
  bool could_be_at_hub(const Link& edge) const {
    const Disk &from = graph_.nodes[edge.node[0]].disk, &to = graph_.nodes[edge.node[1]].disk;
    const double open = hub_reach * tolerance_ * play(edge, from);
    if (!(squared_norm(to.center - from.center) <= open * open)) return false;
    const bool first = is_branching(edge.node[0]), second = is_branching(edge.node[1]);
    return (!second && nearly_touches(edge.node[0], edge.node[1])) ||
           (!first && nearly_touches(edge.node[1], edge.node[0]));
  }

  /// How far a disk may move, at most, that stays as near to the edge's two sites: against that
  /// distance. The bisector moves sideways by its inverse sine; where the disk touches an arc all
  /// along, it may move ahead by the inverse of 1 - cos of half of the arc's angle.
  double play(const Link& edge, const Disk& disk) const {
    const Site &a = boundary_.sites[edge.site[0]], &b = boundary_.sites[edge.site[1]];
    double result = 2 / norm(site::outward(a, disk.center) - site::outward(b, disk.center));
    for (const Site* site : {&a, &b}) {
      if (!site->is_arc() || !touches_all(*site, disk)) continue;
      result = std::max(result, 8 / squared_norm(site->normal() - site->end_normal()));
    }
    return result;
  }
  bool nearly_touches(std::uint32_t hub, std::uint32_t node) const {
    const Disk& disk = graph_.nodes[hub].disk;
    return all_contacts(node, [&](std::uint32_t site) {
      const double away = site::squared_distance(boundary_.sites[site], disk.center);
      return std::abs(std::sqrt(away) - disk.radius) <= hub_reach * tolerance_;
    });
  }

  /// Whether something holds for all sites that are touched in a node: those of its edges and, at a
  /// leaf, those on the way around it from one side of its edge to the other.
  template <class Holds>
  bool all_contacts(std::uint32_t node, const Holds& holds) const {
    for (std::uint32_t end = first_end_[node]; end != none; end = next_end_[end])
      for (const std::uint32_t site : graph_.links[end / 2].site)
        if (!holds(site)) return false;
    const std::uint32_t end = first_end_[node];
    if (next_end_[end] != none) return true;
    auto [left, right] = graph_.links[end / 2].site;
    if (end % 2 == 0) std::swap(left, right);
    const Boundary::SiteRange& run = boundary_.runs[graph_.nodes[node].component];
    for (std::uint32_t site = right;;) {
      site = site == run.last ? run.first : site + 1;
      if (site == left) return true;
      if (!holds(site)) return false;
    }
  }

  /// contact_of() where the residual is small against the radius, without roots.
  ContactEquation near_contact(std::uint32_t i, const Disk& disk) const {
    const Site& site = boundary_.sites[i];
    if (!site.is_vertex()) return contact_of(site, disk);
    const Vec2 to = (1 / disk.radius) * (disk.center - site.point);
    return {to, 0.5 * disk.radius * (squared_norm(to) - 1)};
  }

  /// A site that is touched in a node of the edge, but is not the edge's own.
  std::uint32_t other_contact(const Link& edge, std::uint32_t node) const {
    for (std::uint32_t end = first_end_[node]; end != none; end = next_end_[end])
      for (const std::uint32_t site : graph_.links[end / 2].site)
        if (site != edge.site[0] && site != edge.site[1]) return site;
    return none;
  }

  /// A cluster for every node of the edges, in the nodes' order.
  void make_clusters(const std::vector<std::uint32_t>& edges) {
    for (const std::uint32_t e : edges)
      for (const std::uint32_t node : graph_.links[e].node) nodes_.push_back(node);
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
    for (const std::uint32_t node : nodes_) {
      parent_.push_back(static_cast<std::uint32_t>(clusters_.size()));
      Cluster& cluster = clusters_.emplace_back(
          Cluster{Fit(boundary_.sites, bound()), node, {}, {}, is_branching(node)});
      cluster.fit.disk = graph_.nodes[node].disk;
      for (std::uint32_t end = first_end_[node]; end != none; end = next_end_[end])
        cluster.ends.push_back(end);
      all_contacts(node, [&](std::uint32_t site) {
        add_contact(site, cluster.fit.disk, cluster.contacts);
        return true;
      });
      auto& contacts = cluster.contacts;
      std::sort(contacts.begin(), contacts.end());
      contacts.erase(std::unique(contacts.begin(), contacts.end()), contacts.end());
    }
  }

  /// What a disk near to a given one has to do in order to touch a site.
  void add_contact(std::uint32_t site, const Disk& disk, std::vector<Touch>& contacts) const {
    using Part = Touch::Part;
    if (boundary_.sites[site].is_arc() && touches_all(boundary_.sites[site], disk)) {
      for (const Part part : {Part::start, Part::middle, Part::end})
        contacts.push_back({site, part});
      return;
    }
    contacts.push_back({site});
  }

  /// Whether a disk near to the given one may touch an arc all along.
  bool touches_all(const Site& arc, const Disk& disk) const {
    for (const double s : {0.0, 0.5 * arc.length, arc.length})
      if (!(std::abs(distance(arc.at(s), disk.center) - disk.radius) <= hub_reach * tolerance_))
        return false;
    return true;
  }

  /// The cluster of a node; none where it is not in any.
  std::uint32_t cluster_of(std::uint32_t node) {
    const auto place = std::lower_bound(nodes_.begin(), nodes_.end(), node);
    if (place == nodes_.end() || *place != node) return none;
    auto cluster = static_cast<std::uint32_t>(place - nodes_.begin());
    while (parent_[cluster] != cluster) cluster = parent_[cluster] = parent_[parent_[cluster]];
    return cluster;
  }

  /// Makes one cluster of an edge's two, if they can be. Every edge is tried once: sites that no
  /// disk touches are not touched by one after others have joined them.
  bool contract(std::uint32_t edge) {
    std::uint32_t a = cluster_of(graph_.links[edge].node[0]);
    std::uint32_t b = cluster_of(graph_.links[edge].node[1]);
    if (a == b || !(clusters_[a].branching || clusters_[b].branching)) return false;
    if (clusters_[a].contacts.size() < clusters_[b].contacts.size()) std::swap(a, b);
    Cluster &large = clusters_[a], &small = clusters_[b];
    Fit fit = large.fit;
    // Mostly the larger cluster's disk will do: the smaller one's contacts are all to look at.
    const bool moved = !fit.touches({small.contacts});
    if (moved && !refit(fit, large, small)) return false;
    if (!keeps_directions(edge, small, a, b, fit.disk)) return false;
    if (moved && !keeps_directions(edge, large, a, b, fit.disk)) return false;
    if (moved && !is_empty(fit.disk, graph_.nodes[small.node].component)) return false;

    double& residual = graph_.statistics.largest_residual;
    residual = std::max(residual, fit.worst);
    large.fit = fit;
    large.contacts.insert(large.contacts.end(), small.contacts.begin(), small.contacts.end());
    large.ends.insert(large.ends.end(), small.ends.begin(), small.ends.end());
    large.branching = true;
    large.merged = true;
    large.spent += small.spent;
    small.contacts = {};
    small.ends = {};
    parent_[b] = a;
    return true;
  }

  /// Finds a disk for both clusters. A large cluster may be looked at all through only so often for
  /// every contact that it has, which keeps the work linear however large it grows; where its
  /// contacts come in no particular order, each new one needs that with a probability of some
  /// 4 / size only.
  bool refit(Fit& fit, Cluster& large, const Cluster& small) const {
    constexpr int most_rounds = 32;
    constexpr std::uint64_t budget = 64;
    const Disk start = fit.disk;
    if (!fit.has_begun()) fit.begin(large.contacts);
    const auto settles = [&](std::initializer_list<std::span<const Touch>> lists,
                             std::uint64_t& spent) {
      for (int round = 0; round < most_rounds; ++round) {
        for (const auto& list : lists) spent += list.size();
        if (fit.touches(lists)) return true;
        if (!fit.improve()) return false;
        if (!(distance(fit.disk.center, start.center) <= short_edge * start.radius)) return false;
      }
      return false;
    };
    // First the smaller cluster against those contacts that hold the larger one's disk.
    std::uint64_t spent = 0;
    if (!settles({small.contacts}, spent)) return false;
    return large.spent <= budget * large.contacts.size() &&
           settles({large.contacts, small.contacts}, large.spent);
  }

  /// Whether the edges of one of the clusters a and b that lead elsewhere still lead there when the
  /// disk of both is `disk`, and no edge but `contracted` joins the two.
  bool keeps_directions(std::uint32_t contracted, const Cluster& cluster, std::uint32_t a,
                        std::uint32_t b, const Disk& disk) {
    for (const std::uint32_t end : cluster.ends) {
      if (end / 2 == contracted) continue;
      const Link& edge = graph_.links[end / 2];
      const std::array<std::uint32_t, 2> there{cluster_of(edge.node[0]), cluster_of(edge.node[1])};
      if (there[0] == there[1]) continue;  // contracted before
      // It may be contracted as well; where it is not, see dissolve_backward().
      if (std::binary_search(candidates_.begin(), candidates_.end(), end / 2)) continue;
      std::array<Vec2, 2> center;
      for (std::size_t k = 0; k < 2; ++k) {
        const bool here = there[k] == a || there[k] == b;
        center[k] = here               ? disk.center
                    : there[k] == none ? graph_.nodes[edge.node[k]].disk.center
                                       : clusters_[there[k]].fit.disk.center;
      }
      const site::Bisector bisector(boundary_.sites[edge.site[1]], boundary_.sites[edge.site[0]]);
      if (!(bisector.position(center[0]) < bisector.position(center[1]))) return false;
    }
    return true;
  }

  bool is_empty(const Disk& disk, std::uint32_t component) const {
    const Boundary::SiteRange& run = boundary_.runs[component];
    return !tree_.nearest(disk.center, disk.radius - tolerance_, run.first, run.last);
  }

  /// While clusters grow, feet may have to run backward on an edge between two of them, as long as
  /// it is to be contracted later. Where such an edge stayed, its clusters are given up.
  void dissolve_backward() {
    std::vector<std::uint32_t> backward;
    const auto check = [&](std::uint32_t end) {
      const Link& edge = graph_.links[end / 2];
      const std::array<std::uint32_t, 2> there{cluster_of(edge.node[0]), cluster_of(edge.node[1])};
      if (there[0] == there[1] || advances(edge)) return;
      for (const std::uint32_t cluster : there)
        if (cluster != none) backward.push_back(cluster);
    };
    for (const Cluster& cluster : clusters_) {
      if (!cluster.merged) continue;
      for (const std::uint32_t end : cluster.ends) check(end);
    }
    while (!backward.empty()) {
      Cluster& cluster = clusters_[backward.back()];
      backward.pop_back();
      if (cluster.dissolved) continue;
      cluster.dissolved = true;
      for (const std::uint32_t end : cluster.ends) check(end);
    }
  }

  const Disk& disk_of(std::uint32_t node) {
    const std::uint32_t cluster = cluster_of(node);
    return cluster == none || clusters_[cluster].dissolved ? graph_.nodes[node].disk
                                                           : clusters_[cluster].fit.disk;
  }

  /// Whether the feet move forward on the right site and backward on the left one, but for what
  /// the tolerance leaves open, and the disk halfway along the edge still touches both and no more.
  bool advances(const Link& edge) {
    const double slack = 4 * tolerance_;
    const Site &left = boundary_.sites[edge.site[0]], &right = boundary_.sites[edge.site[1]];
    const Disk &start = disk_of(edge.node[0]), &end = disk_of(edge.node[1]);
    const Vec2 from = start.center, to = end.center;
    const site::Control control = site::control_of(left, right, start, end);
    // Where an end is off a curved bisector by much against its length, the curve would fold back.
    const Vec2 chord = to - from, bend = control.point.center - from;
    if (!(dot(bend, chord) >= 0 && dot(bend, chord) <= squared_norm(chord))) return false;
    const double share = 0.5 / (1 + control.weight), middle = control.weight / (1 + control.weight);
    const Vec2 halfway = share * (from + to) + middle * control.point.center;
    const double radius = share * (start.radius + end.radius) + middle * control.point.radius;
    for (const Site& site : {left, right})
      if (!(std::abs(site::carrier_distance(site, halfway) - radius) <= tolerance_)) return false;
    if (!is_empty({halfway, radius}, graph_.nodes[edge.node[0]].component)) return false;
    const auto step = [](const Site& site, Vec2 a, Vec2 b) {
      return site::carrier_parameter(site, b) - site::carrier_parameter(site, a);
    };
    return (right.is_vertex() || step(right, from, to) >= -slack) &&
           (left.is_vertex() || step(left, to, from) >= -slack);
  }

  /// Takes the contracted edges and the nodes that became others out of the graph; the last ones
  /// take their places.
  void remove(std::vector<std::uint32_t>& contracted) {
    std::vector<std::uint32_t> gone;
    for (std::uint32_t i = 0; i < clusters_.size(); ++i) {
      const Cluster& cluster = clusters_[i];
      if (clusters_[cluster_of(cluster.node)].dissolved) continue;
      if (parent_[i] != i) {
        gone.push_back(cluster.node);
        continue;
      }
      graph_.nodes[cluster.node].disk = cluster.fit.disk;
      for (const std::uint32_t end : cluster.ends)
        graph_.links[end / 2].node[end % 2] = cluster.node;
    }
    const std::size_t kept = graph_.nodes.size() - gone.size();
    std::vector<std::uint32_t> place(gone.size());
    fill_gaps(graph_.nodes, gone,
              [&](std::uint32_t from, std::uint32_t to) { place[from - kept] = to; });
    for (Link& edge : graph_.links)
      for (std::uint32_t& node : edge.node)
        if (node >= kept) node = place[node - kept];
    std::sort(contracted.begin(), contracted.end());
    fill_gaps(graph_.links, contracted, [](std::uint32_t, std::uint32_t) {});
  }

  const Boundary& boundary_;
  const site::BoundaryTree& tree_;
  double tolerance_;
  Graph& graph_;
  /// The edges at the nodes of short edges, as linked lists of their ends: end 2 e + k is node[k]
  /// of edge e.
  std::vector<std::uint32_t> first_end_;
  std::unique_ptr<std::uint32_t[]> next_end_;
  std::vector<std::uint32_t> nodes_;       ///< that are in a cluster, increasing
  std::vector<std::uint32_t> parent_;      ///< of each cluster: the one that it has become part of
  std::vector<Cluster> clusters_;          ///< of each of nodes_
  std::vector<std::uint32_t> candidates_;  ///< edges, increasing
};

}  // namespace

void merge_ties(const Boundary& boundary, const site::BoundaryTree& tree, double tolerance,
                Graph& graph) {
  Merger(boundary, tree, tolerance, graph).merge();
}

}  // namespace medial::disks
