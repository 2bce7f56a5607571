#pragma once

// Edges and chains of edges seen from their ends.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "medial/geometry.h"
#include "medial/query.h"

namespace medial {

/// The edges around each node, by increasing index; loops twice. Built in O(edges).
class Incidence {
 public:
  explicit Incidence(const MedialAxis& axis);
  std::span<const std::uint32_t> edges(std::uint32_t node) const {
    return std::span(edges_).subspan(begin_[node], degree(node));
  }
  std::size_t degree(std::uint32_t node) const { return begin_[node + 1] - begin_[node]; }

 private:
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> edges_;
};

/// The node at the other end of an edge.
inline std::uint32_t other_end(const Edge& edge, std::uint32_t node) {
  return edge.node[0] == node ? edge.node[1] : edge.node[0];
}
inline std::uint32_t tail_of(const MedialAxis& axis, Step step) {
  return axis.edges[step.edge].node[step.forward ? 0 : 1];
}
inline std::uint32_t head_of(const MedialAxis& axis, Step step) {
  return axis.edges[step.edge].node[step.forward ? 1 : 0];
}

/// Turns a chain of steps around.
inline void reverse(std::vector<Step>& steps) {
  std::reverse(steps.begin(), steps.end());
  for (Step& step : steps) step.forward = !step.forward;
}

/// Around the disks of all nodes.
inline Box box_of_disks(const MedialAxis& axis) {
  Box box = Box::nothing();
  for (const Node& node : axis.nodes) {
    const Vec2 reach{node.disk.radius, node.disk.radius};
    box.add(Box{node.disk.center - reach, node.disk.center + reach});
  }
  return box;
}

/// A straight edge between two nodes, along which the radius changes evenly.
inline Edge straight_edge(const MedialAxis& axis, std::uint32_t from, std::uint32_t to,
                          std::uint32_t site = no_site) {
  const Disk &a = axis.nodes[from].disk, &b = axis.nodes[to].disk;
  return {{from, to},
          {site, site},
          {midpoint(a.center, b.center), a.radius + 0.5 * (b.radius - a.radius)},
          1};
}

}  // namespace medial
