#include "support/same_graph.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "axis/steps.h"
#include "base/disjoint_sets.h"
#include "base/predicates.h"
#include "medial/query.h"

namespace medial::test {
namespace {

using Link = SiteGraph::Link;
using SitePair = std::array<std::uint32_t, 2>;

/// A link in the direction away from a node.
struct Leaving {
  std::uint32_t right = 0, left = 0;
};

/// Whether a node only divides the way between two others: its two edges have the same two sites.
bool divides_link(const MedialAxis& axis, const Incidence& incidence, std::uint32_t node) {
  if (incidence.degree(node) != 2) return false;
  const Edge &a = axis.edges[incidence.edges(node)[0]], &b = axis.edges[incidence.edges(node)[1]];
  if (&a == &b) return false;
  const bool a_leaves = a.node[0] == node, b_leaves = b.node[0] == node;
  return a_leaves == b_leaves ? a.site[0] == b.site[1] && a.site[1] == b.site[0] : a.site == b.site;
}

/// From an edge's end on, through nodes that divide the link, to the node where it ends.
std::uint32_t far_end(const MedialAxis& axis, const Incidence& incidence,
                      const std::vector<bool>& inner, std::uint32_t edge, std::uint32_t node,
                      std::vector<bool>& used) {
  used[edge] = true;
  while (inner[node] && !(used[incidence.edges(node)[0]] && used[incidence.edges(node)[1]])) {
    const auto around = incidence.edges(node);
    edge = used[around[0]] ? around[1] : around[0];
    used[edge] = true;
    node = axis.edges[edge].node[axis.edges[edge].node[0] == node ? 1 : 0];
  }
  return node;
}

std::vector<Link> links_of(const MedialAxis& axis) {
  const Incidence incidence(axis);
  std::vector<bool> inner(axis.nodes.size()), used(axis.edges.size(), false);
  for (std::uint32_t node = 0; node < axis.nodes.size(); ++node)
    inner[node] = divides_link(axis, incidence, node);
  std::vector<Link> links;
  for (std::uint32_t i = 0; i < axis.edges.size(); ++i) {
    const Edge& edge = axis.edges[i];
    if (used[i] || (inner[edge.node[0]] && inner[edge.node[1]])) continue;
    const std::size_t begin = inner[edge.node[0]] ? 1 : 0;
    const std::uint32_t end = far_end(axis, incidence, inner, i, edge.node[1 - begin], used);
    links.push_back({{edge.node[begin], end}, {edge.site[begin], edge.site[1 - begin]}});
  }
  return links;
}

/// The sites that a node's disk touches: those on the right of the links around it, and what the
/// boundary passes from the left of one to the right of the next. None where these do not meet.
std::vector<std::uint32_t> contacts_around(const std::vector<Leaving>& leaving,
                                           std::span<const Site> sites,
                                           const std::vector<std::uint32_t>& next) {
  const auto at = [&](std::uint32_t site) {
    return std::find_if(leaving.begin(), leaving.end(),
                        [&](const Leaving& one) { return one.right == site; });
  };
  const auto is_corner = [&](std::uint32_t site) {
    const Site &before = sites[site], &after = sites[next[site]];
    return before.kind() == SiteKind::segment && after.kind() == SiteKind::segment &&
           orientation(before.start, before.end, after.end) > 0;
  };
  std::vector<std::uint32_t> contacts;
  std::size_t left = leaving.size();
  for (auto one = leaving.begin();;) {
    contacts.push_back(one->right);
    --left;
    std::uint32_t site = one->left;
    for (one = at(site); one == leaving.end(); one = at(site)) {
      contacts.push_back(site);
      if (contacts.size() > sites.size() + leaving.size()) return {};
      if (is_corner(site) && leaving.size() > 1) return {};
      site = next[site];
    }
    if (one == leaving.begin()) break;
    if (left == 0) return {};
  }
  if (left > 0) contacts.clear();
  return contacts;
}

/// What a site is known by under all symmetries: kind and place; of a vertex also its neighbours,
/// since several loops may touch in it.
using SiteKey = std::tuple<SiteKind, std::vector<std::pair<double, double>>>;

std::map<SiteKey, std::uint32_t> sites_by_place(const Shape& shape, std::span<const Site> sites,
                                                const Symmetry& symmetry, bool mirrored) {
  const std::vector<std::uint32_t> next = next_sites(shape, sites);
  std::vector<std::uint32_t> before(sites.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i) before[next[i]] = i;
  std::map<SiteKey, std::uint32_t> places;
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    std::vector<Vec2> points{sites[i].start, sites[i].end};
    if (sites[i].kind() == SiteKind::vertex)
      points = {sites[before[i]].start, sites[i].start, sites[next[i]].end};
    if (mirrored) std::reverse(points.begin(), points.end());
    std::vector<std::pair<double, double>> place;
    for (const Vec2 p : points) place.emplace_back(symmetry(p).x, symmetry(p).y);
    places.emplace(SiteKey{sites[i].kind(), place}, i);
  }
  return places;
}

/// One graph, and which of its nodes are one after contraction.
class Contracted {
 public:
  Contracted(const SiteGraph& graph, std::span<const Site> sites)
      : graph_(graph), sites_(sites), sets_(graph.disks.size()), links_(graph.links) {
    for (Link& link : links_) {
      if (link.site[0] <= link.site[1]) continue;
      std::swap(link.site[0], link.site[1]);
      std::swap(link.node[0], link.node[1]);
    }
  }

  const std::vector<Link>& links() const { return links_; }
  Vec2 end(const Link& link, std::size_t which) const {
    return graph_.disks[link.node[which]].center;
  }
  std::uint32_t node(std::uint32_t i) { return sets_.find(i); }
  void contract(const Link& link) { sets_.join(link.node[0], link.node[1]); }

  /// The nodes that have become one, by the one that stands for them.
  std::map<std::uint32_t, std::vector<std::uint32_t>> clusters() {
    std::map<std::uint32_t, std::vector<std::uint32_t>> result;
    for (std::uint32_t i = 0; i < graph_.contacts.size(); ++i)
      if (!graph_.contacts[i].empty()) result[node(i)].push_back(i);
    return result;
  }
  const Disk& disk(std::uint32_t i) const { return graph_.disks[i]; }
  /// Two sites meet there. Elsewhere disks as small may be rounded to radius 0.
  bool is_corner(std::uint32_t i) const {
    return graph_.disks[i].radius == 0 && graph_.contacts[i].size() == 2;
  }
  /// Whether a disk touches all that the nodes' disks touch.
  bool touched(const std::vector<std::uint32_t>& nodes, const Disk& disk, double tolerance) const {
    return std::all_of(nodes.begin(), nodes.end(), [&](std::uint32_t i) {
      const std::vector<std::uint32_t>& contacts = graph_.contacts[i];
      return std::all_of(contacts.begin(), contacts.end(), [&](std::uint32_t site) {
        const Vec2 nearest = foot(sites_[site], disk.center);
        return std::abs(distance(nearest, disk.center) - disk.radius) <= tolerance;
      });
    });
  }

 private:
  const SiteGraph& graph_;
  std::span<const Site> sites_;
  DisjointSets sets_;
  std::vector<Link> links_;
};

std::string name_of(const Link& link) {
  return "the edge between the sites " + std::to_string(link.site[0]) + " and " +
         std::to_string(link.site[1]);
}

using LinkPairs = std::vector<std::pair<const Link*, const Link*>>;

/// The links that both have; contracts all others. At a convex corner no link may be missing,
/// though the next disk on it touches the same sites.
LinkPairs common_links(Contracted& first, Contracted& second, std::string& failure) {
  const auto contract = [&](Contracted& graph, const Link& link) {
    if (graph.is_corner(link.node[0]) || graph.is_corner(link.node[1]))
      failure = name_of(link) + ", at a corner, is in one of them only";
    graph.contract(link);
  };
  std::map<SitePair, std::vector<const Link*>> by_sites;
  for (const Link& link : second.links()) by_sites[link.site].push_back(&link);
  LinkPairs common;
  for (const Link& link : first.links()) {
    auto& others = by_sites[link.site];
    const auto off = [&](const Link* other) {
      return distance(first.end(link, 0), second.end(*other, 0)) +
             distance(first.end(link, 1), second.end(*other, 1));
    };
    const auto nearest =
        std::min_element(others.begin(), others.end(),
                         [&](const Link* x, const Link* y) { return off(x) < off(y); });
    if (nearest == others.end()) {
      contract(first, link);
      continue;
    }
    common.emplace_back(&link, *nearest);
    others.erase(nearest);
  }
  for (const auto& [pair, others] : by_sites)
    for (const Link* link : others) contract(second, *link);
  return common;
}

}  // namespace

std::vector<std::uint32_t> next_sites(const Shape& shape, std::span<const Site> sites) {
  std::vector<std::uint32_t> next(sites.size());
  std::uint32_t site = 0;
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
    const std::uint32_t first = site;
    for (std::size_t edges = shape.loop(loop).size(); edges > 0 && site < sites.size(); ++site) {
      next[site] = site + 1;
      if (sites[site].kind() != SiteKind::vertex) --edges;
    }
    if (site > first) next[site - 1] = first;
  }
  return next;
}

SiteGraph graph_of(const Shape& shape, const MedialAxis& axis) {
  SiteGraph graph;
  graph.links = links_of(axis);
  graph.contacts.resize(axis.nodes.size());
  for (const Node& node : axis.nodes) graph.disks.push_back(node.disk);
  std::vector<std::vector<Leaving>> leaving(axis.nodes.size());
  for (const Link& link : graph.links) {
    leaving[link.node[0]].push_back({link.site[1], link.site[0]});
    leaving[link.node[1]].push_back({link.site[0], link.site[1]});
  }
  const std::vector<std::uint32_t> next = next_sites(shape, axis.sites);
  for (std::uint32_t i = 0; i < axis.nodes.size(); ++i) {
    if (axis.nodes.size() == 1)  // the centre of a disk, which touches all
      for (std::uint32_t site = 0; site < axis.sites.size(); ++site)
        graph.contacts[i].push_back(site);
    if (leaving[i].empty()) continue;
    graph.contacts[i] = contacts_around(leaving[i], axis.sites, next);
    if (graph.contacts[i].empty())
      graph.failure = "the edges around node " + std::to_string(i) + " are out of order";
  }
  return graph;
}

MedialAxis moved_back(const Shape& shape, std::span<const Site> sites, const Shape& image,
                      MedialAxis axis, const Symmetry& symmetry) {
  const double area = symmetry.xx * symmetry.yy - symmetry.xy * symmetry.yx;
  const bool mirrored = area < 0;
  for (Node& node : axis.nodes) {
    const Vec2 p = node.disk.center - Vec2{symmetry.dx, symmetry.dy};
    node.disk.center = {(symmetry.yy * p.x - symmetry.xy * p.y) / area,
                        (symmetry.xx * p.y - symmetry.yx * p.x) / area};
    node.disk.radius /= symmetry.scale();
  }
  const auto own = sites_by_place(shape, sites, symmetry, mirrored);
  const auto others = sites_by_place(image, axis.sites, {}, false);
  std::vector<std::uint32_t> number(axis.sites.size());
  axis.sites.clear();
  if (own.size() != others.size()) return axis;
  for (auto a = own.begin(), b = others.begin(); a != own.end(); ++a, ++b) {
    if (a->first != b->first) return axis;
    number[b->second] = a->second;
  }
  axis.sites.assign(sites.begin(), sites.end());
  for (Edge& edge : axis.edges) {
    edge.site = {number[edge.site[0]], number[edge.site[1]]};
    if (mirrored) std::swap(edge.site[0], edge.site[1]);
  }
  return axis;
}

std::string difference(std::span<const Site> sites, const SiteGraph& a, const SiteGraph& b,
                       double tolerance) {
  for (const SiteGraph* one : {&a, &b})
    if (!one->failure.empty()) return one->failure;
  Contracted first(a, sites), second(b, sites);
  std::string failure;
  const LinkPairs common = common_links(first, second, failure);
  if (!failure.empty()) return failure;
  std::map<std::uint32_t, std::uint32_t> forth, back;
  for (const auto& [x, y] : common) {
    for (std::size_t i = 0; i < 2; ++i) {
      const std::uint32_t u = first.node(x->node[i]), v = second.node(y->node[i]);
      if (forth.emplace(u, v).first->second != v || back.emplace(v, u).first->second != u)
        return name_of(*x) + " ends in different nodes";
    }
  }
  const auto those = first.clusters(), these = second.clusters();
  if (those.size() != these.size()) return "the numbers of nodes differ";
  if (common.empty() && those.size() == 1)
    forth.emplace(those.begin()->first, these.begin()->first);
  for (const auto& entry : those) {
    const std::vector<std::uint32_t>& nodes = entry.second;
    const auto other = forth.find(entry.first);
    if (other == forth.end()) continue;
    const std::vector<std::uint32_t>& others = these.at(other->second);
    if (nodes.size() == 1 && others.size() == 1) continue;
    const auto touches_all = [&](const Disk& disk) {
      return first.touched(nodes, disk, tolerance) && second.touched(others, disk, tolerance);
    };
    if (!std::any_of(nodes.begin(), nodes.end(),
                     [&](std::uint32_t i) { return touches_all(first.disk(i)); }) &&
        !std::any_of(others.begin(), others.end(),
                     [&](std::uint32_t i) { return touches_all(second.disk(i)); }))
      return "no disk touches all sites around node " + std::to_string(nodes[0]);
  }
  return {};
}

std::string difference(const Shape& shape, const MedialAxis& a, const MedialAxis& b,
                       double tolerance) {
  if (a.sites.size() != b.sites.size()) return "the sites differ";
  return difference(a.sites, graph_of(shape, a), graph_of(shape, b), tolerance);
}

}  // namespace medial::test
