#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial/error.h"
#include "medial/shape.h"
#include "medial/vec2.h"

namespace medial {

/// A loose piece of a drawing: a point, or edges end to end, straight or circular, open or closed.
struct Chain {
  std::vector<Vec2> points;
  std::vector<double> bulges = {};  ///< of the edge after each point, see Ring; empty: all straight
  bool closed = false;              ///< an edge leads from the last point to the first
};

/// A segment or an arc of at most a half circle of a PlanarGraph.
struct PlanarGraphEdge {
  std::uint32_t from = 0;  ///< points
  std::uint32_t to = 0;
  double bulge = 0;
  VertexSource source;  ///< chain of the input, and the vertex of it that the edge is after
};

/// A point of a PlanarGraph without any edge.
struct LonePoint {
  std::uint32_t point = 0;
  std::uint32_t face = 0;
};

/// Points, segments and arcs that have nothing but ends in common: a plane graph.
///
/// Its edges divide the plane into faces; face 0 is the unbounded one. Each face is bounded by
/// loops, walks along half-edges with the face on their left: half-edge 2 e is edge e from its
/// first to its last point, 2 e + 1 the same backward. An edge that has one face on both sides
/// stands in its loops twice.
struct PlanarGraph {
  std::vector<Vec2> points;                 ///< all different
  std::vector<VertexSource> point_sources;  ///< of each: chain and vertex of the input
  std::vector<PlanarGraphEdge> edges;
  std::vector<std::uint32_t> half_edges;  ///< of all loops, loop after loop
  std::vector<std::uint32_t> loop_begin;  ///< loop i is half_edges [loop_begin[i], loop_begin[i+1])
  std::vector<std::uint32_t> face;        ///< of each loop
  std::vector<bool> hole;                 ///< of each loop: not the outer one of its face
  std::vector<LonePoint> lone_points;
  std::uint32_t face_count = 1;

  std::uint32_t start(std::uint32_t half_edge) const {
    const PlanarGraphEdge& edge = edges[half_edge / 2];
    return half_edge % 2 == 0 ? edge.from : edge.to;
  }
  double bulge(std::uint32_t half_edge) const {
    const double forward = edges[half_edge / 2].bulge;
    return half_edge % 2 == 0 ? forward : 0 - forward;
  }
  std::size_t loop_count() const { return face.size(); }
};

struct PlanarGraphOptions {
  /// Edges that cross are split where they do; see ShapeOptions.
  bool node_crossings = false;
  /// What comes within this distance touches: points become one, edges pass through them, as within
  /// the tolerance among arcs. 0: that tolerance among arcs, and exactly without.
  double reach = 0;
};

/// What build_planar_graph() found and mended.
struct PlanarGraphReport {
  std::uint64_t input_chains = 0;
  std::uint64_t input_points = 0;
  std::uint64_t repeated_points = 0;  ///< points that were there before, or lie on an end
  std::uint64_t repeated_edges = 0;   ///< edges that were there before, in either direction
  std::uint64_t touching_places = 0;  ///< points that several edges share
  std::uint64_t split_edges = 0;      ///< edges split where something touches their inside
  std::uint64_t crossings = 0;        ///< places where edges crossed (PlanarGraphOptions)
};

/// Makes a plane graph of loose pieces. O(n log n).
///
/// What is there twice is there once. Edges may meet in ends, and an end or a point may lie in the
/// inside of an edge, which is split there. Without arcs every decision is exact for the
/// coordinates given; with arcs, what comes within the tolerance touches, as in build_shape().
/// Longer arcs than half circles are split; arcs that are straight to rounding become so. Errors:
/// not_finite, crossing, overlap, unsupported (with chain, vertex and point), empty, too_large.
Result<PlanarGraph> build_planar_graph(std::span<const Chain> chains,
                                       const PlanarGraphOptions& options = {},
                                       PlanarGraphReport* report = nullptr);

/// The box around the points and arcs. Requires a point.
Box bounding_box(const PlanarGraph& planar_graph);

}  // namespace medial
