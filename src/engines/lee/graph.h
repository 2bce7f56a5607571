#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "axis/sites.h"
#include "base/frame.h"
#include "engines/lee/diagram.h"
#include "medial/axis.h"
#include "medial/voronoi.h"

namespace medial::lee {

/// A finished diagram as a graph, in the local frame. Edges are in the order of their first
/// elements, and in the order of the feet on each.
struct Graph {
  struct Edge {
    std::uint32_t from = 0;  ///< the inner end
    std::uint32_t to = 0;
    std::array<std::uint32_t, 2> element;
    bool spoke = false;
  };
  std::vector<Disk> nodes;
  /// Of each Voronoi point: the elements whose polygons meet there. Of a corner, its two segments.
  /// For join_ties() only.
  std::vector<std::array<std::uint32_t, 3>> touched;
  std::vector<std::uint32_t> component;  ///< of each node
  std::vector<Edge> edges;
};

/// `last_edges`: what conquer() returned. Throws std::runtime_error where the diagram is not one of
/// a whole polygon: every loop of N elements must have 2 N - 3 edges (Lemma 3), of which only the
/// terminating bisector ends in a corner.
Graph graph_of(const Diagram& diagram, const std::vector<std::uint32_t>& last_edges);

/// The result in units of the input: all of the graph, with faces.
void complete(const Graph& graph, const Elements& elements, const Frame& frame,
              VoronoiDiagram& diagram);

/// The medial axis: the graph less its spokes (Corollary 3). Edges without length, of cocircular
/// elements, become one node: ends whose disks agree within `tolerance`.
void complete(const Graph& graph, const Elements& elements, const Frame& frame, double tolerance,
              MedialAxis& axis);

}  // namespace medial::lee
