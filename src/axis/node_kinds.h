#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "medial/axis.h"

namespace medial {

/// The kind of a node by its number of edges. A node without edges, the only point of its axis, is
/// a leaf.
constexpr NodeKind kind_of_degree(std::size_t degree) {
  return degree <= 1 ? NodeKind::leaf : degree == 2 ? NodeKind::site_change : NodeKind::branching;
}

/// The number of edges at each node; an edge from a node to itself counts twice. O(nodes + edges).
std::vector<std::uint32_t> degrees_of(const MedialAxis& axis);

/// The node of the largest radius; of equal ones, the lowest. Requires a node.
std::uint32_t deepest_node(const MedialAxis& axis);

/// The number of branches() of the graph of the counted edges only. O(edges).
std::uint64_t branch_count(const MedialAxis& axis,
                           const std::function<bool(std::uint32_t edge)>& counts);

/// Sets the kind of every node from the number of its edges. O(nodes + edges).
void set_node_kinds(MedialAxis& axis);

}  // namespace medial
