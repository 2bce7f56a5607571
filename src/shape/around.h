#pragma once

#include "medial/planar_graph.h"
#include "medial/shape.h"

namespace medial {

/// The point at which a half-edge of a planar graph begins; and its bulge.
inline std::uint32_t start_of(const PlanarGraph& graph, std::uint32_t half_edge) {
  const PlanarGraphEdge& edge = graph.edges[half_edge / 2];
  return half_edge % 2 == 0 ? edge.from : edge.to;
}
inline double bulge_of(const PlanarGraph& graph, std::uint32_t half_edge) {
  const double forward = graph.edges[half_edge / 2].bulge;
  return half_edge % 2 == 0 ? forward : 0 - forward;
}

/// The region around a planar graph within an enclosure, as the boundary for an engine: one
/// component per face. The enclosure is the outer loop of the first, unbounded one.
///
/// build_shape() cannot make this shape: an edge may occur twice, once for each side, a lone
/// segment is a loop of two points, and a lone point is a loop of one. The source of a point is
/// {point of the planar graph, half-edge that begins there}; no_index stands for a missing
/// half-edge, and for both at the enclosure. Loops are in spatial order. The enclosure must contain
/// the planar graph.
Shape around(const PlanarGraph& planar_graph, const Box& enclosure);

}  // namespace medial
