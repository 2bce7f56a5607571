#pragma once

#include "medial/axis.h"
#include "medial/compute.h"
#include "medial/planar_graph.h"
#include "medial/shape.h"

namespace medial::voronoi {

/// The Voronoi diagram of a planar graph without edges within `enclosure`, as the dual of its
/// Delaunay triangulation. Which edges there are is exact; nodes closer together than the tolerance
/// are one. Centres are off by a few roundings of their distance from their sites, and of their own
/// coordinates. O(n log n) expected, some 3 n edges. Cancelled, it is incomplete.
/// Error: internal, where rounding breaks it.
Result<VoronoiDiagram> diagram_of_points(const PlanarGraph& planar_graph, const Options& options,
                                         const Box& enclosure);

}  // namespace medial::voronoi
