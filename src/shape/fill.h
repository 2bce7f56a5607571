#pragma once

#include <span>
#include <vector>

#include "medial/planar_graph.h"
#include "medial/shape.h"
#include "shape/clean.h"

namespace medial {

/// A planar graph, and what each of its edges counts.
struct WeightedGraph {
  PlanarGraph graph;
  std::vector<EdgeWeight> weights;
};

/// build_planar_graph() of crossing chains: of edges that lie on each other one stays, with the sum
/// of their weights. `weights` are those of each chain's edges; `reach` as in PlanarGraphOptions.
Result<WeightedGraph> build_weighted_graph(std::span<const Chain> chains,
                                           std::span<const EdgeWeight> weights, double reach,
                                           ShapeReport& report);

/// The boundary of what rings fill, as rings that neither cross nor overlap.
struct FilledRings {
  std::vector<Ring> rings;                         ///< role any
  std::vector<std::vector<VertexSource>> sources;  ///< of each ring's points
};

/// What the rings fill by the rules of their roles, whether they cross, overlap or enclose nothing:
/// the non-zero rule for RingRole::winding, the even-odd rule changing that for all others. The
/// rings are cut into a planar graph; from a face to its neighbour the count changes by the weight
/// of the edge between them, and edges with a filled face on one side only stay. Errors: those of
/// build_planar_graph(); no_area, if nothing is filled.
Result<FilledRings> fill(std::span<const Ring> rings, ShapeReport& report);

}  // namespace medial
