#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "medial/axis.h"
#include "medial/shape.h"
#include "verify/edge_sets.h"
#include "verify/whole_edge.h"

namespace medial::verify_detail {

/// Edges that disks may reach.
struct NearEdges {
  static constexpr std::size_t most = 24;

  std::size_t size = 0;
  std::array<std::uint32_t, most> place;  ///< in the tree
  std::array<std::uint32_t, most> index;  ///< among the shape's
};

/// Centres of disks, whose radii are expected.
struct Places {
  static constexpr std::size_t most = 16;

  Vec2 place(std::size_t i) const { return {x[i], y[i]}; }
  /// Where their number is odd, the last one is looked at with a second one beside it.
  void repeat_last() {
    for (auto* const of : {&x, &y, &radius, &distance}) (*of)[size] = (*of)[size - 1];
  }

  double tolerance;
  std::size_t size = 0;
  std::array<double, most> x, y, radius;
  /// At first the distance to the nearer one of the sites, or infinite; then to the nearest edge.
  std::array<double, most> distance;
};

/// Of each of a shape's edges.
EdgeArcs arcs_of(const Shape& shape);

/// The nearest boundary edge of a shape: a tree over the edges in spatial order (the engines search
/// along the boundary instead). Few edges are simply all looked at.
class DistanceTree {
 public:
  explicit DistanceTree(const Shape& shape);
  /// Of edges anywhere; those without length are points. `arcs`: whether any edge is not straight.
  DistanceTree(std::vector<BoundaryEdge> edges, const Box& box, bool arcs);
  /// Of a shape of which these are known; `arcs`, arcs_of() the shape, stay the caller's.
  DistanceTree(const Shape& shape, const Box& box, const EdgeArcs& arcs);
  DistanceTree(const DistanceTree&) = delete;
  DistanceTree& operator=(const DistanceTree&) = delete;

  /// Distance from p to the nearest edge. `expected` is a guess at it: a query is fast where the
  /// guess is not much too large and not too small. O(log n) expected then.
  double distance(Vec2 p, double expected) const;
  /// Whether no edge is so near.
  bool is_farther(Vec2 p, double distance) const;
  /// Finds the edges that disks, each larger by the tolerance, may reach; false if there are too
  /// many.
  bool find_near(const DiskHull& disks, double tolerance, NearEdges& near) const;
  /// The same, but not of edges over which no disk reaches deeper than both at the ends.
  bool find_near_between_feet(const DiskHull& disks, double tolerance, NearEdges& near) const;
  /// Finds the distances of disks' centres, of which these edges are near, sooner than one by one;
  /// without `near`, one by one.
  void find_distances(const NearEdges* near, Places& places) const;

 private:
  /// Beside each of four sets a disk that no edge of it reaches into, about a place behind the
  /// centre that the set bends round. Next to the centre of very many edges, where every box and
  /// slab is in reach, this says which of them are nearest.
  struct Clearances {
    double x[4]{}, y[4]{}, radius[4]{};
  };

  struct Visit {
    std::uint32_t level, index;
    double squared;
  };
  struct Extremes;
  static void squared_bounds(const Bounds& bounds, Vec2 q, double (&squared)[4]);
  void raise(const Visit& visit, Vec2 p, double (&squared)[4]) const;
  double limit_for(double distance) const;
  void bound(std::span<const BoundaryEdge> edges, const Extremes& extremes, Bounds& bounds,
             std::size_t place) const;
  static std::optional<Vec2> centre_behind(std::span<const BoundaryEdge> edges, double size);
  static std::vector<Clearances> clearances_of(const std::vector<BoundaryEdge>& edges,
                                               std::size_t run, double size);
  bool search(Vec2 p, double& best) const;
  double some_distance(Vec2 p) const;
  template <class EdgeAt>
  static std::vector<Run> runs_of(const std::vector<std::uint32_t>& index, const EdgeAt& edge_at);
  template <class Wanted>
  bool search_near(const DiskHull& disks, double slack, const Wanted& wanted,
                   NearEdges& near) const;
  void lower(Places& places, const Run& run, std::size_t i) const;
  double distance_to(const Run& run, std::size_t i, Vec2 p) const {
    if (run.bulge[i] != 0) return (*arcs_)[run.index[i]].distance(p);
    return distance_to_segment(p, {run.start_x[i], run.start_y[i]}, {run.end_x[i], run.end_y[i]});
  }
  void build(std::vector<BoundaryEdge> edges, const Box& box);
  std::vector<BoundaryEdge> fill_runs(std::vector<BoundaryEdge> edges, const Box& box);
  void build_levels(const std::vector<BoundaryEdge>& pieces, double size);

  /// An arc as often as the tree has pieces of it; the last edge again where fewer are left.
  std::vector<Run> runs_;
  std::vector<std::vector<Bounds>> levels_;  ///< levels_[0] bounds the runs; none of few edges
  std::vector<std::vector<Clearances>> clearances_;  ///< of levels_, or empty: few sets are round
  Vec2 origin_;
  double slack_;  ///< what rounding may add to the distance from a box
  EdgeArcs own_arcs_;
  const EdgeArcs* arcs_;
};

}  // namespace medial::verify_detail
