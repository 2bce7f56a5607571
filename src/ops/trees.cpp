#include "ops/trees.h"

#include "base/disjoint_sets.h"

namespace medial::ops {

Trees::Trees(const MedialAxis& axis)
    : inwards(axis.nodes.size(), no_edge), part(axis.nodes.size()) {
  const std::size_t n = axis.nodes.size();
  DisjointSets sets(n);
  std::vector<std::uint32_t> degree(n, 0);
  for (const Edge& edge : axis.edges) {
    sets.join(edge.node[0], edge.node[1]);
    ++degree[edge.node[0]];
    ++degree[edge.node[1]];
  }
  // A part is named by its lowest node, which comes first.
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t lowest = sets.find(i);
    if (lowest == i) {
      part[i] = static_cast<std::uint32_t>(deepest.size());
      deepest.push_back(i);
      continue;
    }
    part[i] = part[lowest];
    std::uint32_t& deep = deepest[part[i]];
    if (axis.nodes[i].disk.radius > axis.nodes[deep].disk.radius) deep = i;
  }
  // The sum of the edges at a node is the last one left when its degree is 1.
  std::vector<std::uint32_t> last(n, 0);
  for (std::uint32_t e = 0; e < axis.edges.size(); ++e)
    for (const std::uint32_t node : axis.edges[e].node) last[node] ^= e;
  std::vector<std::uint32_t> leaves;
  const auto consider = [&](std::uint32_t node) {
    if (degree[node] == 1 && deepest[part[node]] != node) leaves.push_back(node);
  };
  for (std::uint32_t i = 0; i < n; ++i) consider(i);
  while (!leaves.empty()) {
    const std::uint32_t node = leaves.back();
    leaves.pop_back();
    const std::uint32_t e = last[node];
    const auto& ends = axis.edges[e].node;
    const std::uint32_t inner = ends[0] == node ? ends[1] : ends[0];
    order.push_back(e);
    inwards[node] = e;
    degree[node] = 0;
    last[inner] ^= e;
    --degree[inner];
    consider(inner);
  }
  // The deepest node of a part with cycles is no leaf that must stay: a tree that hangs on a cycle
  // may hold it.
  for (const std::uint32_t deep : deepest) {
    std::uint32_t node = deep;
    // What is left of a tree is its deepest node alone; of a part with cycles, a path from it.
    while (degree[node] == 1) {
      const std::uint32_t e = last[node];
      const auto& ends = axis.edges[e].node;
      const std::uint32_t inner = ends[0] == node ? ends[1] : ends[0];
      order.push_back(e);
      inwards[node] = e;
      degree[node] = 0;
      last[inner] ^= e;
      --degree[inner];
      node = inner;
    }
  }
}

}  // namespace medial::ops
