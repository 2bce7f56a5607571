#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial/shape.h"
#include "verify/boundary_edge.h"

namespace medial::verify_detail {

/// The nearest boundary edge of a shape: a tree over the edges in spatial order (the engines search
/// along the boundary instead). Few edges are simply all looked at.
class DistanceTree {
 public:
  explicit DistanceTree(const Shape& shape);
  /// Of edges anywhere; those without length are points. `arcs`: whether any edge is not straight.
  DistanceTree(std::span<const BoundaryEdge> edges, const Box& box, bool arcs);

  /// Distance from p to the nearest edge. `expected` is a guess at it: a query is fast where the
  /// guess is not much too large and not too small. O(log n) expected then.
  double distance(Vec2 p, double expected) const;
  /// The same where `near` holds all edges within `expected` of p, as near() finds them: sooner for
  /// places beside each other.
  double distance(Vec2 p, double expected, std::span<const std::uint32_t> near) const;
  /// All edges within `reach` of p and maybe some more; none if they are more than `most`.
  void near(Vec2 p, double reach, std::size_t most, std::vector<std::uint32_t>& found) const;

 private:
  /// Bounds of four sets of edges side by side, so that a compiler can compare them at once. Each
  /// set lies in a box, and in a slab low <= normal . (p - origin_) <= high along its longest
  /// extent: on a smooth boundary, boxes alone would let far too many edges near a contact pass.
  struct Bounds {
    double low_x[4], low_y[4], high_x[4], high_y[4];
    double normal_x[4], normal_y[4], slab_low[4], slab_high[4];
  };

  struct Visit {
    std::uint32_t level, index;
    double squared;
  };

  void squared_bounds(const Visit& visit, Vec2 p, double (&squared)[4]) const;
  double limit_for(double distance) const;
  void bound(std::span<const BoundaryEdge> edges, Bounds& bounds, std::size_t place) const;
  bool search(Vec2 p, double& best) const;
  double some_distance(Vec2 p) const;

  std::vector<BoundaryEdge> edges_;          ///< an arc as often as the tree has pieces of it
  std::vector<std::vector<Bounds>> levels_;  ///< levels_[0] bounds runs of four edges
  Vec2 origin_;
  double slack_ = 0;  ///< what rounding may add to the distance from a slab
};

}  // namespace medial::verify_detail
