#pragma once

// The graph of a planar graph's Voronoi diagram in a form that can be compared with another
// program's.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "medial/voronoi.h"

namespace medial::test {

/// An edge by the two sites that it separates and its ends; `nowhere` for an end outside of the
/// enclosure.
struct SeparatingEdge {
  std::array<std::uint32_t, 2> sites;  ///< points of the planar graph, then edges; increasing
  std::array<Vec2, 2> ends;
};
constexpr Vec2 nowhere{std::numeric_limits<double>::infinity(), 0};

/// Points and segments on a grid of integers that have no more than ends in common.
inline std::vector<Chain> random_integer_planar_graph(std::uint64_t seed) {
  medial::Random random(seed);
  const std::uint32_t side = seed % 2 == 0 ? 12 : 1000;
  const auto place = [&] {
    return Vec2{static_cast<double>(random.below(side)), static_cast<double>(random.below(side))};
  };
  std::vector<Chain> chains;
  for (std::uint32_t i = 0, n = 2 + random.below(20); i < n; ++i) {
    Chain chain{{place()}};
    while (chain.points.size() < 5 && random.below(4) > 0) chain.points.push_back(place());
    chain.closed = chain.points.size() > 2 && random.below(3) == 0;
    chains.push_back(chain);
    if (!build_planar_graph(chains)) chains.pop_back();
  }
  if (chains.empty()) chains.push_back({{place()}});
  return chains;
}

/// An enclosure far around a planar graph.
inline Box enclosure_around(const PlanarGraph& planar_graph) {
  const Box box = bounding_box(planar_graph);
  const double margin = 20.37 * (1 + diagonal(box));
  return {box.low - Vec2{margin, margin}, box.high + Vec2{margin, margin}};
}

/// Puts edges of any diagram of this planar graph into the form in which they are compared: without
/// those shorter than `near` (ties) and those outside the enclosure. What separates an edge from
/// its own end is divided there; where the next edge goes straight on, so that the end's face is
/// empty, it separates the two edges.
class EdgesInForm {
 public:
  EdgesInForm(const PlanarGraph& planar_graph, const Box& enclosure, double near)
      : planar_graph_(planar_graph), enclosure_(enclosure), near_(near) {}

  void add(std::uint32_t one, std::uint32_t other, Vec2 from, Vec2 to) {
    from = inside(from) ? from : nowhere;
    to = inside(to) ? to : nowhere;
    auto [low, high] = std::minmax({one, other});
    if (!ends_at(high, low)) return keep({{low, high}, {from, to}});
    const Vec2 end = planar_graph_.points[low];
    if (const auto next = straight_on(high, low)) {
      if (*next < high) return;  // the same again
      low = high;
      high = *next;
    }
    if (distance(from, end) <= near_ || distance(to, end) <= near_)
      return keep({{low, high}, {from, to}});
    keep({{low, high}, {from, end}});
    keep({{low, high}, {end, to}});
  }
  const std::vector<SeparatingEdge>& edges() const { return edges_; }

 private:
  bool inside(Vec2 p) const {
    return p.x > enclosure_.low.x + near_ && p.x < enclosure_.high.x - near_ &&
           p.y > enclosure_.low.y + near_ && p.y < enclosure_.high.y - near_;
  }
  bool ends_at(std::uint32_t site, std::uint32_t point) const {
    if (point >= planar_graph_.points.size() || site < planar_graph_.points.size()) return false;
    const PlanarGraphEdge& edge = planar_graph_.edges[site - planar_graph_.points.size()];
    return edge.from == point || edge.to == point;
  }
  Vec2 direction(std::uint32_t site, std::uint32_t end) const {
    const PlanarGraphEdge& edge = planar_graph_.edges[site - planar_graph_.points.size()];
    return planar_graph_.points[edge.from == end ? edge.to : edge.from] - planar_graph_.points[end];
  }
  std::optional<std::uint32_t> straight_on(std::uint32_t site, std::uint32_t end) const {
    const auto first = static_cast<std::uint32_t>(planar_graph_.points.size());
    for (std::uint32_t next = first; next < first + planar_graph_.edges.size(); ++next) {
      if (next == site || !ends_at(next, end)) continue;
      const Vec2 u = direction(site, end), v = direction(next, end);
      if (cross(u, v) == 0 && dot(u, v) < 0) return next;
    }
    return std::nullopt;
  }
  void keep(const SeparatingEdge& edge) {
    const auto& [from, to] = edge.ends;
    if (from == nowhere && to == nowhere) return;
    if (!(distance(from, to) <= near_)) edges_.push_back(edge);
  }

  const PlanarGraph& planar_graph_;
  Box enclosure_;
  double near_;
  std::vector<SeparatingEdge> edges_;
};

inline std::vector<SeparatingEdge> edges_in_form(const PlanarGraph& planar_graph,
                                                 const VoronoiDiagram& diagram, double near) {
  EdgesInForm form(planar_graph, *diagram.enclosure, near);
  for (const VoronoiEdge& edge : diagram.edges)
    if (!edge.on_enclosure)
      form.add(edge.site[0], edge.site[1], diagram.nodes[edge.node[0]].disk.center,
               diagram.nodes[edge.node[1]].disk.center);
  return form.edges();
}

/// The first edge of `from` that has no like in `in`, in words; empty where each has its own.
inline std::string missing_edge(const std::vector<SeparatingEdge>& from,
                                const std::vector<SeparatingEdge>& in, double near) {
  std::multimap<std::array<std::uint32_t, 2>, std::array<Vec2, 2>> left;
  for (const SeparatingEdge& edge : in) left.emplace(edge.sites, edge.ends);
  const auto same = [&](Vec2 p, Vec2 q) { return p == q || distance(p, q) <= near; };
  for (const SeparatingEdge& edge : from) {
    const auto [begin, end] = left.equal_range(edge.sites);
    const auto found = std::find_if(begin, end, [&](const auto& other) {
      const auto& [p, q] = other.second;
      return (same(edge.ends[0], p) && same(edge.ends[1], q)) ||
             (same(edge.ends[0], q) && same(edge.ends[1], p));
    });
    if (found == end) {
      std::string text = "between sites " + std::to_string(edge.sites[0]) + " and " +
                         std::to_string(edge.sites[1]);
      for (const Vec2 p : edge.ends)
        text += " (" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")";
      return text;
    }
    left.erase(found);
  }
  return "";
}

}  // namespace medial::test
