#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial/axis.h"
#include "methods/lee/kernel.h"

namespace medial::lee {

/// Bit for bit: a tie that has been joined.
template <class D>
bool is_same(const D& a, const D& b) {
  return a.center.x == b.center.x && a.center.y == b.center.y && a.radius == b.radius;
}

/// A Voronoi edge B(e_i, e_j), i < j: the disks that touch both. Such a disk cuts off the boundary
/// between its two feet. Along the edge from its inner to its outer end this part grows: the foot
/// on e_i moves backward, the one on e_j forward.
template <class Kernel>
struct ListEdgeIn {
  std::array<std::uint32_t, 2> element;  ///< i < j
  /// The next edge inward in the two stacks that hold this one, see Diagram: those that end where
  /// this one begins. Each Voronoi point is the inner end of one edge.
  std::array<std::uint32_t, 2> inward;
  typename Kernel::Disk inner;
};

/// Places of a Diagram without an edge, linked by inward[0].
struct FreePlaces {
  std::uint32_t first = none;
  std::uint32_t last = none;
};

/// The Voronoi diagrams of lists of elements, side by side in one array (docs/lee.md).
///
/// By Corollary 1 the foot moves monotonically along a Voronoi polygon, and disks of one diagram
/// do not cut each other. So the edges of V(e) in the order of their feet are first those shared
/// with earlier elements, going outward, then those shared with later ones, going inward: two
/// stacks with the outermost edges on top. A merge takes from their tops and adds to them, and
/// nothing else.
template <class Kernel>
struct DiagramIn {
  using ListEdge = ListEdgeIn<Kernel>;
  using Real = typename Kernel::Real;
  using Disk = typename Kernel::Disk;
  using Site = typename Kernel::Site;
  /// Of the elements' sites and the disks of their passages: their own, or those of another kernel.
  DiagramIn(const Elements& all, std::span<const Site> all_sites,
            std::span<const Disk> all_passages);

  const Elements& elements;
  std::span<const Site> sites;
  std::span<const Disk> passages;
  std::vector<ListEdge> edges;  ///< two places for each element; some are free
  /// Of each element: the outermost edge in which it is element[0], and element[1].
  std::vector<std::array<std::uint32_t, 2>> top;
  /// Of the list that begins with a chain.
  std::vector<FreePlaces> free;

  /// The elements on both sides of the place where a chain begins, and the disk there that touches
  /// both.
  struct Gate {
    std::array<std::uint32_t, 2> element;
    Disk disk;
  };
  Gate gate(std::uint32_t begin) const {
    if (!elements.is_of_bridge(begin)) return {{begin - 1, begin}, {sites[begin].point, Real{0}}};
    return {{begin - 2, begin + 1},
            passages[static_cast<std::size_t>(&elements.passage_from(begin) -
                                              elements.passages.data())]};
  }

  /// Whether the edge separates a reflex vertex from its own edge, or two edges that join smoothly.
  /// At a bridge there is no such edge: elements lie in between.
  bool is_spoke(const ListEdge& edge) const {
    if (elements.have_arcs())
      return elements.beside(edge.element[0], edge.element[1]) == Beside::smooth;
    return edge.element[1] - edge.element[0] == 1 &&
           (elements.is_vertex(edge.element[0]) || elements.is_vertex(edge.element[1]));
  }

 private:
  void add_free_place(FreePlaces& places);
};

using ListEdge = ListEdgeIn<InDouble>;
using Diagram = DiagramIn<InDouble>;

}  // namespace medial::lee
