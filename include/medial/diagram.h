#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "medial/axis.h"
#include "medial/box.h"

namespace medial {

/// A Voronoi edge with its exact curve, as in MedialAxis. From node[0] to node[1], the part of the
/// boundary that the edge's disks cut off grows.
struct VoronoiEdge : Edge {
  /// Separates sites that have a point in common, from that point on: straight, perpendicular to an
  /// edge. All other edges are the medial axis (Lee, Corollary 3).
  bool spoke = false;
  /// Lies on the enclosure, which it goes around counter-clockwise; site[1] is no_site. Its radius
  /// is the distance from its site.
  bool frame = false;
};

/// A Voronoi diagram, of a polygon inside of it, or of a planar graph within an enclosure.
///
/// Of a polygon: of its segments and its reflex vertices, a face for each (Lee, Definition 6).
/// Cocircular elements give edges without length, so that every loop with n segments and m reflex
/// vertices has 2 (n + m) - 3 edges (Lemma 3). Nodes are the n + m - 2 Voronoi points of each loop,
/// its corners, where the edges of two segments begin, and its reflex vertices, where two spokes
/// begin.
///
/// Of a planar graph: sites are its points, in their order, then its edges without their ends. A
/// point's face can be empty: where the edges around it leave no place that is nearest to it. The
/// nodes of radius 0 are points that edges begin at. Edges that begin in one corner of the
/// enclosure's and end in another lie on it.
struct VoronoiDiagram {
  std::string method;
  double tolerance = 0;
  std::vector<Site> sites;
  std::vector<Node> nodes;
  std::vector<VoronoiEdge> edges;
  /// Of each site: the range of its face's edges in `face_edges`, one entry more at the end. In the
  /// order of the feet: forward along a segment, and clockwise around a reflex vertex. In a planar
  /// graph that is once around the face, clockwise: forward along an edge's left side, then
  /// backward along its right one.
  std::vector<std::uint32_t> face_begin;
  std::vector<std::uint32_t> face_edges;
  /// Of a planar graph's diagram, what it was cut off at.
  std::optional<Box> frame = {};
  Statistics statistics;

  std::span<const std::uint32_t> face(std::size_t site) const {
    return std::span(face_edges).subspan(face_begin[site], face_begin[site + 1] - face_begin[site]);
  }
};

/// The curve of an edge from its node[0] to its node[1], sampled as sample_by_chord() does.
std::vector<Disk> sample_by_chord(const VoronoiDiagram& diagram, const VoronoiEdge& edge,
                                  double chord);

/// The outline of a planar graph's face as a polygon, counter-clockwise, its edges sampled so that
/// chords stay within `chord` of them; empty where the face is.
std::vector<Vec2> face_outline(const VoronoiDiagram& diagram, std::size_t site, double chord);

}  // namespace medial
