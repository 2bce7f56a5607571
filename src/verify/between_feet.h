#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/pair.h"
#include "medial/axis.h"
#include "verify/edge_sets.h"
#include "verify/whole_edge.h"

namespace medial::verify_detail {

/// The directions from the centre of a disk in which disks between it and another one reach over
/// places deeper than it does.
///
/// How deep a disk (c, r) reaches over a place x, r - |x - c|, is concave in c and r. So on the way
/// to a disk (e, q) it never grows where it does not grow at first:
///   (x - c) . (e - c) <= |x - c| (r - q).
/// Elsewhere x lies in a sector around e - c, whose sides lead to where the lines touch the disk
/// that touch both.
class Sector {
 public:
  /// Coordinates are relative to the origin; boxes may be off by the slack.
  Sector(const Disk& from, const Disk& to, Vec2 origin, double slack) {
    const Vec2 way = to.center - from.center, apex = from.center - origin;
    const double length = norm(way), growth = from.radius - to.radius;
    if (!(std::abs(growth) < length)) {
      if (growth >= 0) limit_ = both(std::numeric_limits<double>::infinity());
      return;
    }
    const Vec2 ahead = (1 / length) * way;
    const double cosine = growth / length, sine = std::sqrt((1 - cosine) * (1 + cosine));
    const std::array<Vec2, 2> inward{sine * ahead - cosine * left_of(ahead),
                                     sine * ahead + cosine * left_of(ahead)};
    inward_x_ = Pair{inward[0].x, inward[1].x};
    inward_y_ = Pair{inward[0].y, inward[1].y};
    limit_ = Pair{dot(inward[0], apex), dot(inward[1], apex)} - slack;
    is_convex_ = cosine >= 0;
  }

  /// Whether all of a box lies outside: behind one side of a convex sector, or both of another.
  bool misses(const Bounds& bounds, std::size_t set) const {
    const double x = bounds.normal_x[set], y = bounds.normal_y[set];
    const Pair along = inward_x_ * y - inward_y_ * x, across = inward_x_ * x + inward_y_ * y;
    const Pairwise behind =
        larger(along * bounds.low_along[set], along * bounds.high_along[set]) +
            larger(across * bounds.low_across[set], across * bounds.high_across[set]) <
        limit_;
    return is_convex_ ? any(behind) : all(behind);
  }

 private:
  Pair inward_x_{}, inward_y_{};  ///< normals of the sides; none: everything or nothing lies inside
  Pair limit_{};                  ///< how far along them the sides are
  bool is_convex_ = true;
};

/// Where disks of an edge of an axis may reach deeper than both disks at its ends do: in the
/// sectors of both. That is beside its sites between their feet, however many others touch a disk
/// at its end.
class BetweenFeet {
 public:
  BetweenFeet(const DiskHull& disks, Vec2 origin, double slack)
      : across_{Sector(disks[0], disks[2], origin, slack),
                Sector(disks[2], disks[0], origin, slack)},
        to_control_{Sector(disks[0], disks[1], origin, slack),
                    Sector(disks[2], disks[1], origin, slack)} {
    const auto [from, control, to] = disks;
    is_straight_ = norm(control.center - midpoint(from.center, to.center)) +
                       std::abs(control.radius - 0.5 * (from.radius + to.radius)) <
                   0.25 * slack;
  }

  bool misses(const Bounds& bounds, std::size_t set) const {
    const auto misses_of = [&](std::size_t end) {
      return across_[end].misses(bounds, set) &&
             (is_straight_ || to_control_[end].misses(bounds, set));
    };
    return misses_of(0) || misses_of(1);
  }

 private:
  std::array<Sector, 2> across_, to_control_;  ///< from each end, to the other and to the control
  bool is_straight_;  ///< the disks are those between the ones at the ends, up to rounding
};

}  // namespace medial::verify_detail
