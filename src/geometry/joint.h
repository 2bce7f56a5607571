#pragma once

#include <cmath>
#include <cstdint>

#include "geometry/site.h"

namespace medial::geometry {

/// How two edges of a boundary join.
enum class Joint : std::uint8_t {
  corner,  ///< at a convex angle: a leaf of the axis
  blunt,   ///< at a convex angle below the corner angle: no leaf
  smooth,  ///< with one tangent: a disk may touch both edges there
  reflex,  ///< at a reflex angle: the vertex is a site
};

/// Directions that differ by less count as one: a disk that touches an edge there stays within
/// radius * angle^2 / 2 of the other one, far below every tolerance.
constexpr double smooth_angle = 1e-8;

/// Directions that are opposite but for less make a cusp: where circles touch, the contact is known
/// to the tolerance, some 1e-14 of the radius. A wider tip, as that of a thin lens, has a side that
/// its angle tells.
constexpr double cusp_angle = 1e-12;

/// The joint of two edges, at least one of them an arc, by their unit tangents and curvatures where
/// they meet; `corner_angle` in radians. At a cusp the curvatures tell whether the interior is
/// inside or around it.
inline Joint joint_of(Vec2 arriving, double curvature_before, Vec2 leaving, double curvature_after,
                      double corner_angle) {
  const double sine = cross(arriving, leaving), cosine = dot(arriving, leaving);
  if (cosine > 0 && std::abs(sine) <= smooth_angle) return Joint::smooth;
  if (cosine < 0 && std::abs(sine) <= cusp_angle)
    return -curvature_before > curvature_after ? Joint::corner : Joint::reflex;
  if (sine < 0) return Joint::reflex;
  return std::atan2(sine, cosine) <= corner_angle ? Joint::blunt : Joint::corner;
}
/// The same where `before` ends and `after` begins.
inline Joint joint_of(const Site& before, const Site& after, double corner_angle) {
  return joint_of(-left_of(before.end_normal()), before.curvature, after.direction, after.curvature,
                  corner_angle);
}

}  // namespace medial::geometry
