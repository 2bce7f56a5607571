#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "medial/diagnostics.h"
#include "medial/disk.h"
#include "medial/vec2.h"

namespace medial {

enum class SiteKind : std::uint8_t {
  segment,  ///< a straight edge of the shape, both ends included
  vertex,   ///< a reflex vertex
  arc,      ///< a circular edge, both ends included
};

/// What a maximal disk can touch. Convex vertices and smooth joints are no sites.
struct Site {
  Vec2 start;                ///< a vertex site has start == end
  Vec2 end;                  ///< the interior lies on the left of start -> end
  std::uint32_t ring = 0;    ///< ring of the input (for a segment: of its start)
  std::uint32_t vertex = 0;  ///< vertex in that ring
  SiteKind kind = SiteKind::segment;
  double bulge = 0;  ///< of an arc: tangent of a quarter of its angle, positive where it turns left
};

enum class NodeKind : std::uint8_t {
  leaf,         ///< one edge: a convex corner, radius 0, or the centre of an arc of locally largest
                ///< curvature
  site_change,  ///< two edges: the axis passes on to another site
  branching,    ///< three edges or more
};

/// In place of a site: an edge of a sampled axis that does not tell what its disks touch.
constexpr std::uint32_t no_site = 0xFFFFFFFF;

struct Node {
  Disk disk;
  std::uint32_t component = 0;  ///< of the shape, or of its exterior
  NodeKind kind = NodeKind::leaf;
};

/// A piece of the axis between two sites: the rational quadratic Bezier curve in (x, y, r) with
/// control points node[0], `control`, node[1] and weights 1, `weight`, 1. It is the exact bisector:
/// a line (two segments), a parabola (a segment and a vertex or an arc; weight 1), a line whose
/// radius is a hyperbola (two vertices; weight >= 1), or with an arc an ellipse, a hyperbola, a
/// line, or a circle (concentric arcs). The weight is always positive.
struct Edge {
  std::array<std::uint32_t, 2> node;  ///< from, to
  std::array<std::uint32_t, 2> site;  ///< on the left and on the right of from -> to; or no_site
  Disk control;                       ///< the radius of a control point may be negative
  double weight = 1;
};

/// The medial axis transform: a graph of exact curves in (x, y, r).
///
/// Sampled methods say so by a `resolution` above 0. That of `potential` is the longest step along
/// the axis, about: nodes have their exact distance to the boundary as radius, edges run straight
/// and name sites that are nearest on both sides. That of methods on a grid of square pixels is the
/// side of a pixel: every node is the centre of a medial pixel (of `ridge`, where there is no room
/// for pixels, a point between), in the order of increasing x within increasing y; its radius is
/// within half a pixel's diagonal of its distance to the boundary. Every edge runs straight to one
/// of eight neighbours, its control point in the middle and its weight 1. Its sites are two that
/// the disk of its first node touches, within a few pixels, or both no_site. Which pixels are
/// linked: docs/ridge.md.
struct MedialAxis {
  std::string method;     ///< the engine's name: see name_of(Method)
  double tolerance = 0;   ///< in units of the input: what |distance - radius| stays below
  double resolution = 0;  ///< 0: exact; otherwise the step of a sampled method
  /// 0: of the interior; otherwise of the exterior, within an enclosure that is this far away
  /// from the shape's bounding box: without the edges whose disks touch it. Its sites have the
  /// exterior on their left.
  double exterior = 0;
  std::vector<Site> sites;
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  Statistics statistics;
};

}  // namespace medial
