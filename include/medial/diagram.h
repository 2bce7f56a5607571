#pragma once

#include <optional>
#include <span>

#include "medial/axis.h"

namespace medial {

/// From node[0] to node[1], the part of the boundary that the edge's disks cut off grows.
struct VoronoiEdge : Edge {
  /// Straight, from the common point of its two sites, perpendicular to an edge. All other edges
  /// are the medial axis (Lee, Corollary 3).
  bool spoke = false;
  /// On the enclosure, counter-clockwise; site[1] is no_site, radii are distances from site[0].
  bool frame = false;
};

/// A Voronoi diagram, of a polygon inside of it, or of a planar graph within an enclosure.
///
/// Of a polygon: a face for each segment and each reflex vertex (Lee, Definition 6). Cocircular
/// elements give edges of zero length, so that every loop with n segments and m reflex vertices has
/// 2 (n + m) - 3 edges (Lemma 3). Nodes are the n + m - 2 Voronoi points of each loop, its corners,
/// where the edges of two segments begin, and its reflex vertices, where two spokes begin.
///
/// Of a planar graph: sites are its points, in their order, then its edges without their ends. A
/// point's face is empty where the edges around it leave no place nearest to it. Nodes of radius 0
/// are points at which edges begin. Edges from one corner of the enclosure to another lie on it.
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
  std::optional<Box> frame = {};  ///< the enclosure of a planar graph's diagram
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
