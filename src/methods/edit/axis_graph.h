#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "medial/axis.h"
#include "methods/edit/rings.h"

namespace medial::edit {

/// Lists reserve room for one more element per this many, so that few edits need to reallocate.
constexpr std::size_t spare_share = 8;

/// Reserves room for `count` elements in all, and at least doubles the capacity when it grows, so
/// that adding an element costs O(1) amortized.
template <class T>
void make_room(std::vector<T>& all, std::size_t count) {
  if (count > all.capacity()) all.reserve(std::max(count, 2 * all.capacity()));
}

/// Lists of numbers with insertion and removal in O(1). Each number is in one list.
class NumberLists {
 public:
  std::uint32_t first(std::uint32_t list) const {
    return list < first_.size() ? first_[list] : none;
  }
  std::uint32_t next(std::uint32_t number) const { return links_[number][0]; }
  void reserve(std::size_t lists, std::size_t numbers) {
    first_.reserve(lists + lists / spare_share);
    links_.reserve(numbers + numbers / spare_share);
  }
  void make_room(std::size_t lists, std::size_t numbers) {
    edit::make_room(first_, lists);
    edit::make_room(links_, numbers);
  }
  void add(std::uint32_t list, std::uint32_t number);
  void remove(std::uint32_t list, std::uint32_t number);

 private:
  std::vector<std::uint32_t> first_;
  std::vector<std::array<std::uint32_t, 2>> links_;  ///< next, before
};

/// A mutable axis in the local frame. Nodes and edges keep their numbers; the numbers of removed
/// ones are reused.
class AxisGraph {
 public:
  struct Edge {
    std::array<std::uint32_t, 2> node{none, none};  ///< from, to; none: the edge does not exist
    std::array<std::uint32_t, 2> site{none, none};  ///< left and right, numbered as in Rings
    Disk control;
    double weight = 1;
  };

  AxisGraph() = default;
  /// Copies an axis in the local frame. `sites` maps its sites to their numbers in Rings.
  AxisGraph(const MedialAxis& axis, const std::vector<std::uint32_t>& sites);

  std::size_t node_slots() const { return nodes_.size(); }
  std::size_t edge_slots() const { return edges_.size(); }
  std::size_t node_count() const { return nodes_.size() - unused_nodes_.size(); }
  bool has_node(std::uint32_t i) const { return i < nodes_.size() && nodes_[i].radius >= 0; }
  bool has_edge(std::uint32_t i) const { return i < edges_.size() && edges_[i].node[0] != none; }
  const Disk& disk(std::uint32_t node) const { return nodes_[node]; }
  const Edge& edge(std::uint32_t i) const { return edges_[i]; }
  std::size_t degree(std::uint32_t node) const;

  /// Calls visit(edge, k) for each edge whose node k is `node`; twice for an edge that is a cycle.
  template <class Visit>
  void for_edges_at(std::uint32_t node, const Visit& visit) const {
    for (std::uint32_t end = at_node_.first(node); end != none; end = at_node_.next(end))
      visit(end / 2, end % 2);
  }
  template <class Visit>
  void for_edges_of_site(std::uint32_t site, const Visit& visit) const {
    for (std::uint32_t end = at_site_.first(site); end != none; end = at_site_.next(end))
      visit(end / 2, end % 2);
  }

  /// Reserves memory, so that adding up to `nodes` nodes and `edges` edges cannot throw. `sites` is
  /// the number of sites.
  void make_room(std::size_t nodes, std::size_t edges, std::size_t sites);
  std::uint32_t add_node(const Disk& disk);
  std::uint32_t add_edge(const Edge& edge);
  void remove_node(std::uint32_t node);
  void remove_edge(std::uint32_t edge);

 private:
  std::vector<Disk> nodes_;  ///< a radius below 0: the node does not exist
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> unused_nodes_, unused_edges_;
  NumberLists at_node_, at_site_;  ///< of edge ends: 2 edge + k
};

}  // namespace medial::edit
