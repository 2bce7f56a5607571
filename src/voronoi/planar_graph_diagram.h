#pragma once

#include <vector>

#include "axis/sites.h"
#include "medial/axis.h"
#include "medial/planar_graph.h"
#include "medial/shape.h"

namespace medial::voronoi {

/// The enclosure that an engine walks in, for a diagram that is cut off at `enclosure`: so far away
/// that inside of `enclosure` no place is nearer to it than to the planar graph.
Box far_enclosure(const Box& enclosure);

/// A site of the diagram: a point of the planar graph, or after all of them an edge.
Site site_of_planar_graph(const PlanarGraph& planar_graph, std::uint32_t site);

/// Sets the kind of each node by its number of edges.
void set_kinds(VoronoiDiagram& diagram);

/// The Voronoi diagram of a planar graph within `enclosure`, of the axis of what lies around it in
/// a farther enclosure, whose sites are numbered so and whose edges stand apart: the axis with its
/// spokes, by the faces of the planar graph's sites, cut off. `shape` is around(planar graph,
/// far_enclosure(enclosure)). Error: internal, where rounding leaves a face that does not close.
/// O(n) expected.
Result<VoronoiDiagram> diagram_of(const PlanarGraph& planar_graph, const Shape& shape,
                                  const site::SiteNumbers& numbers, MedialAxis axis,
                                  std::vector<VoronoiEdge> edges, const Box& enclosure);

}  // namespace medial::voronoi
