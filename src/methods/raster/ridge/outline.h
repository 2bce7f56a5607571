#pragma once

#include <cstdint>
#include <vector>

#include "methods/problem.h"
#include "site/site.h"

namespace medial::ridge {

/// How two edges of a polygon meet, seen from the interior; Appendix A.4 of [volkmann1987].
enum class VertexType : std::uint8_t { convex, collinear, concave };

/// The type of a vertex between its neighbours, the interior on the left of the way. An angle
/// counts as straight where its sine does not exceed `straight`; the report takes the sine of 5
/// degrees.
VertexType vertex_type(Vec2 before, Vec2 vertex, Vec2 after, double straight);

/// The shape's boundary as edges in the local frame (the report's segment list, A.1.h): runs of
/// nearly straight edges as one, arcs in pieces that stay within a 16th of a pixel of their chords.
/// Distances to arcs are exact; only the boundary map takes the chords.
///
/// The edges of a loop follow each other. Those between two corners form a chain; in a chain the
/// boundary turns right, or left along a curve. A loop without a corner is one closed chain.
struct EdgeOutline {
  std::vector<site::Site> edges;
  std::vector<std::uint32_t> site;       ///< of each edge: the number in the result
  std::vector<std::uint32_t> component;  ///< of each edge: of the shape
  std::vector<VertexType> type;          ///< at the start of each edge
  std::vector<std::uint32_t> next;       ///< the edge that follows
  /// Of each edge: the radius of the circle whose inside it approximates; infinite for straight
  /// edges and for those on the outside of a circle (Section V.B.1).
  std::vector<double> radius;

  /// Whether two edges meet at a concave vertex: then the foot on both is that vertex (Fig. 16,
  /// A.8).
  bool meet_concavely(std::uint32_t e, std::uint32_t f) const;
  /// An edge, and a point near to it: they tell where it is touched.
  struct Touch {
    std::uint32_t edge;
    Vec2 center;
  };
  /// Whether no disk of this radius whose centre is near to both can touch these edges as two
  /// different places of the boundary: lie_on_one_curve(), or both feet are one vertex, as where
  /// rings touch.
  bool are_one(const Touch& a, const Touch& b, double disk) const;
  /// Whether between them the boundary turns right only, by at most half a turn, as a convex
  /// obstacle does; or left along a curve whose radius of curvature is larger than the disk's by
  /// half a pixel's diagonal and a little (Section V.B.1). An edge that is touched in the vertex
  /// between them is no part of that curve.
  ///
  /// By Schur's comparison theorem, a curve that leaves a disk's circle at a tangent, curves less
  /// than it and turns by less than half of it does not come back to it.
  bool lie_on_one_curve(const Touch& a, const Touch& b, double disk) const;
  bool touch_one_vertex(const Touch& a, const Touch& b) const;
  /// The edge that a disk around the center touches. Where rings touch in a vertex, all edges there
  /// are equally far: it is one of the two between which the center lies.
  std::uint32_t seen_edge(const Touch& touch) const;

  /// Of each edge: an edge that arrives where it starts, the one before it unless rings touch
  /// there; then those that leave and arrive form a ring. Empty where no rings touch.
  std::vector<std::uint32_t> arriving;
  std::vector<std::uint32_t> chain_begin;  ///< of each chain: its first edge
  std::vector<std::uint32_t> chain;        ///< of each edge
  /// How far the chain has turned to the left before each edge and at its end; and to the right.
  std::vector<double> left, left_end, right, right_end;
  std::vector<std::uint32_t> closed;  ///< of each chain: its number of edges if closed, or 0
  /// Of each chain: how far it has turned at its end; and, closed, then turns to its beginning.
  std::vector<double> all_left, all_right, closing_left, closing_right;
  /// least_radius[k][i]: the smallest radius of edges i..i + 2^k - 1; empty where all are straight.
  std::vector<std::vector<double>> least_radius;
  double sagitta = 0;  ///< how far edges may lie outside the boxes of their ends; 0: all straight
  /// Half a pixel's diagonal, so that some pixel is not nearer to a circle than its centre; and how
  /// far chords depart from arcs.
  double margin = 0;
};

/// The outline for pixels of side `step` (local). `collinear` in degrees: vertices that turn by
/// less are dropped where the combined edge stays within a quarter of a pixel of all it replaces; 0
/// keeps all. O(edges).
EdgeOutline outline_of(const Problem& problem, double step);

}  // namespace medial::ridge
