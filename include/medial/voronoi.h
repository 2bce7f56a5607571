#pragma once

#include "medial/compute.h"
#include "medial/planar_graph.h"

namespace medial {

/// The Voronoi diagram of a shape of straight edges, by Lee's divide and conquer, or what double
/// leaves open from the axis of `disks`. O(n log n). Errors: those of compute().
Result<VoronoiDiagram> voronoi_diagram(const Shape& shape, const Options& options = {});

/// The Voronoi diagram of a planar graph's points, segments and arcs, by the engine `disks`
/// (docs/voronoi.md): that of the whole plane, clipped to `enclosure`, by default the box
/// Options::margin around the graph. Also uses tolerance, threads, progress and cancel. O(n log n)
/// expected. Errors: those of compute(); invalid_option (the graph touches or leaves the
/// enclosure), unsupported (points too near to tell apart: PlanarGraphOptions::reach).
Result<VoronoiDiagram> voronoi_diagram(const PlanarGraph& planar_graph, const Options& options = {},
                                       const std::optional<Box>& enclosure = {});

/// The sites of a planar graph's diagram, for a SiteLocator. O(n).
std::vector<Site> sites_of(const PlanarGraph& planar_graph);

struct NearestSite {
  std::uint32_t site = no_site;
  Vec2 foot;  ///< the site's nearest point
  double distance = 0;
};
/// Finds the nearest site in O(log n) expected, after O(n log n). Keeps a copy of what it needs.
class SiteLocator {
 public:
  explicit SiteLocator(std::span<const Site> sites);
  /// The lowest site if several are equally near: in a planar graph, a point rather than its edges.
  /// Without sites: no_site at infinite distance.
  NearestSite nearest(Vec2 p) const;

 private:
  struct Index;
  std::shared_ptr<const Index> index_;
};

}  // namespace medial
