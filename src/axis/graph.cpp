#include <algorithm>

#include "axis/node_kinds.h"
#include "axis/steps.h"
#include "base/disjoint_sets.h"
#include "medial/query.h"

namespace medial {

std::vector<std::uint32_t> degrees_of(const MedialAxis& axis) {
  std::vector<std::uint32_t> degree(axis.nodes.size(), 0);
  for (const Edge& edge : axis.edges)
    for (const std::uint32_t node : edge.node) ++degree[node];
  return degree;
}

void set_node_kinds(MedialAxis& axis) {
  const std::vector<std::uint32_t> degree = degrees_of(axis);
  for (std::size_t i = 0; i < degree.size(); ++i) axis.nodes[i].kind = kind_of_degree(degree[i]);
}

Incidence::Incidence(const MedialAxis& axis)
    : begin_(axis.nodes.size() + 1, 0), edges_(2 * axis.edges.size()) {
  for (const Edge& edge : axis.edges)
    for (const std::uint32_t node : edge.node) ++begin_[node];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  // From the last edge to the first, which fills the range of each node from its end.
  for (std::size_t i = axis.edges.size(); i-- > 0;)
    for (const std::uint32_t node : axis.edges[i].node)
      edges_[--begin_[node]] = static_cast<std::uint32_t>(i);
}

std::vector<Branch> branches(const MedialAxis& axis) {
  std::vector<Branch> out;
  std::vector<Step> steps;  // of one branch
  const auto finish = [&] {
    if (!steps.empty())
      out.push_back({steps, tail_of(axis, steps.front()), head_of(axis, steps.back())});
    steps.clear();
  };
  walk_branches(axis, [&](Step step, bool starts) {
    if (starts) finish();
    steps.push_back(step);
  });
  finish();
  return out;
}

std::uint64_t branch_count(const MedialAxis& axis) {
  return branch_count(axis, [](std::uint32_t) { return true; });
}

std::uint64_t branch_count(const MedialAxis& axis,
                           const std::function<bool(std::uint32_t edge)>& counts) {
  // A branch has two ends at nodes without two edges, or is a closed chain of nodes with two.
  std::vector<std::uint32_t> degree(axis.nodes.size(), 0);
  for (std::uint32_t e = 0; e < axis.edges.size(); ++e)
    if (counts(e))
      for (const std::uint32_t node : axis.edges[e].node) ++degree[node];
  std::uint64_t ends = 0, closed = 0;
  for (const std::uint32_t d : degree) ends += d == 2 ? 0 : d;
  DisjointSets chains(axis.nodes.size());
  for (std::uint32_t e = 0; e < axis.edges.size(); ++e) {
    const auto [a, b] = axis.edges[e].node;
    if (degree[a] == 2 && degree[b] == 2 && counts(e)) closed += chains.join(a, b) ? 0 : 1;
  }
  return ends / 2 + closed;
}

std::uint32_t deepest_node(const MedialAxis& axis) {
  const auto deepest =
      std::max_element(axis.nodes.begin(), axis.nodes.end(),
                       [](const Node& a, const Node& b) { return a.disk.radius < b.disk.radius; });
  return static_cast<std::uint32_t>(deepest - axis.nodes.begin());
}

}  // namespace medial
