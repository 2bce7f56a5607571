#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "verify/boundary_edge.h"

namespace medial::verify_detail {

inline constexpr std::uint32_t fan_out = 4;  ///< of the tree over the pieces

/// Calls `visit` with points whose convex hull contains the edge: its ends, and for an arc also the
/// corners of the trapezoid whose other sides are tangent to it at the ends and in the middle.
template <class Visitor>
void for_each_hull_point(const BoundaryEdge& edge, const Visitor& visit) {
  visit(edge.start);
  visit(edge.end);
  if (edge.bulge == 0) return;
  const Vec2 chord = edge.chord();
  const Vec2 side = (0.25 * (1 - edge.bulge) * (1 + edge.bulge)) * chord;
  const Vec2 height = (-0.5 * edge.bulge) * left_of(chord);
  visit(edge.start + side + height);
  visit(edge.end - side + height);
}

/// Up to this number, pieces have one level of bounds, over chains along the boundary if these do
/// not overlap each other.
inline constexpr std::size_t few_pieces = 192;

/// An order of edges, or of pieces of arcs, in which each aligned run of fan_out^k of them is
/// spatially compact, for k = 1, 2, ...; some may be repeated next to themselves. O(n log n).
std::vector<std::uint32_t> order_of(const std::vector<BoundaryEdge>& pieces);

}  // namespace medial::verify_detail
