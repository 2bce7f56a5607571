#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "base/pair.h"
#include "verify/edge_sets.h"
#include "verify/whole_edge.h"

namespace medial::verify_detail {

/// All disks of an edge, with room for rounding. The larger one of those at the ends is the one
/// that other edges may be near to: they are looked at from its centre.
class EdgeHull {
 public:
  EdgeHull(const DiskHull& disks, double slack) {
    const std::size_t larger = disks[0].radius > disks[2].radius ? 0 : 2;
    center_ = disks[larger].center;
    double reach = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Disk& disk = disks[i == 0 ? larger : i == 1 ? 1 : 2 - larger];
      const Vec2 to = disk.center - center_;
      const double radius = (1 + 8 * epsilon) * (disk.radius + slack);
      corner_[i] = {both(to.x), both(to.y), both(radius), both(radius * radius)};
      reach = std::max(reach, norm(to) + radius);
    }
    // Nothing reaches the infinite bounds of empty sets.
    limit_ = std::min((1 + 8 * epsilon) * reach * reach, std::numeric_limits<double>::max());
  }

  /// Whether all of them lie in a disk whose size is a number.
  bool is_bounded() const { return limit_ < std::numeric_limits<double>::max(); }

  /// Whether disks may reach two sets in their boxes. They do not if the box is out of reach from
  /// the centre, or all disks lie on one side of it, or behind the line through the place of the
  /// box nearest to the centre that is perpendicular to the way there.
  Pairwise reaches(const Bounds& bounds, std::size_t set, Vec2 origin) const {
    const Pair normal_x = pair_at(bounds.normal_x + set), normal_y = pair_at(bounds.normal_y + set);
    const Pair x = both(center_.x - origin.x), y = both(center_.y - origin.y);
    const Pair from_along = normal_y * x - normal_x * y, from_across = normal_x * x + normal_y * y;
    const Pair low_along = pair_at(bounds.low_along + set) - from_along;
    const Pair high_along = pair_at(bounds.high_along + set) - from_along;
    const Pair low_across = pair_at(bounds.low_across + set) - from_across;
    const Pair high_across = pair_at(bounds.high_across + set) - from_across;
    const Pair along = smaller(larger(low_along, both(0)), high_along);
    const Pair across = smaller(larger(low_across, both(0)), high_across);
    const Pair square = along * along + across * across;
    const Pairwise reached = square <= both(limit_);
    if (!any(reached & (square > 0))) return reached;
    Pair last_along = corner_[0].radius, last_across = last_along;
    Pair first_along = -last_along, first_across = first_along;
    Pairwise ahead = square <= corner_[0].square;
    for (const auto& [at_x, at_y, radius, radius_2] : std::span(corner_).last<2>()) {
      const Pair at_along = normal_y * at_x - normal_x * at_y;
      const Pair at_across = normal_x * at_x + normal_y * at_y;
      first_along = smaller(first_along, at_along - radius);
      last_along = larger(last_along, at_along + radius);
      first_across = smaller(first_across, at_across - radius);
      last_across = larger(last_across, at_across + radius);
      const Pair away = larger(square - (along * at_along + across * at_across), both(0));
      ahead |= away * away <= radius_2 * square;
    }
    return reached & ahead & (first_along <= high_along) & (last_along >= low_along) &
           (first_across <= high_across) & (last_across >= low_across);
  }

  /// Whether no disk reaches two edges of a run. Of an edge, all but the height of an arc lies
  /// behind the line through the point of its chord nearest to the centre, or through its nearer
  /// end, that is perpendicular to the way there.
  Pairwise misses(const Run& run, std::size_t i) const {
    const Pair start_x = pair_at(run.start_x + i), start_y = pair_at(run.start_y + i);
    const Pair from_x = center_.x - start_x, from_y = center_.y - start_y;
    const Pair along_x = pair_at(run.end_x + i) - start_x;
    const Pair along_y = pair_at(run.end_y + i) - start_y;
    const Pair square = along_x * along_x + along_y * along_y;
    // An edge without length is a point.
    const Pair place = (from_x * along_x + from_y * along_y) / larger(square, both(smallest));
    const Pair t = smaller(larger(place, both(0)), both(1));
    const Pair off_x = from_x - t * along_x, off_y = from_y - t * along_y;
    const Pair distance_2 = off_x * off_x + off_y * off_y;
    const Pair to_start = off_x * from_x + off_y * from_y;
    const Pair behind = smaller(to_start, to_start - (off_x * along_x + off_y * along_y));
    const Pair height =
        0.5 * size_of(pair_at(run.bulge + i)) * (size_of(along_x) + size_of(along_y));
    Pairwise missed = distance_2 > 0;
    for (const Corner& corner : corner_) {
      const Pair ahead = larger(behind + off_x * corner.x + off_y * corner.y, both(0));
      const Pair reach = corner.radius + height;
      missed &= ahead * ahead > reach * reach * distance_2;
    }
    if (all(missed) || any(height > 0)) return missed;
    // Next to a convex corner, the line of a straight edge decides more than that through its
    // nearer end.
    const Pair across = along_x * from_y - along_y * from_x, side = with_sign_of(both(1), across);
    Pairwise beside = square > 0;
    for (const Corner& corner : corner_) {
      const Pair away = larger(side * (across + along_x * corner.y - along_y * corner.x), both(0));
      beside &= away * away > corner.square * square;
    }
    return missed | beside;
  }

 private:
  static constexpr double smallest = std::numeric_limits<double>::min();
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();

  Vec2 center_;
  double limit_;
  struct Corner {
    Pair x, y;  ///< from the centre
    Pair radius, square;
  };
  std::array<Corner, 3> corner_;  ///< the centre's first
};

}  // namespace medial::verify_detail
