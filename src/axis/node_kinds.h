#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "medial/axis.h"

namespace medial {

/// The kind of a node by its number of edges; the only point of an axis, which has none, is a leaf.
constexpr NodeKind kind_of_degree(std::size_t degree) {
  return degree <= 1 ? NodeKind::leaf : degree == 2 ? NodeKind::site_change : NodeKind::branching;
}

/// The number of edges at each node; an edge from a node to itself counts twice. O(nodes + edges).
std::vector<std::uint32_t> degrees_of(const MedialAxis& axis);

/// The node of the largest radius, of equal ones the lowest. Requires a node.
std::uint32_t deepest_node(const MedialAxis& axis);

/// How many branches() there would be if it were for the edges that count alone. O(edges).
std::uint64_t branch_count(const MedialAxis& axis,
                           const std::function<bool(std::uint32_t edge)>& counts);

/// Sets the kind of every node from the number of its edges. O(nodes + edges).
void set_node_kinds(MedialAxis& axis);

}  // namespace medial
