#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/local_frame.h"
#include "medial/axis.h"
#include "methods/lee/diagram.h"

namespace medial::lee {

/// The diagram of whole polygons as a graph, in place and in the local frame: a tree for every
/// component, in which every edge knows the edge that begins at its outer end. The place of that
/// edge names the node; a component's last corner, where no edge begins, uses a free place. An edge
/// that a bridge divides is two edges here, which begin at the bridge's disk.
class Graph {
 public:
  /// `last_edges` is the result of conquer(). Consumes the stacks of earlier elements. O(N).
  Graph(Diagram& diagram, const std::vector<std::uint32_t>& last_edges, double tolerance);
  /// Whether the diagram is one of whole polygons: every list of N elements has 2 N - 3 edges
  /// (Lemma 3), and only the terminating bisector ends in a corner. If not, no other member may be
  /// called.
  bool is_whole() const { return is_whole_; }

  const Elements& elements() const { return diagram_.elements; }
  const ListEdge& operator[](std::uint32_t edge) const { return diagram_.edges[edge]; }
  /// The number of places. The numbers of all nodes and edges are smaller.
  std::size_t places() const { return diagram_.edges.size(); }
  bool is_spoke(std::uint32_t edge) const { return diagram_.is_spoke(diagram_.edges[edge]); }
  /// Whether an edge is not part of the axis: it is a spoke, or leads to a blunt joint.
  bool is_beside_axis(std::uint32_t edge) const {
    const auto& [i, j] = diagram_.edges[edge].element;
    return elements().have_arcs() ? elements().beside(i, j) != Beside::no : is_spoke(edge);
  }

  std::uint32_t to(std::uint32_t edge) const { return diagram_.edges[edge].inward[1]; }
  void set_to(std::uint32_t edge, std::uint32_t node) { diagram_.edges[edge].inward[1] = node; }
  const Disk& disk(std::uint32_t node) const { return diagram_.edges[node].inner; }
  void set_disk(std::uint32_t node, const Disk& disk) { diagram_.edges[node].inner = disk; }
  bool begins_at_bridge(std::uint32_t edge) const {
    const ListEdge& e = diagram_.edges[edge];
    return e.inward[0] == none && e.inner.radius > 0;
  }
  /// The elements whose polygons meet in a Voronoi point: those of the edge that begins there, and
  /// of the edges that end there.
  std::array<std::uint32_t, 3> touched(std::uint32_t node) const {
    const ListEdge& edge = diagram_.edges[node];
    return {edge.element[0], edge.element[1], diagram_.edges[edge.inward[0]].element[1]};
  }

  /// The edges whose Voronoi points might be one: they are closer than `furthest` radii or than the
  /// tolerance, or a foot moves in the wrong direction by more than the tolerance, as between
  /// nearly collinear segments, along which rounding does not determine the position of the disk.
  const std::vector<std::uint32_t>& doubtful_edges() const { return doubtful_edges_; }
  static constexpr double furthest = 1e-4;
  /// Whether the foot of an edge's disks moves in the wrong direction on one of its elements by
  /// more than `slack`, from the inner to the outer end.
  bool runs_backward(std::uint32_t edge, double slack) const;

  /// Calls work(edge) for all edges of a loop, ordered by their first elements and by the feet on
  /// each.
  template <class Work>
  void for_edges(const Elements::ChainLoop& loop, const Work& work) const {
    for (std::uint32_t i = begin_of(loop), end = end_of(loop); i < end; ++i)
      for (std::uint32_t edge = diagram_.top[i][0]; edge != none;
           edge = diagram_.edges[edge].inward[0])
        work(edge);
  }

 private:
  std::uint32_t begin_of(const Elements::ChainLoop& loop) const {
    return elements().chains[loop.first_chain];
  }
  std::uint32_t end_of(const Elements::ChainLoop& loop) const {
    return elements().chains[loop.end_chain];
  }
  bool close(const Elements::ChainLoop& loop, std::uint32_t last_edge);
  void find_doubtful_edge(std::uint32_t edge);

  Diagram& diagram_;
  double tolerance_;
  bool is_whole_ = true;
  std::vector<std::uint32_t> doubtful_edges_;
};

/// Writes the whole graph in units of the input, with the faces of the diagram's sites.
void complete(const Graph& graph, const LocalFrame& frame, VoronoiDiagram& diagram);

/// Writes the medial axis: the graph less its spokes (Corollary 3). Edges without length between
/// cocircular elements, whose end disks agree within `tolerance`, become one node and are removed
/// from the graph. Returns the largest residual in the middle of an edge with an arc, in the local
/// frame.
double complete(Graph& graph, const LocalFrame& frame, double tolerance, MedialAxis& axis);

}  // namespace medial::lee
