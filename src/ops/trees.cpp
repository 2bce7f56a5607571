#include "ops/trees.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "medial/centreline.h"
#include "ops/routes.h"

namespace medial::ops {
Trees::Trees(const MedialAxis& axis) : inwards(axis.nodes.size(), none), part(axis.nodes.size()) {
  const std::size_t n = axis.nodes.size();
  DisjointSets sets(n);
  for (const Edge& edge : axis.edges) sets.join(edge.node[0], edge.node[1]);
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
  for (const std::uint32_t deep : deepest) radius.push_back(axis.nodes[deep].disk.radius);
  deepest_edge.assign(deepest.size(), none);
  std::vector<std::uint32_t> edges(deepest.size(), 0), nodes(deepest.size(), 0);
  for (const std::uint32_t p : part) ++nodes[p];
  for (std::uint32_t e = 0; e < axis.edges.size(); ++e) {
    const std::uint32_t p = part[axis.edges[e].node[0]];
    ++edges[p];
    // The radius stays in the hull of its control points.
    if (axis.edges[e].control.radius <= radius[p]) continue;
    const double inside = disk_at(axis, axis.edges[e], widest_place(axis, e).t).radius;
    if (inside <= radius[p] * (1 + 1e-9)) continue;
    radius[p] = inside;
    deepest_edge[p] = e;
  }
  // What a tree must keep.
  std::vector<bool> stays(n, false);
  for (std::uint32_t p = 0; p < deepest.size(); ++p) {
    if (edges[p] + 1 != nodes[p]) continue;
    if (deepest_edge[p] == none) {
      stays[deepest[p]] = true;
    } else {
      for (const std::uint32_t node : axis.edges[deepest_edge[p]].node) stays[node] = true;
    }
  }
  take_off_leaves(
      axis, [&](std::uint32_t node) { return stays[node]; },
      [&](std::uint32_t edge, std::uint32_t leaf, std::uint32_t) {
        order.push_back(edge);
        inwards[leaf] = edge;
      });
}

}  // namespace medial::ops
