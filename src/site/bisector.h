#pragma once

#include <cmath>

#include "medial/geometry.h"
#include "site/site.h"
#include "site/tangent_disk.h"

namespace medial::site {

/// The direction, of any length, in which the walk along the bisector of two sites goes, neither of
/// them an arc: the position of a disk grows like the product of its centre with it.
inline Vec2 direction_along(const Site& right, const Site& left) {
  if (right.is_vertex() && left.is_vertex()) return -left_of(left.point - right.point);
  // Two segments that run almost the same way: the sum of the normals is parallel to the
  // difference of the directions, and keeps its digits. The walk leaves a gap or corner behind it
  // if the left one comes first, and ends in one if it comes last. Where each reaches beside the
  // other it goes where the two lines open.
  if (!(dot(right.direction, left.direction) > 0)) return right.direction - left.direction;
  const Vec2 sum = right.normal() + left.normal(), along = right.direction + left.direction;
  bool leaves = meets(left, right) || dot(along, right.point - left.end()) >= 0;
  if (!leaves && !meets(right, left) && !(dot(along, left.point - right.end()) >= 0))
    leaves = cross(right.direction, left.direction) < 0;
  return leaves ? sum : -sum;
}

/// The bisector of two sites as a walk meets it: going along it, the foot on `right` moves forward
/// along the boundary and the foot on `left` moves backward.
///
/// A disk's position along the bisector increases along the walk, so disks on one bisector are
/// ordered by it. Without arcs it is the product of the centre with one fixed vector: the direction
/// of the angle bisector (two segments), of the segment (segment and vertex, a parabola over the
/// segment), or perpendicular to the chord (two vertices). With an arc (ellipses, hyperbolas,
/// parabolas, circles) it is where the foot lies on one of the two sites, the `reference`: the
/// parameter of a segment or of a large arc, twice the tangent of half the angle on a small one.
///
/// Refers to the two sites.
struct Bisector {
  const Site& right;
  const Site& left;
  Vec2 direction;
  const Site* reference = nullptr;  ///< of a bisector with an arc
  double scale = 0;                 ///< from the reference's parameter to the position

  Bisector(const Site& right_site, const Site& left_site) : right(right_site), left(left_site) {
    if (right.is_arc() || left.is_arc()) {
      // The flatter of the two, but no vertex: its foot stays.
      const bool by_right =
          left.is_vertex() ||
          (!right.is_vertex() && std::abs(right.curvature) <= std::abs(left.curvature));
      reference = by_right ? &right : &left;
      scale = std::max(1.0, std::abs(reference->curvature));
      if (!by_right) scale = -scale;
      return;
    }
    direction = direction_along(right, left);
    const double size = norm(direction);
    if (size > 0) direction = (1 / size) * direction;
  }

  double position(Vec2 center) const {
    if (reference != nullptr) return scale * carrier_parameter(*reference, center);
    return dot(direction, center);
  }

  /// The unit tangent in the direction of the walk: both distances grow alike.
  Vec2 tangent(Vec2 center) const;

  /// The disk at a position; of infinite radius where there is none. `near` is any disk on the
  /// bisector; two segments need it as an anchor.
  Disk disk_at(double position, const Disk& near) const;

  /// A position beyond which no disk of the bisector has a radius in [0, limit], seen from `near`
  /// forward.
  double last_position(const Disk& near, double limit) const;
};

/// The control point (x, y, r) and the weight of the edge between two disks on the bisector of a
/// and b, as a rational quadratic Bezier with end weights 1: exact (docs/disks.md).
struct Control {
  Disk point;
  double weight = 1;
};
Control control_of(const Site& a, const Site& b, const Disk& from, const Disk& to);

}  // namespace medial::site
