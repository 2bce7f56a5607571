// Necks: the saddles of the radius on the graph of the axis.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "axis/curve.h"
#include "axis/steps.h"
#include "base/compat.h"
#include "base/disjoint_sets.h"
#include "medial/measure.h"
#include "medial/query.h"
#include "ops/routes.h"

namespace medial {

namespace {

/// An edge without an inner maximum of the radius, or a part of one up to its maximum.
struct Link {
  std::uint32_t from, to;  ///< nodes; a maximum is a node of its own, after those of the axis
  EdgePlace place;         ///< of its smallest radius
  double narrowest;
};

bool is_inner(EdgePlace place) { return place.t > 0 && place.t < 1; }

/// Whether the radius does not change along an edge up to rounding.
bool is_flat(const MedialAxis& axis, std::uint32_t edge) {
  return ops::narrowest_place(axis, edge).t == 0.5 && ops::widest_place(axis, edge).t == 0.5;
}

/// Chains of flat edges: each goes on where exactly two of them meet.
class FlatChains {
 public:
  explicit FlatChains(const MedialAxis& axis)
      : axis_(axis), incidence_(axis), middle_(axis.edges.size()) {}

  /// The middle of the chain that a place lies on, or at the end of; else the place. O(n) for any
  /// number of places.
  EdgePlace middle(EdgePlace place) {
    if (is_flat(axis_, place.edge)) return middle_of_chain(place.edge);
    // An end of the edge that is as narrow up to rounding.
    const Edge& own = axis_.edges[place.edge];
    const double radius = disk_at(axis_, own, place.t).radius;
    for (const std::uint32_t node : own.node) {
      if (axis_.nodes[node].disk.radius - radius > 4 * axis_.tolerance) continue;
      const FlatEnds ends = flat_ends(node);
      if (ends.count > 0) return ends.count <= 2 ? middle_of_chain(ends.edge[0]) : place;
    }
    return place;
  }

 private:
  /// The flat edges at a node, of which the first two are known; loops count twice.
  struct FlatEnds {
    std::size_t count = 0;
    std::array<std::uint32_t, 2> edge{};
  };
  FlatEnds flat_ends(std::uint32_t node) const {
    FlatEnds ends;
    for (const std::uint32_t edge : incidence_.edges(node)) {
      if (!is_flat(axis_, edge)) continue;
      if (ends.count < 2) ends.edge[ends.count] = edge;
      ++ends.count;
    }
    return ends;
  }

  /// The steps from a node on, up to the end of the chain or to where it is closed.
  void follow(std::uint32_t node, std::uint32_t first, std::vector<Step>& chain) const {
    for (std::uint32_t before = first;;) {
      const FlatEnds ends = flat_ends(node);
      if (ends.count != 2) return;
      const std::uint32_t next = ends.edge[ends.edge[0] == before ? 1 : 0];
      if (next == first) return;
      chain.push_back({next, axis_.edges[next].node[0] == node});
      node = head_of(axis_, chain.back());
      before = next;
    }
  }

  EdgePlace middle_of_chain(std::uint32_t edge) {
    if (middle_[edge]) return *middle_[edge];
    const auto [from, to] = axis_.edges[edge].node;
    std::vector<Step> chain;
    follow(from, edge, chain);
    const bool closed = !chain.empty() && head_of(axis_, chain.back()) == to;
    reverse(chain);
    chain.push_back({edge, true});
    if (!closed) follow(to, edge, chain);
    const EdgePlace middle = middle_of(chain);
    for (const Step step : chain) middle_[step.edge] = middle;
    return middle;
  }

  EdgePlace middle_of(const std::vector<Step>& chain) const {
    double half = 0;
    for (const Step step : chain) half += 0.5 * length(axis_, axis_.edges[step.edge]);
    for (const Step step : chain) {
      const Curve curve = curve_of(axis_, axis_.edges[step.edge]);
      const double whole = curve.length();
      if (half <= whole) return {step.edge, curve.at_length(step.forward ? half : whole - half)};
      half -= whole;
    }
    return {chain.back().edge, chain.back().forward ? 1.0 : 0.0};
  }

  const MedialAxis& axis_;
  const Incidence incidence_;
  std::vector<std::optional<EdgePlace>> middle_;  ///< of each edge's chain, once known
};

}  // namespace

std::vector<Neck> necks(const MedialAxis& axis, double widening) {
  std::vector<Link> links;
  links.reserve(axis.edges.size());
  std::vector<double> widest;
  for (const Node& node : axis.nodes) widest.push_back(node.disk.radius);
  for (std::uint32_t i = 0; i < axis.edges.size(); ++i) {
    const auto [from, to] = axis.edges[i].node;
    const EdgePlace top = ops::widest_place(axis, i);
    if (is_inner(top) && !is_flat(axis, i)) {
      const auto node = static_cast<std::uint32_t>(widest.size());
      widest.push_back(disk_at(axis, axis.edges[i], top.t).radius);
      links.push_back({from, node, {i, 0}, axis.nodes[from].disk.radius});
      links.push_back({node, to, {i, 1}, axis.nodes[to].disk.radius});
    } else {
      links.push_back(
          {from, to, ops::narrowest_place(axis, i), ops::narrowest_radius(axis, {i, 0, 1})});
    }
  }
  ranges::stable_sort(links, std::greater<>(), &Link::narrowest);

  // Parts of larger radius than the link at hand, and their widest disks.
  DisjointSets parts(widest.size());
  FlatChains chains(axis);
  std::vector<Neck> found;
  for (const Link& link : links) {
    const std::uint32_t a = parts.find(link.from), b = parts.find(link.to);
    const double opens_to = std::min(widest[a], widest[b]);
    if (opens_to >= widening * link.narrowest && opens_to > 0) {
      const EdgePlace place = chains.middle(link.place);
      found.push_back({place, ops::width_at(axis, place), opens_to, a == b});
    }
    if (a == b) continue;
    parts.join(a, b);
    widest[parts.find(a)] = std::max(widest[a], widest[b]);
  }
  // Several edges may have their narrowest place in one node: the neck that opens most.
  ranges::stable_sort(found, [](const Neck& a, const Neck& b) {
    return a.around_hole != b.around_hole ? b.around_hole : a.prominence() > b.prominence();
  });
  std::set<std::pair<double, double>> seen;
  std::erase_if(found, [&seen](const Neck& neck) {
    const Vec2 center = neck.width.disk.center;
    return !seen.emplace(center.x, center.y).second;
  });
  return found;
}

}  // namespace medial
