#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/memory.h"
#include "medial/axis.h"
#include "methods/disks/boundary.h"
#include "methods/disks/walk.h"
#include "site/boundary_tree.h"

namespace medial::disks {

/// An axis in the local frame, whose edges name sites of the boundary and have no curves yet.
struct Graph {
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  Statistics statistics;
  /// An edge that leads through a bridge's disk. Its ends may be one node nevertheless: around a
  /// point next to an arc.
  struct Passage {
    std::uint32_t edge = 0;
    Disk disk;
  };
  std::vector<Passage> passages;    ///< by edge; where there are arcs
  std::vector<std::uint32_t> lost;  ///< sites at which the walk lost its way
};

/// The number of edges at each node; 4 stands for more, too. O(edges).
WorkVector<std::uint8_t> degrees_of(const Graph& graph);

/// Joins the walk's chunks into one graph: numbers the nodes and glues the axis at the bridges
/// (whose disks are no nodes of it). Empties the chunks as it goes, so that nothing is in memory
/// twice; leaves room for so many more nodes.
Graph collect(std::vector<std::unique_ptr<Chunk>>& chunks, std::span<const Bridge> bridges,
              std::size_t spare_nodes, bool with_passages);

/// Takes edges to leaves out of a shape's graph that lead towards a joint where an axis has no
/// leaf, if the disk at which they begin touches all that lies between their sites there within the
/// tolerance. `borders`: nodes at which the axis goes on.
void remove_spurs(const Boundary& boundary, double tolerance, Graph& graph,
                  std::span<const std::uint32_t> borders = {});

/// Notes among a graph's lost sites where it may be wrong next to arcs: where disks reach over
/// sites, and where edges may run backward. O(n log n).
void find_doubts(const Boundary& boundary, const site::BoundaryTree& tree, double tolerance,
                 Graph& graph);

/// Whether an edge that comes within four of its lengths of the centre of a convex arc does not
/// touch its sites at a quarter of its way, give or take `slack`: next to the centre, rounding of
/// its ends may turn the tangents there at will.
bool strays_at_centre(const site::Site& left, const site::Site& right, const Disk& from,
                      const Disk& to, double slack);

/// Works out the edges' curves and an axis' nodes' kinds, and goes back to the result's numbers of
/// sites and to the input's units. Returns the edges that do not touch both their sites at their
/// ends, or stray at a centre, give or take `slack` in local units: where bridges divide a site,
/// the piece of it that the edge names. Without slack, of a diagram whose spokes are still to come:
/// neither kinds nor such edges.
WorkVector<std::uint32_t> complete(const Boundary& boundary, const LocalFrame& frame,
                                   std::optional<double> slack, Graph& graph);

/// Whether the disks at both ends of an edge, and at each quarter of it, touch its two sites, give
/// or take `slack`, in units of the input.
bool touches_its_sites(const MedialAxis& axis, const Edge& edge, double slack);

}  // namespace medial::disks
