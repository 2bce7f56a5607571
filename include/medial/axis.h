#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "medial/geometry.h"
#include "medial/statistics.h"

namespace medial {

enum class SiteKind : std::uint8_t {
  segment,  ///< a straight edge of the shape, both ends included
  vertex,   ///< a reflex vertex
  arc,      ///< a circular edge, both ends included
};

/// What a maximal disk can touch.
struct Site {
  Vec2 start, end;                     ///< the interior is on their left; of a vertex equal
  std::uint32_t ring = 0, vertex = 0;  ///< of the input, of `start`
  SiteKind kind = SiteKind::segment;
  double bulge = 0;  ///< of an arc, see Ring
};

enum class NodeKind : std::uint8_t {
  leaf,         ///< one edge: a corner (radius 0) or centre of an arc of locally largest curvature
  site_change,  ///< two edges: the axis passes to another site
  branching,    ///< three edges or more
};

/// In place of a site, where a sampled axis does not record what its disks touch.
constexpr std::uint32_t no_site = 0xFFFFFFFF;

struct Node {
  Disk disk;
  std::uint32_t component = 0;  ///< of the shape, or of its exterior
  NodeKind kind = NodeKind::leaf;
};

/// A piece of the axis: the centres of the maximal disks that touch its two sites. As a curve in
/// (x, y, r) it is the rational quadratic Bezier curve with control points node[0], `control`,
/// node[1] and weights 1, `weight`, 1. Its centres lie on a line (two segments, two vertices), a
/// parabola (a segment and a vertex), or with an arc on any conic, which may be a line or a circle.
struct Edge {
  std::array<std::uint32_t, 2> node;  ///< from, to
  std::array<std::uint32_t, 2> site;  ///< on the left and on the right of from -> to; or no_site
  Disk control;                       ///< its radius may be negative
  double weight = 1;                  ///< positive
};

/// The medial axis transform: a graph of exact curves in (x, y, r).
///
/// A sampled axis has a `resolution` above 0. Of points it is about the longest step along the
/// axis: each node's radius is its exact distance to the boundary, and straight edges name the
/// nearest site on each side. Of pixels it is a pixel's side: nodes, ordered by y, then x, are
/// centres of medial pixels (of `ridge` also points between pixels), with radii within half a
/// pixel's diagonal of the distance to the boundary; edges lead straight to one of eight
/// neighbours; their sites are two that the first node's disk touches within a few pixels, or
/// both no_site.
struct MedialAxis {
  std::string method;     ///< the engine's name: see name_of(Method)
  double tolerance = 0;   ///< bound of |distance - radius|, in units of the input
  double resolution = 0;  ///< 0: exact; otherwise the step of a sampled method
  /// 0: the axis of the interior. Otherwise of the exterior, in an enclosure this far from the
  /// shape's bounding box, without edges whose disks touch it; sites have the exterior on the left.
  double exterior = 0;
  std::vector<Site> sites;
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  Statistics statistics;
};

/// From node[0] to node[1], the part of the boundary that the edge's disks cut off grows.
struct VoronoiEdge : Edge {
  /// Straight, from its sites' common point. All others are the medial axis (Lee, Corollary 3).
  bool spoke = false;
  /// On the enclosure, counter-clockwise; site[1] is no_site, radii are distances from site[0].
  bool on_enclosure = false;
};

/// A Voronoi diagram, of a polygon inside of it, or of a planar graph within an enclosure.
///
/// Of a polygon: a face for each of n segments and m reflex vertices; 2 (n + m) - 3 edges with
/// those of length 0, between cocircular elements (Lee, Lemma 3).
///
/// Of a planar graph: sites are its points, in their order, then its edges without their ends. A
/// point's face is empty where the edges around it leave no place nearest to it.
struct VoronoiDiagram {
  std::string method;
  double tolerance = 0;
  std::vector<Site> sites;
  std::vector<Node> nodes;
  std::vector<VoronoiEdge> edges;
  /// The face of site i is face_edges [face_begin[i], face_begin[i + 1]), in the order of the feet:
  /// forward along a segment, clockwise around a reflex vertex. In a planar graph that is once
  /// around the face, clockwise: forward along an edge's left side, then back along its right one.
  std::vector<std::uint32_t> face_begin;
  std::vector<std::uint32_t> face_edges;
  std::optional<Box> enclosure = {};  ///< of a planar graph's diagram
  Statistics statistics;

  std::span<const std::uint32_t> face(std::size_t site) const {
    return std::span(face_edges).subspan(face_begin[site], face_begin[site + 1] - face_begin[site]);
  }
};

/// Samples an edge from its node[0] to its node[1], as sample_by_chord() of an axis.
std::vector<Disk> sample_by_chord(const VoronoiDiagram& diagram, const VoronoiEdge& edge,
                                  double chord);

/// A planar graph's face as a counter-clockwise polygon within `chord` of it; empty where it is.
std::vector<Vec2> face_outline(const VoronoiDiagram& diagram, std::size_t site, double chord);

}  // namespace medial
