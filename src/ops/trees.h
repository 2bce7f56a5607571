#pragma once

// The core of a graph (all cycles and the paths between them, or the deepest place of each part
// that is a tree), and the trees attached to it.

#include <cstdint>
#include <vector>

#include "axis/node_kinds.h"
#include "axis/steps.h"
#include "base/numbers.h"
#include "medial/axis.h"
#include "ops/half_edges.h"

namespace medial::ops {

/// Repeatedly removes edges at nodes of degree one, outer edges first, unless stays(node). Calls
/// take(edge, leaf, inner node) for each. Returns the remaining degree of each node. O(n).
template <class Stays, class Take>
std::vector<std::uint32_t> take_off_leaves(const MedialAxis& axis, const Stays& stays,
                                           const Take& take) {
  std::vector<std::uint32_t> degree = degrees_of(axis);
  // The exclusive or of the edges at a node of degree 1 is its only edge.
  std::vector<std::uint32_t> last(degree.size(), 0), leaves;
  for (std::uint32_t e = 0; e < axis.edges.size(); ++e)
    for (const std::uint32_t node : axis.edges[e].node) last[node] ^= e;
  const auto consider = [&](std::uint32_t node) {
    if (degree[node] == 1 && !stays(node)) leaves.push_back(node);
  };
  for (std::uint32_t i = 0; i < degree.size(); ++i) consider(i);
  while (!leaves.empty()) {
    const std::uint32_t leaf = leaves.back();
    leaves.pop_back();
    if (degree[leaf] != 1) continue;  // the last node of a tree
    const std::uint32_t edge = last[leaf], inner = other_end(axis.edges[edge], leaf);
    degree[leaf] = 0;
    last[inner] ^= edge;
    --degree[inner];
    take(edge, leaf, inner);
    consider(inner);
  }
  return degree;
}

struct Trees {
  /// The edges of all trees, outer edges first.
  std::vector<std::uint32_t> order;
  /// Of each node: the edge that leads to the core, or none in the core.
  std::vector<std::uint32_t> inwards;
  /// Of each node: its connected part, counted from 0.
  std::vector<std::uint32_t> part;
  /// Of each connected part: its deepest node, and the radius of its deepest disk. That disk may
  /// lie inside an edge, between two arcs; then `deepest_edge` is that edge, or else none.
  std::vector<std::uint32_t> deepest, deepest_edge;
  std::vector<double> radius;

  /// O(n). The core of a tree is its deepest node, or its deepest edge.
  explicit Trees(const MedialAxis& axis);

  bool in_tree(const MedialAxis& axis, std::uint32_t edge) const {
    const auto& node = axis.edges[edge].node;
    return inwards[node[0]] == edge || inwards[node[1]] == edge;
  }
  /// Which end of an edge of a tree is farther out: 0 or 1.
  int outer_end(const MedialAxis& axis, std::uint32_t edge) const {
    return inwards[axis.edges[edge].node[0]] == edge ? 0 : 1;
  }
};

}  // namespace medial::ops
