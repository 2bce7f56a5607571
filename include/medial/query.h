#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "medial/axis.h"
#include "medial/shape.h"

namespace medial {

/// The disk at parameter t in [0, 1] of an edge; exactly the node's disk at 0 and 1.
Disk disk_at(const MedialAxis& axis, const Edge& edge, double t);

/// The point of a site nearest to p: where a disk around p touches it.
Vec2 foot(const Site& site, Vec2 p);

/// Length of an edge in the plane, and of all edges together. Closed forms; relative error < 1e-12.
double length(const MedialAxis& axis, const Edge& edge);
double total_length(const MedialAxis& axis);

/// Samples an edge from node to node, both included, so that every chord stays within `chord`
/// (units of the input) of the curve in (x, y) and in r; but at most 100,000 pieces, however small
/// the chord.
std::vector<Disk> sample_by_chord(const MedialAxis& axis, const Edge& edge, double chord);
/// Samples an edge from node to node, both included, with steps of at most `step` along the curve;
/// but at most 100,000 of them.
std::vector<Disk> sample_by_step(const MedialAxis& axis, const Edge& edge, double step);

/// The edges around each node, by increasing index of the edge; an edge from a node to itself
/// stands there twice. Built in O(edges).
class Incidence {
 public:
  explicit Incidence(const MedialAxis& axis);
  std::span<const std::uint32_t> edges(std::uint32_t node) const {
    return std::span(edges_).subspan(begin_[node], begin_[node + 1] - begin_[node]);
  }
  std::size_t degree(std::uint32_t node) const { return begin_[node + 1] - begin_[node]; }

 private:
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> edges_;
};

/// One edge of a branch, and whether the branch runs from its node[0] to its node[1].
struct Step {
  std::uint32_t edge = 0;
  bool forward = true;
};

/// Blum's medial branch: a chain of edges between leaves and branching nodes, or a closed chain.
struct Branch {
  std::vector<Step> steps;
  std::uint32_t from = 0;  ///< node
  std::uint32_t to = 0;    ///< node; == from for a closed chain
};

/// All branches, each edge in exactly one; ordered by their lowest edge. O(edges).
std::vector<Branch> branches(const MedialAxis& axis);
/// How many branches() there are, in a few bytes per node. O(edges).
std::uint64_t branch_count(const MedialAxis& axis);

/// The node of the largest radius (the lowest index among equals): its disk is the maximum
/// inscribed circle if no arc bounds the shape; see deepest_disk() otherwise. Requires a node.
std::uint32_t deepest_node(const MedialAxis& axis);

/// A nearest point of the axis.
struct AxisPoint {
  std::uint32_t edge = 0;
  double t = 0;  ///< parameter on that edge
  Disk disk;
  double distance = 0;
};

/// Answers "where on the axis is nearest to p" in O(log n) expected, after O(n log n).
/// Keeps a reference to the axis, which must live longer.
class AxisLocator {
 public:
  explicit AxisLocator(const MedialAxis& axis);
  ~AxisLocator();
  AxisLocator(AxisLocator&&) noexcept;
  /// Of edges at equal distance, the lowest index. An axis without edges has no nearest point: the
  /// distance is infinite then, and the rest means nothing.
  AxisPoint nearest(Vec2 p) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

/// The radius of the largest disk around p inside the shape: the distance from p to the nearest
/// boundary, negative outside of the shape. O(n).
double clearance(const Shape& shape, Vec2 p);

}  // namespace medial
