#pragma once

#include "medial/axis.h"
#include "medial/compute.h"
#include "medial/planar_graph.h"
#include "medial/shape.h"

namespace medial::voronoi {

/// The Voronoi diagram of a planar graph without edges within `enclosure`, as the dual of its
/// Delaunay triangulation. The set of edges is exact; nodes closer together than the tolerance are
/// merged. The error of a centre is a few roundings of its distance from its sites and of its own
/// coordinates. O(n log n) expected; about 3 n edges. Incomplete if cancelled. Error: internal (the
/// diagram is inconsistent because of rounding).
Result<VoronoiDiagram> diagram_of_points(const PlanarGraph& planar_graph, const Options& options,
                                         const Box& enclosure);

}  // namespace medial::voronoi
