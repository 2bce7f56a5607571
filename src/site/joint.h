#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/arc.h"
#include "shape/monotone_arc.h"

namespace medial::site {

/// How two edges of a boundary join.
enum class Joint : std::uint8_t {
  corner,  ///< at a convex angle: a leaf of the axis
  blunt,   ///< at a convex angle below the corner angle: no leaf
  smooth,  ///< with a common tangent: a disk may touch both edges there
  reflex,  ///< at a reflex angle: the vertex is a site
};

/// The joint where `before` ends and `after` begins. At least one of them is an arc.
///
/// Two directions count as equal if their angle is below the uncertainty that rounding of the
/// coordinates causes: 1e-12 (only this at a cusp), and four times `tolerance` (of the coordinates,
/// in their units) relative to the chords; but at most 1e-7, at which a disk as large as the shape
/// that touches one edge reaches over the other by 1e-14 of its size. At a cusp, the interior is
/// inside or around it; this follows from the relative position of the edges where they are farther
/// apart, at the end of the shorter one or halfway, as in build_shape(). A joint also counts as a
/// cusp if the edges cross again before they are `tolerance` apart: at distance s from it, they are
/// (sine - (sum of the curvatures) s / 2) s apart, which is at most sine^2 / (2 (sum of the
/// curvatures)), and zero at the end of the chord 2 sine / (sum of the curvatures). `corner_angle`
/// is in radians.
inline Joint joint_of(const BulgeArc& before, const BulgeArc& after, double tolerance,
                      double corner_angle) {
  constexpr double least = 1e-12, most = 1e-7;
  const Vec2 arriving = end_tangent(before), leaving = start_tangent(after);
  const double sine = cross(arriving, leaving), cosine = dot(arriving, leaving);
  const double chord_before = distance(before.start, before.end);
  const double chord_after = distance(after.start, after.end);
  const double rounding = 4 * tolerance * (1 / chord_before + 1 / chord_after);
  const auto keeps_clear = [&] {
    const double bend = std::abs(curvature(before) - curvature(after)), angle = std::abs(sine);
    return angle * angle <= tolerance * bend ||
           angle * std::min(chord_before, chord_after) <= 0.5 * tolerance;
  };
  if (cosine > 0 && std::abs(sine) <= std::min(least + rounding, most) && keeps_clear())
    return Joint::smooth;
  const double both = curvature(before) + curvature(after);
  const bool crosses_again =
      sine * both > 0 && sine * sine <= 2 * tolerance * std::abs(both) &&
      2 * std::abs(sine) <= std::abs(both) * std::min(chord_before, chord_after);
  if (cosine < 0 && (std::abs(sine) <= least || crosses_again)) {
    const MonotoneArc back = monotone_arc(before.end, before.start, -before.bulge);
    const MonotoneArc on = monotone_arc(after.start, after.end, after.bulge);
    const bool corner =
        chord_before < chord_after ? above_longer(back, on) > 0 : above_longer(on, back) < 0;
    return corner ? Joint::corner : Joint::reflex;
  }
  if (sine < 0) return Joint::reflex;
  return std::atan2(sine, cosine) <= corner_angle ? Joint::blunt : Joint::corner;
}

}  // namespace medial::site
