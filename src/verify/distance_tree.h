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

/// Centres of disks with their expected distances.
struct Places {
  static constexpr std::size_t most = 16;

  Vec2 place(std::size_t i) const { return {x[i], y[i]}; }
  /// If their number is odd, repeats the last one, because places are processed in pairs.
  void repeat_last() {
    for (auto* const of : {&x, &y, &radius, &distance}) (*of)[size] = (*of)[size - 1];
  }

  double tolerance;
  std::size_t size = 0;
  std::array<double, most> x, y, radius;
  /// On input, the distance to the nearer site, or infinity; on output, to the nearest edge.
  std::array<double, most> distance;
};

/// The arcs among a shape's edges.
EdgeArcs arcs_of(const Shape& shape);

/// Finds the nearest boundary edge of a shape, by a tree over the edges in spatial order. (The
/// engines search in boundary order instead.) If there are few edges, tests all.
class DistanceTree {
 public:
  explicit DistanceTree(const Shape& shape);
  /// A tree of any edges; edges of length 0 are points. `arcs`: whether any edge is an arc.
  DistanceTree(std::vector<BoundaryEdge> edges, const Box& box, bool arcs);
  /// A tree of a shape's edges. Keeps a reference to `arcs`, which is arcs_of() the shape.
  DistanceTree(const Shape& shape, const Box& box, const EdgeArcs& arcs);
  DistanceTree(const DistanceTree&) = delete;
  DistanceTree& operator=(const DistanceTree&) = delete;

  /// Distance from p to the nearest edge. `expected` is an estimate of it. O(log n) expected if the
  /// estimate is neither too small nor much too large.
  double distance(Vec2 p, double expected) const;
  /// Whether all edges are farther than `distance`.
  bool is_farther(Vec2 p, double distance) const;
  /// Finds the edges that disks grown by the tolerance may reach. Returns false if there are too
  /// many.
  bool find_near(const DiskHull& disks, double tolerance, NearEdges& near) const;
  /// The same, except edges that no disk covers more deeply than both disks at the ends.
  bool find_near_between_feet(const DiskHull& disks, double tolerance, NearEdges& near) const;
  /// Computes the distances of disks' centres whose near edges are known, which is faster than
  /// single queries; without `near`, uses single queries.
  void find_distances(const NearEdges* near, Places& places) const;

 private:
  /// For each of four sets, a disk into which no edge of the set reaches, around a place behind the
  /// centre around which the set bends. Next to the common centre of very many edges, where every
  /// box and slab is in reach, these disks show which sets are nearest.
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

  /// Each arc occurs as often as the tree has pieces of it; the last edge fills the last run.
  std::vector<Run> runs_;
  std::vector<std::vector<Bounds>> levels_;  ///< levels_[0] bounds the runs; none of few edges
  std::vector<std::vector<Clearances>> clearances_;  ///< of levels_, or empty: few sets are round
  Vec2 origin_;
  double slack_;  ///< bound for the rounding error of the distance from a box
  EdgeArcs own_arcs_;
  const EdgeArcs* arcs_;
};

}  // namespace medial::verify_detail
