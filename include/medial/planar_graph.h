#pragma once

#include "medial/shape.h"

namespace medial {

/// A loose piece of a drawing: a point, or edges end to end, straight or circular, open or closed.
struct Chain {
  std::vector<Vec2> points;
  std::vector<double> bulges = {};  ///< of the edge after each point, see Ring; empty: all straight
  bool closed = false;              ///< an edge leads from the last point to the first
};

/// A segment, or an arc of at most a half circle.
struct PlanarGraphEdge {
  std::uint32_t from = 0, to = 0;  ///< indices of points
  double bulge = 0;
  VertexSource source;  ///< chain of the input, and the vertex at which the edge begins
};

/// A point without edges.
struct LonePoint {
  std::uint32_t point = 0, face = 0;
};

/// Points, segments and arcs that meet at ends only: a plane graph.
///
/// The edges divide the plane into faces; face 0 is unbounded. Each face is bounded by loops of
/// half-edges with the face on their left. Half-edge 2 e is edge e forward, 2 e + 1 is edge e
/// backward. An edge with the same face on both sides occurs twice in its loops.
struct PlanarGraph {
  std::vector<Vec2> points;                 ///< distinct
  std::vector<VertexSource> point_sources;  ///< of each: chain and vertex of the input
  std::vector<PlanarGraphEdge> edges;
  std::vector<std::uint32_t> half_edges;  ///< of all loops, loop after loop
  std::vector<std::uint32_t> loop_begin;  ///< loop i is half_edges [loop_begin[i], loop_begin[i+1])
  std::vector<std::uint32_t> face;        ///< of each loop
  std::vector<bool> hole;                 ///< of each loop: whether it is not its face's outer loop
  std::vector<LonePoint> lone_points;
  std::uint32_t face_count = 1;

  std::size_t loop_count() const { return face.size(); }
};

struct PlanarGraphOptions {
  bool node_crossings = false;  ///< splits edges where they cross: see ShapeOptions
  /// Distance at which things touch: points merge, and edges pass through them. With arcs, at least
  /// the tolerance; without arcs, 0 stands for exact contact.
  double reach = 0;
};

/// Makes a planar graph from loose pieces: drops repeated points and edges, and splits an edge
/// where an end or a point lies inside it. As in build_shape(), decisions are exact, or within the
/// tolerance if there are arcs, and arcs are split and straightened. O(n log n). Errors:
/// not_finite, crossing, overlap, unsupported (with chain, vertex and point), empty, too_large.
Result<PlanarGraph> build_planar_graph(std::span<const Chain> chains,
                                       const PlanarGraphOptions& options = {},
                                       ShapeReport* report = nullptr);

Box bounding_box(const PlanarGraph& planar_graph);  ///< arcs included; requires a point

}  // namespace medial
