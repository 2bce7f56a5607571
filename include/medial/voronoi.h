#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "medial/axis.h"
#include "medial/compute.h"
#include "medial/error.h"
#include "medial/planar_graph.h"
#include "medial/shape.h"

namespace medial {

/// A Voronoi edge with its exact curve, as in MedialAxis. From node[0] to node[1], the part of the
/// boundary that the edge's disks cut off grows.
struct VoronoiEdge : Edge {
  /// Separates sites that have a point in common, from that point on: straight, perpendicular to an
  /// edge. All other edges are the medial axis (Lee, Corollary 3).
  bool spoke = false;
  /// Lies on the frame, which it goes around counter-clockwise; site[1] is no_site. Its radius is
  /// the distance from its site.
  bool frame = false;
};

/// A Voronoi diagram, of a polygon inside of it, or of a planar graph within a frame.
///
/// Of a polygon: of its segments and its reflex vertices, a face for each (Lee, Definition 6).
/// Cocircular elements give edges without length, so that every loop with n segments and m reflex
/// vertices has 2 (n + m) - 3 edges (Lemma 3). Nodes are the n + m - 2 Voronoi points of each loop,
/// its corners, where the edges of two segments begin, and its reflex vertices, where two spokes
/// begin.
///
/// Of a planar graph: sites are its points, in their order, then its edges without their ends. A
/// point's face can be empty: where the edges around it leave no place that is nearest to it. The
/// nodes of radius 0 are points that edges begin at. Edges that begin in one corner of the frame's
/// and end in another lie on it.
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

/// The Voronoi diagram of a shape of straight edges without holes, by Lee's divide and conquer.
/// O(n log n). Errors: as compute() with Method::lee.
Result<VoronoiDiagram> voronoi_diagram(const Shape& shape, const Options& options = {});

/// The Voronoi diagram of a planar graph within a frame, by the engine `disks` (docs/voronoi.md):
/// of its points, segments and arcs. Of the options tolerance, threads, progress and cancel count,
/// and margin where no frame is given: how far the frame is away from the planar graph's bounding
/// box, 0 for half of its longer side. Inside of the frame the diagram is that of the whole plane.
/// O(n log n) expected. Errors: invalid_option (also a frame that the planar graph touches or
/// leaves), cancelled, empty, too_large, unsupported (coordinates, as in compute(); among edges, a
/// point that is nearer to another one or to an edge than rounding tells apart, 64 tolerances, with
/// its place: see PlanarGraphOptions::reach), out_of_memory, internal.
Result<VoronoiDiagram> voronoi_diagram(const PlanarGraph& planar_graph, const Options& options = {},
                                       const std::optional<Box>& frame = {});

/// The curve of an edge from its node[0] to its node[1], sampled as sample_by_chord() does.
std::vector<Disk> sample_by_chord(const VoronoiDiagram& diagram, const VoronoiEdge& edge,
                                  double chord);

/// The outline of a planar graph's face as a polygon, counter-clockwise, its edges sampled so that
/// chords stay within `chord` of them; empty where the face is.
std::vector<Vec2> face_outline(const VoronoiDiagram& diagram, std::size_t site, double chord);

/// The sites of a planar graph's diagram without the diagram, for a SiteLocator. O(n).
std::vector<Site> sites_of(const PlanarGraph& planar_graph);

/// A nearest site.
struct NearestSite {
  std::uint32_t site = no_site;
  Vec2 foot;  ///< its nearest point
  double distance = 0;
};

/// Answers "which site is nearest to p" in O(log n) expected, after O(n log n). Keeps a copy of
/// what it needs.
class SiteLocator {
 public:
  explicit SiteLocator(std::span<const Site> sites);
  ~SiteLocator();
  SiteLocator(SiteLocator&&) noexcept;
  /// Of sites at equal distance the lowest index, which of a planar graph is a point where there is
  /// one. Without sites: no_site at infinite distance.
  NearestSite nearest(Vec2 p) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace medial
