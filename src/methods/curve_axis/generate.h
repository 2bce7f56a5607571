#pragma once

#include <optional>

#include "medial/axis.h"
#include "methods/curve_axis/boundary.h"

namespace medial::curve_axis {

/// A disk tangent to the boundary at two points, a valid pair: a point of the symmetry set. Seen
/// along the axis, the left foot moves to smaller u, and the right foot to larger u.
struct AxisPoint {
  BoundaryPoint left, right;
  Disk disk;
  Vec2 tangent;            ///< of the axis, in the direction of generation: (11)
  double radius_rate = 0;  ///< R_a: (12), with its sign
};

/// Section 5.1: uses only the boundary around the two feet.
class Generator {
 public:
  Generator(const Boundary& boundary, double step) : boundary_(boundary), step_(step) {}

  /// The point at a maximum of curvature: the centre of curvature, both feet in one.
  AxisPoint at_maximum(double u) const;

  /// The first point of a branch.
  AxisPoint at(const Tip& tip) const;

  /// The next point: prediction by (13), then the zero set of (14). None if the feet cannot both
  /// advance: restriction (10) is violated, and the boundary supports no further axis.
  std::optional<AxisPoint> next(AxisPoint here) const;

  /// The point with these feet, moved along the boundary to the zero set of (14) by the shortest
  /// way.
  std::optional<AxisPoint> stabilised(double left, double right) const;
  /// The same with one foot fixed.
  std::optional<AxisPoint> with_right(double left, double right) const {
    return with_one_foot(right, left, true);
  }
  std::optional<AxisPoint> with_left(double left, double right) const {
    return with_one_foot(left, right, false);
  }

  /// A disk with three feet close to the given ones: a junction.
  struct Junction {
    double left, middle, right;
    Disk disk;
  };
  std::optional<Junction> junction(double left, double middle, double right) const;

  /// The first point after a maximum. `turn_at_most` is half of the largest angle between its
  /// normals, in radians. After a corner: the smaller, the closer to it.
  std::optional<AxisPoint> first_after(const AxisPoint& tip, double turn_at_most) const;

  /// The point of the symmetry set with two feet.
  AxisPoint point_of(const BoundaryPoint& left, const BoundaryPoint& right) const;

 private:
  std::optional<AxisPoint> first_after_corner(double u, double share) const;
  std::optional<AxisPoint> with_one_foot(double fixed, double moving, bool moves_left) const;

  const Boundary& boundary_;
  double step_;
};

}  // namespace medial::curve_axis
