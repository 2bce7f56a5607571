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

/// What lies around a planar graph, within an enclosure, as the boundary that an engine walks
/// along: one component for each face; the first, unbounded one has the enclosure as
/// its outer loop.
///
/// build_shape() would not make this shape: an edge can be in it twice, once for each side, a
/// segment by itself is a loop of two points, and a lone point a loop of one. The source of a point
/// is {point of the planar graph, half-edge that begins there}, with no_index for what is missing,
/// and for both at the enclosure. Loops come in spatial order. Requires an enclosure around the
/// planar graph.
Shape around(const PlanarGraph& planar_graph, const Box& enclosure);

}  // namespace medial
