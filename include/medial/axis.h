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
  Vec2 start, end;                     ///< interior on the left; equal for a vertex
  std::uint32_t ring = 0, vertex = 0;  ///< where `start` is in the input
  double bulge = 0;                    ///< of an arc: see Ring

  SiteKind kind() const {
    return bulge != 0 ? SiteKind::arc : start == end ? SiteKind::vertex : SiteKind::segment;
  }
};

enum class NodeKind : std::uint8_t {
  leaf,         ///< one edge: a corner (radius 0) or centre of an arc of locally largest curvature
  site_change,  ///< two edges: the axis passes to another site
  branching,    ///< three edges or more
};

/// Stands for a missing site, where a sampled axis does not record what its disks touch.
constexpr std::uint32_t no_site = 0xFFFFFFFF;

struct Node {
  Disk disk;
  std::uint32_t component = 0;  ///< of the shape, or of its exterior
  NodeKind kind = NodeKind::leaf;
};

/// A piece of the axis: the centres of the maximal disks that touch its two sites. In (x, y, r) it
/// is the rational quadratic Bezier curve with control points node[0], `control`, node[1] and
/// weights 1, `weight`, 1. The centres lie on a line (two segments, or two vertices), a parabola (a
/// segment and a vertex), or, if a site is an arc, on a conic, which may be a line or a circle.
struct Edge {
  std::array<std::uint32_t, 2> node;  ///< from, to
  std::array<std::uint32_t, 2> site;  ///< to the left and right of from -> to; or no_site
  Disk control;                       ///< its radius may be negative
  double weight = 1;                  ///< positive
};

/// The medial axis transform: a graph of exact curves in (x, y, r).
///
/// A sampled axis has a `resolution` above 0. For points, it is about the longest step along the
/// axis; each node's radius is its exact distance to the boundary, and straight edges name the
/// nearest site on each side. For pixels, it is the side of a pixel. Nodes, ordered by y, then x,
/// are centres of medial pixels (for `ridge` also points between pixels); their radii are within
/// half a pixel's diagonal of the distance to the boundary. Straight edges join neighbours (of
/// eight); their sites are two that the first node's disk all but touches, or both no_site.
struct MedialAxis {
  std::string method;     ///< the engine's name: see name_of(Method)
  double tolerance = 0;   ///< bound of |distance - radius|, in units of the input
  double resolution = 0;  ///< 0 if exact, else the step of a sampled method
  /// 0 for the interior. For the exterior, the margin of the enclosure around the bounding box;
  /// edges whose disks touch the enclosure are left out, and sites have the exterior on the left.
  double exterior = 0;
  std::vector<Site> sites;
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  Statistics statistics;
};

/// From node[0] to node[1], the edge's disks cut off a growing part of the boundary.
struct VoronoiEdge : Edge {
  /// A straight edge from its sites' common point. Others are the medial axis (Lee, Cor. 3).
  bool spoke = false;
  /// On the enclosure, counter-clockwise; site[1] is no_site; radii are distances to site[0].
  bool on_enclosure = false;
};

/// The Voronoi diagram inside a polygon, or of a planar graph within an enclosure.
///
/// A polygon of n segments and m reflex vertices has a face for each of these, and 2 (n + m) - 3
/// edges, including those of length 0 between cocircular elements (Lee, Lemma 3).
///
/// The sites of a planar graph are its points, in order, then its edges without their ends. A
/// point's face is empty if every place is at least as near to its edges.
struct VoronoiDiagram {
  std::string method;
  double tolerance = 0;
  std::vector<Site> sites;
  std::vector<Node> nodes;
  std::vector<VoronoiEdge> edges;
  /// The face of site i is face_edges [face_begin[i], face_begin[i + 1]), ordered by foot points:
  /// forward along a segment, clockwise around a reflex vertex. In a planar graph this goes once
  /// clockwise around the face: forward along an edge's left side, then back along its right side.
  std::vector<std::uint32_t> face_begin;
  std::vector<std::uint32_t> face_edges;
  std::optional<Box> enclosure = {};  ///< of a planar graph's diagram
  Statistics statistics;

  std::span<const std::uint32_t> face(std::size_t site) const {
    return std::span(face_edges).subspan(face_begin[site], face_begin[site + 1] - face_begin[site]);
  }
};

/// Samples an edge from node[0] to node[1], like sample_by_chord() for an axis.
std::vector<Disk> sample_by_chord(const VoronoiDiagram& diagram, const VoronoiEdge& edge,
                                  double chord);

/// A planar graph's face as a counter-clockwise polygon within `chord` of it; empty if it is.
std::vector<Vec2> face_outline(const VoronoiDiagram& diagram, std::size_t site, double chord);

}  // namespace medial
