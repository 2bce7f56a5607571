#pragma once

#include <span>
#include <vector>

#include "medial/error.h"

namespace medial {

/// What the source states about a ring.
enum class RingRole : std::uint8_t {
  any,      ///< nothing: the even-odd rule applies (plain text, loose loops)
  outer,    ///< the outer ring of a polygon
  hole,     ///< a hole of a polygon
  winding,  ///< nothing: the non-zero rule applies, with the rings' orientations
};

/// A ring as a file gives it: of any orientation, closed or not, cleaned or not.
///
/// Edge i goes from points[i] to the next point. Its bulge is the tangent of a quarter of the angle
/// that it spans: 0 is straight, 1 a half circle, positive values turn left.
struct Ring {
  std::vector<Vec2> points;
  RingRole role = RingRole::any;
  std::vector<double> bulges = {};  ///< of each edge; empty: all edges are straight
};

/// Where a vertex of a Shape comes from: ring and vertex of the input, from 0.
struct VertexSource {
  std::uint32_t ring = 0, vertex = 0;
};

/// Counts from building a shape, or a planar graph from chains.
struct ShapeReport {
  std::uint64_t input_rings = 0, input_points = 0;
  /// Last points equal to the first, dropped; and rings without such a point.
  std::uint64_t closing_points = 0, unclosed_rings = 0;
  std::uint64_t repeated_points = 0;    ///< zero-length edges, dropped; points on other pieces
  std::uint64_t repeated_edges = 0;     ///< of a planar graph: edges that repeat another, dropped
  std::uint64_t collinear_points = 0;   ///< vertices inside a straight run or arc, dropped
  std::uint64_t reversed_rings = 0;     ///< rings that had the interior on the right
  std::uint64_t dropped_rings = 0;      ///< rings inside others by the non-zero rule
  std::uint64_t touching_vertices = 0;  ///< where rings or chains touch, in vertices or edges
  std::uint64_t split_edges = 0;        ///< edges split where a vertex touches their inside
  std::uint64_t crossings = 0;          ///< places where edges crossed (ShapeOptions)
};

struct ShapeOptions {
  /// Splits edges where they cross or overlap, and ignores rings that enclose nothing; RingRole
  /// then decides what is inside. Works within the tolerance even if all edges are straight. O(n
  /// log n + p) for p pairs of edges whose bounding boxes meet.
  bool node_crossings = false;
};

/// A bounded planar region: closed loops of straight and circular edges with the interior on the
/// left (outer loops counter-clockwise, holes clockwise).
///
/// build_shape() guarantees: all coordinates are finite; a loop has at least three vertices, with
/// arcs at least two; no bulge exceeds 1; neighbouring vertices differ and no three in a row are
/// collinear, except where loops touch; edges meet in vertices only. Each component is one outer
/// loop and its holes, with a connected interior. Its loops are disjoint, but a loop may pass
/// through a vertex several times, once per wedge of interior. Two components may share vertices.
struct Shape {
  std::vector<Vec2> points;               ///< the vertices of all loops, loop after loop
  std::vector<double> bulges;             ///< of the edge after each point; empty: all straight
  std::vector<VertexSource> sources;      ///< of each point
  std::vector<std::uint32_t> loop_begin;  ///< loop i is points [loop_begin[i], loop_begin[i + 1])
  std::vector<std::uint32_t> component;   ///< of each loop; components count from 0
  std::vector<bool> hole;                 ///< of each loop

  std::size_t loop_count() const { return component.size(); }
  double bulge(std::size_t point) const { return bulges.empty() ? 0 : bulges[point]; }
  std::span<const Vec2> loop(std::size_t i) const {
    return std::span(points).subspan(loop_begin[i], loop_begin[i + 1] - loop_begin[i]);
  }
  std::size_t component_count() const;
  std::size_t hole_count() const;
};

/// One loop of a shape, or all, as rings.
Ring ring_of(const Shape& shape, std::size_t loop);
std::vector<Ring> rings_of(const Shape& shape);
/// The bounding box, arcs included; and the area, without that of holes. O(n).
Box bounding_box(const Shape& shape);
double area(const Shape& shape);

/// Cleans, checks, orients and nests rings into a Shape. O(n log n).
///
/// Closes rings, and drops repeated points and vertices inside straight runs or arcs of one circle.
/// Rings may touch in vertices, or with a vertex inside an edge, and come in any order. Splits arcs
/// of more than a half circle, and straightens arcs with a sagitta below rounding.
///
/// Without arcs, every decision is exact for the given coordinates. With arcs, edges and vertices
/// within the tolerance (4e-15 of the diagonal, or two spacings of the largest coordinate) touch:
/// vertices merge, and edges are split there and where tangent circles touch inside both. Errors
/// with ring, vertex and point: not_finite, too_few_points, no_area, crossing, overlap, unsupported
/// (arcs below 1,024 tolerances); hole_outside, nested_outer, empty, too_large, out_of_memory.
Result<Shape> build_shape(std::span<const Ring> rings, const ShapeOptions& options = {},
                          ShapeReport* report = nullptr);

/// The exterior of a shape: a rectangular enclosure at distance `margin` from the bounding box (0:
/// half of its longer side) minus the shape. The enclosure's vertices have source ring 0. Errors:
/// invalid_option (a margin outside [1e-6, 1e6] diagonals, or rounding), those of build_shape().
Result<Shape> surroundings(const Shape& shape, double margin = 0);

}  // namespace medial
