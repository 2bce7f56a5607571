#include "methods/edit/axis_graph.h"

#include <algorithm>

namespace medial::edit {
namespace {

/// Returns a number that is free, or else the next one.
template <class T>
std::uint32_t take(std::vector<std::uint32_t>& unused, std::vector<T>& all) {
  if (unused.empty()) {
    all.emplace_back();
    return static_cast<std::uint32_t>(all.size() - 1);
  }
  const std::uint32_t number = unused.back();
  unused.pop_back();
  return number;
}

}  // namespace

void NumberLists::add(std::uint32_t list, std::uint32_t number) {
  if (list >= first_.size()) first_.resize(list + 1, none);
  if (number >= links_.size()) links_.resize(number + 1);
  links_[number] = {first_[list], none};
  if (first_[list] != none) links_[first_[list]][1] = number;
  first_[list] = number;
}

void NumberLists::remove(std::uint32_t list, std::uint32_t number) {
  const auto [next, before] = links_[number];
  if (before == none)
    first_[list] = next;
  else
    links_[before][0] = next;
  if (next != none) links_[next][1] = before;
}

AxisGraph::AxisGraph(const MedialAxis& axis, const std::vector<std::uint32_t>& sites) {
  const std::size_t node_count = axis.nodes.size(), edge_count = axis.edges.size();
  nodes_.reserve(node_count + node_count / spare_share);
  edges_.reserve(edge_count + edge_count / spare_share);
  at_node_.reserve(node_count, 2 * edge_count);
  at_site_.reserve(2 * sites.size(), 2 * edge_count);
  for (const Node& node : axis.nodes) add_node(node.disk);
  for (const medial::Edge& edge : axis.edges)
    add_edge({edge.node, {sites[edge.site[0]], sites[edge.site[1]]}, edge.control, edge.weight});
}

std::size_t AxisGraph::degree(std::uint32_t node) const {
  std::size_t count = 0;
  for_edges_at(node, [&](std::uint32_t, std::size_t) { ++count; });
  return count;
}

void AxisGraph::make_room(std::size_t nodes, std::size_t edges, std::size_t sites) {
  const std::size_t most_nodes = nodes_.size() + nodes, most_edges = edges_.size() + edges;
  edit::make_room(nodes_, most_nodes);
  edit::make_room(unused_nodes_, most_nodes);
  edit::make_room(edges_, most_edges);
  edit::make_room(unused_edges_, most_edges);
  at_node_.make_room(most_nodes, 2 * most_edges);
  at_site_.make_room(sites, 2 * most_edges);
}

std::uint32_t AxisGraph::add_node(const Disk& disk) {
  const std::uint32_t node = take(unused_nodes_, nodes_);
  nodes_[node] = {disk.center, std::max(0.0, disk.radius)};
  return node;
}

std::uint32_t AxisGraph::add_edge(const Edge& edge) {
  const std::uint32_t number = take(unused_edges_, edges_);
  edges_[number] = edge;
  for (std::uint32_t k = 0; k < 2; ++k) {
    at_node_.add(edge.node[k], 2 * number + k);
    at_site_.add(edge.site[k], 2 * number + k);
  }
  return number;
}

void AxisGraph::remove_node(std::uint32_t node) {
  nodes_[node].radius = -1;
  unused_nodes_.push_back(node);
}

void AxisGraph::remove_edge(std::uint32_t edge) {
  for (std::uint32_t k = 0; k < 2; ++k) {
    at_node_.remove(edges_[edge].node[k], 2 * edge + k);
    at_site_.remove(edges_[edge].site[k], 2 * edge + k);
  }
  edges_[edge].node = {none, none};
  unused_edges_.push_back(edge);
}

}  // namespace medial::edit
