#pragma once

// The measures of pruning at points of the trees of an axis.

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
  /// With `reaches`, reach() is available for every measure.
  Importance(const MedialAxis& axis, const Trees& trees, PruneMeasure measure, bool reaches);

  /// Whether the measure is one of branches (see PruneMeasure).
  bool of_branches() const { return of_branches_; }
  /// The number of equal steps at which an edge must be sampled; 1 if the measure is largest at an
  /// end.
  int steps() const { return steps_; }
  /// The measure at s in [0, 1] of a tree's edge, from its outer to its inner end. Not negative.
  double at(std::uint32_t edge, double s) const;
  /// Whether at(edge, s) >= threshold.
  bool reaches(std::uint32_t edge, double s, double threshold) const;
  /// The reach of the shape beyond the inner end of an edge: the longest path along it, plus the
  /// radius at the end of that path.
  double reach(std::uint32_t edge) const;

 private:
  /// Sums over the part beyond a point of an edge of a tree.
  struct Beyond {
    double way = 0;       ///< length of the longest path to an end
    double reach = 0;     ///< the largest length plus the radius at its end
    double boundary = 0;  ///< length
    double area = 0;      ///< between the radii to the feet
  };

  /// The feet on the left and on the right.
  std::array<Vec2, 2> feet(const Edge& edge, double t, const Disk& disk) const;
  /// Adds the length of the boundary on both sides of a part of an edge, and the area in between.
  void add_sides(std::uint32_t edge, double t0, double t1, Beyond& sum) const;
  Beyond beyond(std::uint32_t edge, double s) const;
  void sum_up();
  void find_vanishing();
  /// The area beyond a point that the disk there does not cover.
  double lost_area(const Edge& edge, bool outer_first, double t, const Disk& disk,
                   double area_beyond) const;

  const MedialAxis& axis_;
  const Trees& trees_;
  PruneMeasure measure_;
  bool of_branches_ = false, of_sides_ = false, of_reach_ = false;
  int steps_ = 1;
  std::vector<Beyond> beyond_;  ///< of each node, with the arcs of its own disk
  std::vector<double> size_;    ///< of each connected part: the divisor of the measure
  std::optional<DiskTree> disks_;
  /// Of each node: the factor at which its disk vanishes, and the disk that then covers it.
  std::vector<std::pair<double, Disk>> vanishing_;
};

}  // namespace medial::ops
