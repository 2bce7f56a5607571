#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "medial/axis.h"
#include "medial/compute.h"
#include "medial/error.h"
#include "medial/shape.h"

namespace medial {

/// A Voronoi edge with its exact curve, as in MedialAxis. From node[0] to node[1], the part of the
/// boundary that the edge's disks cut off grows.
struct VoronoiEdge : Edge {
  /// Separates a reflex vertex from a segment that ends there: straight, perpendicular to the
  /// segment, from the vertex inward. All other edges are the medial axis (Lee, Corollary 3).
  bool spoke = false;
};

/// The Voronoi diagram of a polygon inside of it: of its segments and its reflex vertices, a face
/// for each (Lee, Definition 6). Cocircular elements give edges without length, so that every
/// loop with n segments and m reflex vertices has 2 (n + m) - 3 edges (Lemma 3). Nodes are the
/// n + m - 2 Voronoi points of each loop, its corners, where the edges of two segments begin, and
/// its reflex vertices, where two spokes begin.
struct VoronoiDiagram {
  std::string method;
  double tolerance = 0;
  std::vector<Site> sites;
  std::vector<Node> nodes;
  std::vector<VoronoiEdge> edges;
  /// Of each site: the range of its face's edges in `face_edges`, one entry more at the end. In the
  /// order of the feet: forward along a segment, and clockwise around a reflex vertex.
  std::vector<std::uint32_t> face_begin;
  std::vector<std::uint32_t> face_edges;
  Statistics statistics;

  std::span<const std::uint32_t> face(std::size_t site) const {
    return std::span(face_edges).subspan(face_begin[site], face_begin[site + 1] - face_begin[site]);
  }
};

/// The Voronoi diagram of a shape of straight edges without holes, by Lee's divide and conquer.
/// O(n log n). Errors: as compute() with Method::lee.
Result<VoronoiDiagram> voronoi_diagram(const Shape& shape, const Options& options = {});

}  // namespace medial
