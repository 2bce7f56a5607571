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
  // From the last edge to the first, so that a node's part is filled from its end to its begin.
  for (std::size_t i = axis.edges.size(); i-- > 0;)
    for (const std::uint32_t node : axis.edges[i].node)
      edges_[--begin_[node]] = static_cast<std::uint32_t>(i);
}

namespace {

/// The step that continues a chain through a node of degree two.
Step next_step(const MedialAxis& axis, const Incidence& incidence, Step step) {
  const std::uint32_t node = head_of(axis, step);
  const auto around = incidence.edges(node);
  const std::uint32_t edge = around[0] == step.edge ? around[1] : around[0];
  if (edge == step.edge) return step;  // an edge from the node to itself
  return {edge, axis.edges[edge].node[0] == node};
}

}  // namespace

std::vector<Branch> branches(const MedialAxis& axis) {
  const Incidence incidence(axis);
  std::vector<bool> used(axis.edges.size(), false);
  std::vector<Branch> out;
  for (std::size_t i = 0; i < axis.edges.size(); ++i) {
    if (used[i]) continue;
    const Step lowest{static_cast<std::uint32_t>(i), true};
    used[i] = true;
    Branch branch;
    // Backward from the lowest edge, then reversed; then forward from it.
    const auto extend = [&](Step step) {
      while (incidence.degree(head_of(axis, step)) == 2) {
        step = next_step(axis, incidence, step);
        if (used[step.edge]) break;  // once around
        used[step.edge] = true;
        branch.steps.push_back(step);
      }
    };
    extend({lowest.edge, false});
    reverse(branch.steps);
    branch.steps.push_back(lowest);
    extend(lowest);
    branch.from = tail_of(axis, branch.steps.front());
    branch.to = head_of(axis, branch.steps.back());
    out.push_back(std::move(branch));
  }
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
