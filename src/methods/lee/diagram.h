#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "medial/axis.h"
#include "methods/lee/elements.h"
#include "site/site.h"

namespace medial::lee {

/// Whether two disks are equal bit for bit, as those of a joined tie are.
inline bool is_same(const Disk& a, const Disk& b) {
  return a.center == b.center && a.radius == b.radius;
}

/// The distance by which the foot on a site moves forward from one disk to another, measured at the
/// centres along the site's normals; for an arc, at the centre nearer to the arc's own, which has
/// no foot.
/// the site's normals, and of an arc from the centre nearer to its own, in which there is no foot.
inline double advance(const site::Site& site, Vec2 from, Vec2 to) {
  if (!site.is_arc()) return dot(site.direction, to - from);
  const Vec2 d = from - site.point, e = to - site.point, normal = site.normal();
  const double way = dot(site.direction, e - d) + site.curvature * cross(d, e);
  const double larger = std::max(squared_norm(normal - site.curvature * d),
                                 squared_norm(normal - site.curvature * e));
  const double most = distance(from, to);
  return larger > 0 ? std::clamp(way / std::sqrt(larger), -most, most) : 0;
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

/// The free places of a Diagram, linked by inward[0].
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
struct Diagram {
  explicit Diagram(const Elements& all);

  const Elements& elements;
  std::vector<ListEdge> edges;  ///< two places per element; some are free
  /// The outermost edges of each element: the one in which it is element[0], and that in which it
  /// is element[1].
  std::vector<std::array<std::uint32_t, 2>> top;
  /// of the list that begins with a chain
  std::vector<FreePlaces> free;

  /// The elements on both sides of the point where a chain begins, and the disk there that touches
  /// both.
  struct Gate {
    std::array<std::uint32_t, 2> element;
    Disk disk;
  };
  Gate gate(std::uint32_t begin) const {
    if (!elements.is_of_bridge(begin))
      return {{begin - 1, begin}, {elements.sites[begin].point, 0}};
    const auto passage = &elements.passage_from(begin) - elements.passages.data();
    return {{begin - 2, begin + 1}, elements.disks_of_passages[static_cast<std::size_t>(passage)]};
  }

  /// Whether the edge separates a reflex vertex from its own edge, or two edges that join smoothly.
  /// A bridge has no such edge: elements are in between.
  bool is_spoke(const ListEdge& edge) const {
    if (elements.have_arcs())
      return elements.beside(edge.element[0], edge.element[1]) == Beside::smooth;
    return edge.element[1] - edge.element[0] == 1 &&
           (elements.is_vertex(edge.element[0]) || elements.is_vertex(edge.element[1]));
  }

 private:
  void add_free_place(FreePlaces& places);
};

}  // namespace medial::lee
