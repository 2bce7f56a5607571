// Necks: the saddles of the radius on the graph of the axis.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
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

/// The middle of the flat edges that a place lies on, or at the end of.
EdgePlace middle_of_flat(const MedialAxis& axis, const Incidence& incidence, EdgePlace place) {
  std::vector<Step> chain;
  const auto follow = [&](std::uint32_t node, std::uint32_t before) {
    for (bool more = true; more;) {
      more = false;
      for (const std::uint32_t edge : incidence.edges(node)) {
        const bool seen = edge == before ||
                          ranges::any_of(chain, [edge](Step step) { return step.edge == edge; });
        if (seen || !is_flat(axis, edge)) continue;
        chain.push_back({edge, axis.edges[edge].node[0] == node});
        node = head_of(axis, chain.back());
        before = edge;
        more = true;
        break;
      }
    }
  };
  const Edge& own = axis.edges[place.edge];
  if (is_flat(axis, place.edge)) {
    follow(own.node[0], place.edge);
    reverse(chain);
    chain.push_back({place.edge, true});
    follow(own.node[1], place.edge);
  } else {
    // An end of the edge that is as narrow up to rounding.
    const double radius = disk_at(axis, own, place.t).radius;
    for (const std::uint32_t node : own.node)
      if (chain.empty() && axis.nodes[node].disk.radius - radius <= 4 * axis.tolerance)
        follow(node, place.edge);
  }
  if (chain.empty()) return place;
  double half = 0;
  for (const Step step : chain) half += 0.5 * length(axis, axis.edges[step.edge]);
  for (const Step step : chain) {
    const Curve curve = curve_of(axis, axis.edges[step.edge]);
    const double whole = curve.length();
    if (half <= whole) return {step.edge, curve.at_length(step.forward ? half : whole - half)};
    half -= whole;
  }
  return place;
}

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
  const Incidence incidence(axis);
  std::vector<Neck> found;
  for (const Link& link : links) {
    const std::uint32_t a = parts.find(link.from), b = parts.find(link.to);
    const double opens_to = std::min(widest[a], widest[b]);
    if (opens_to >= widening * link.narrowest && opens_to > 0) {
      const EdgePlace place = middle_of_flat(axis, incidence, link.place);
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
