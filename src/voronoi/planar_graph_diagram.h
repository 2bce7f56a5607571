#pragma once

#include <vector>

#include "axis/sites.h"
#include "medial/axis.h"
#include "medial/planar_graph.h"
#include "medial/shape.h"

namespace medial::voronoi {

/// The enclosure for the engine, for a diagram that is cut off at `enclosure`: so far away that no
/// place inside `enclosure` is nearer to it than to the planar graph.
Box far_enclosure(const Box& enclosure);

/// A site of the diagram: a point of the planar graph, or after all of them an edge.
Site site_of_planar_graph(const PlanarGraph& planar_graph, std::uint32_t site);

/// Sets the kind of each node by its number of edges.
void set_kinds(VoronoiDiagram& diagram);

/// The Voronoi diagram of a planar graph within `enclosure`, from the axis of the region around it
/// in a farther enclosure: the axis with its spokes, in faces by site, cut off. The axis numbers
/// its sites like axis_around(), and its edges are stored separately. `shape` is around(planar
/// graph, far_enclosure(enclosure)). Error: internal (because of rounding, a face does not close).
/// O(n) expected.
Result<VoronoiDiagram> diagram_of(const PlanarGraph& planar_graph, const Shape& shape,
                                  const site::SiteNumbers& numbers, MedialAxis axis,
                                  std::vector<VoronoiEdge> edges, const Box& enclosure);

}  // namespace medial::voronoi
