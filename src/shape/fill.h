#pragma once

#include <span>
#include <vector>

#include "medial/planar_graph.h"
#include "medial/shape.h"
#include "shape/clean.h"

namespace medial {

/// A planar graph with the weight of each edge.
struct WeightedGraph {
  PlanarGraph graph;
  std::vector<EdgeWeight> weights;
};

/// build_planar_graph() for crossing chains. Keeps one of several coincident edges, with the sum of
/// their weights. `weights` are those of each chain's edges; `reach` is as in PlanarGraphOptions.
Result<WeightedGraph> build_weighted_graph(std::span<const Chain> chains,
                                           std::span<const EdgeWeight> weights, double reach,
                                           ShapeReport& report);

/// The boundary of a filled region, as rings that neither cross nor overlap.
struct FilledRings {
  std::vector<Ring> rings;                         ///< role any
  std::vector<std::vector<VertexSource>> sources;  ///< of each ring's points
};

/// The region that rings fill by the rules of their roles, even if they cross, overlap or enclose
/// nothing: the non-zero rule for RingRole::winding, then the even-odd rule for all others, which
/// toggles it. Cuts the rings into a planar graph. From a face to its neighbour, the count changes
/// by the weight of the edge between them. Keeps the edges with a filled face on one side only.
/// Errors: those of build_planar_graph(); no_area (nothing is filled).
Result<FilledRings> fill(std::span<const Ring> rings, ShapeReport& report);

}  // namespace medial
