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

/// The directions from the centre of a disk in which disks between it and another one cover places
/// more deeply than it does.
///
/// The depth by which a disk (c, r) covers a place x, r - |x - c|, is concave in c and r. So on the
/// way to a disk (e, q), it never increases if it does not increase at first:
///   (x - c) . (e - c) <= |x - c| (r - q).
/// Otherwise, x lies in a sector around e - c. The sides of the sector lead to the points where the
/// common tangents of both disks touch the disk.
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

  /// Whether a box lies entirely outside: beyond one side of a convex sector, or beyond both sides
  /// of a reflex one.
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
  Pair inward_x_{}, inward_y_{};  ///< normals of the sides; zero: everything or nothing is inside
  Pair limit_{};                  ///< positions of the sides along their normals
  bool is_convex_ = true;
};

/// The places that disks of an axis edge may cover more deeply than both disks at its ends: the
/// intersection of the sectors of both ends. This is next to its sites, between their feet, even if
/// many other sites touch a disk at its end.
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
  bool is_straight_;  ///< the disks interpolate those at the ends linearly, up to rounding
};

}  // namespace medial::verify_detail
