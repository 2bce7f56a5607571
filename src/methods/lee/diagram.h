#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "medial/axis.h"
#include "methods/lee/elements.h"

namespace medial::lee {

constexpr std::uint32_t none = ~std::uint32_t{0};

/// Bit for bit: a tie that has been joined.
inline bool is_same(const Disk& a, const Disk& b) {
  return a.center == b.center && a.radius == b.radius;
}

/// A Voronoi edge B(e_i, e_j), i < j: the disks that touch both. Such a disk cuts off the boundary
/// between its two feet. Along the edge from its inner to its outer end this part grows: the foot
/// on e_i moves backward, the one on e_j forward.
struct ListEdge {
  std::array<std::uint32_t, 2> element;  ///< i < j
  /// The next edge inward in the two stacks that hold this one, see Diagram: those that end where
  /// this one begins. Each Voronoi point is the inner end of one edge.
  std::array<std::uint32_t, 2> inward;
  Disk inner;
};

/// The Voronoi diagrams of lists of elements, side by side in one array (docs/lee.md).
///
/// By Corollary 1 the foot moves monotonically along a Voronoi polygon, and disks of one diagram
/// do not cut each other. So the edges of V(e) in the order of their feet are first those shared
/// with earlier elements, going outward, then those shared with later ones, going inward: two
/// stacks with the outermost edges on top. A merge takes from their tops and adds to them, and
/// nothing else.
struct Diagram {
  explicit Diagram(const Elements& all);

  const Elements& elements;
  std::vector<ListEdge> edges;  ///< two places for each element; some are free
  /// Of each element: the outermost edge in which it is element[0], and element[1].
  std::vector<std::array<std::uint32_t, 2>> top;
  /// Of the list that begins with a chain: free places, linked by inward[0].
  struct FreePlaces {
    std::uint32_t first = none;
    std::uint32_t last = none;
  };
  std::vector<FreePlaces> free;

  /// Whether the edge separates a reflex vertex from its own segment.
  bool is_spoke(const ListEdge& edge) const {
    return edge.element[1] - edge.element[0] == 1 &&
           (elements.is_vertex(edge.element[0]) || elements.is_vertex(edge.element[1]));
  }
};

}  // namespace medial::lee
