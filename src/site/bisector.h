#pragma once

#include <cmath>

#include "medial/geometry.h"
#include "site/site.h"
#include "site/tangent_disk.h"

namespace medial::site {

/// The direction, of any length, of the walk along the bisector of two sites, neither of them an
/// arc. The position of a disk is the product of its centre with this direction.
inline Vec2 direction_along(const Site& right, const Site& left) {
  if (right.is_vertex() && left.is_vertex()) return -left_of(left.point - right.point);
  // For two segments with almost the same direction, the sum of the normals is parallel to the
  // difference of the directions, and more accurate. The walk starts at a gap or corner if the left
  // segment comes first, and ends at one if it comes last. If each overlaps the other's extent, it
  // goes to the side where the two lines diverge.
  if (!(dot(right.direction, left.direction) > 0)) return right.direction - left.direction;
  const Vec2 sum = right.normal() + left.normal(), along = right.direction + left.direction;
  bool leaves = meets(left, right) || dot(along, right.point - left.end()) >= 0;
  if (!leaves && !meets(right, left) && !(dot(along, left.point - right.end()) >= 0))
    leaves = cross(right.direction, left.direction) < 0;
  return leaves ? sum : -sum;
}

/// The bisector of two sites in the direction of the walk: the foot on `right` moves forward along
/// the boundary, and the foot on `left` moves backward.
///
/// The position of a disk along the bisector increases along the walk, so it orders the disks of
/// one bisector. Without arcs, it is the product of the centre with a fixed vector: the direction
/// of the angle bisector (two segments), the direction of the segment (segment and vertex, a
/// parabola), or the perpendicular of the chord (two vertices). With an arc (ellipses, hyperbolas,
/// parabolas, circles), it is the position of the foot on one of the two sites, the `reference`:
/// the parameter on a segment or a large arc, twice the tangent of half the angle on a small arc.
///
/// Keeps references to the two sites.
struct Bisector {
  const Site& right;
  const Site& left;
  Vec2 direction;
  const Site* reference = nullptr;  ///< of a bisector with an arc
  double scale = 0;                 ///< position per unit of the reference's parameter

  Bisector(const Site& right_site, const Site& left_site) : right(right_site), left(left_site) {
    if (right.is_arc() || left.is_arc()) {
      // The flatter of the two. A vertex cannot be the reference, because its foot does not move.
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

  /// The unit tangent in the direction of the walk, along which both distances change equally.
  Vec2 tangent(Vec2 center) const;

  /// The disk at a position; its radius is infinite if there is none. `near` is any disk on the
  /// bisector, which serves as an anchor for two segments.
  Disk disk_at(double position, const Disk& near) const;

  /// A position ahead of `near` beyond which no disk of the bisector has a radius in [0, limit].
  double last_position(const Disk& near, double limit) const;
};

/// The control point (x, y, r) and the weight of the edge between two disks on the bisector of a
/// and b: an exact rational quadratic Bezier curve with end weights 1 (docs/disks.md).
struct Control {
  Disk point;
  double weight = 1;
};
Control control_of(const Site& a, const Site& b, const Disk& from, const Disk& to);

}  // namespace medial::site
