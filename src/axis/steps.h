#pragma once

// Traversal of edges and chains of edges.

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

/// The step that continues a chain through a node of degree two.
inline Step next_step(const MedialAxis& axis, const Incidence& incidence, Step step) {
  const std::uint32_t node = head_of(axis, step);
  const auto around = incidence.edges(node);
  const std::uint32_t edge = around[0] == step.edge ? around[1] : around[0];
  if (edge == step.edge) return step;  // a loop edge
  return {edge, axis.edges[edge].node[0] == node};
}

/// Calls take(step, starts) for the steps of branches(axis), in order. O(edges).
template <class Take>
void walk_branches(const MedialAxis& axis, Take take) {
  const Incidence incidence(axis);
  std::vector<bool> used(axis.edges.size(), false);
  for (std::uint32_t lowest = 0; lowest < axis.edges.size(); ++lowest) {
    if (used[lowest]) continue;
    // Go back to the start of the branch, or once around a closed chain.
    Step step{lowest, false};
    while (incidence.degree(head_of(axis, step)) == 2) {
      const Step next = next_step(axis, incidence, step);
      if (next.edge == lowest) break;
      step = next;
    }
    step.forward = !step.forward;
    for (bool starts = true; !used[step.edge]; starts = false) {
      used[step.edge] = true;
      take(step, starts);
      if (incidence.degree(head_of(axis, step)) == 2) step = next_step(axis, incidence, step);
    }
  }
}

/// Reverses a chain of steps.
inline void reverse(std::vector<Step>& steps) {
  std::reverse(steps.begin(), steps.end());
  for (Step& step : steps) step.forward = !step.forward;
}

/// The box around the disks of all nodes.
inline Box box_of_disks(const MedialAxis& axis) {
  Box box = Box::nothing();
  for (const Node& node : axis.nodes) {
    const Vec2 reach{node.disk.radius, node.disk.radius};
    box.add(Box{node.disk.center - reach, node.disk.center + reach});
  }
  return box;
}

/// A straight edge between two nodes, along which the radius is linear.
inline Edge straight_edge(const MedialAxis& axis, std::uint32_t from, std::uint32_t to,
                          std::uint32_t site = no_site) {
  const Disk &a = axis.nodes[from].disk, &b = axis.nodes[to].disk;
  return {{from, to},
          {site, site},
          {midpoint(a.center, b.center), a.radius + 0.5 * (b.radius - a.radius)},
          1};
}

}  // namespace medial
