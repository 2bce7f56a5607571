#pragma once

// The measures of pruning as numbers at points of the trees of an axis.

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "medial/axis.h"
#include "medial/prune.h"
#include "ops/disk_tree.h"
#include "ops/half_edges.h"
#include "ops/trees.h"

namespace medial::ops {

/// One measure at every point of the trees. Keeps references to its arguments.
class Importance {
 public:
  /// With `reaches`, reach() is known whatever the measure.
  Importance(const MedialAxis& axis, const Trees& trees, PruneMeasure measure, bool reaches);

  /// Whether the measure is one of branches (see PruneMeasure).
  bool of_branches() const { return of_branches_; }
  /// How many equal steps of an edge show all of the measure: 1 where it is largest at an end.
  int steps() const { return steps_; }
  /// The measure at s in [0, 1] of a tree's edge, from its outer to its inner end. Not negative.
  double at(std::uint32_t edge, double s) const;
  /// Whether at(edge, s) >= threshold.
  bool reaches(std::uint32_t edge, double s, double threshold) const;
  /// How far the shape reaches from the inner end of an edge, along it and through the disk at the
  /// end of the way.
  double reach(std::uint32_t edge) const;

 private:
  /// What lies beyond a point of an edge of a tree.
  struct Beyond {
    double way = 0;       ///< the longest one to an end
    double reach = 0;     ///< the longest one, with the radius at its end
    double boundary = 0;  ///< length
    double area = 0;      ///< between the radii to the feet
  };

  /// On the left and on the right.
  std::array<Vec2, 2> feet(const Edge& edge, double t, const Disk& disk) const;
  /// Adds the length of the boundary on both sides of a part of an edge, and the area in between.
  void add_sides(std::uint32_t edge, double t0, double t1, Beyond& sum) const;
  Beyond beyond(std::uint32_t edge, double s) const;
  void sum_up();
  void find_vanishing();
  /// Of the area beyond a point, what the disk there does not cover.
  double lost_area(const Edge& edge, bool outer_first, double t, const Disk& disk,
                   double area_beyond) const;

  const MedialAxis& axis_;
  const Trees& trees_;
  PruneMeasure measure_;
  bool of_branches_ = false, of_sides_ = false, of_reach_ = false;
  int steps_ = 1;
  std::vector<Beyond> beyond_;  ///< of each node, with the arcs of its own disk
  std::vector<double> size_;    ///< of each connected part: what the measure is divided by
  std::optional<DiskTree> disks_;
  /// Of each node: where it vanishes, and in what.
  std::vector<std::pair<double, Disk>> vanishing_;
};

}  // namespace medial::ops
