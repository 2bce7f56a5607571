#pragma once

// Arcs that a sweep line meets once.

#include <algorithm>
#include <cmath>

#include "base/arc.h"
#include "base/predicates.h"

namespace medial {

/// An x-monotone arc of at most a half circle, or a segment, from left to right. "Above" and
/// "below" are defined for points whose x is in its range.
struct MonotoneArc {
  Vec2 left;
  Vec2 right;
  double bulge = 0;           ///< from left to right
  Vec2 up;                    ///< unit normal at `left`, to the left of the arc
  double half_curvature = 0;  ///< positive if it turns to the left

  BulgeArc arc() const { return {left, right, bulge}; }
  /// Bounds on y.
  double low() const {
    return std::min(left.y, right.y) - std::max(bulge, 0.0) / 2 * distance(left, right);
  }
  double high() const {
    return std::max(left.y, right.y) + std::max(-bulge, 0.0) / 2 * distance(left, right);
  }

  /// The signed distance of p above the circle or line: of first order, with the correct sign.
  double above_circle(Vec2 p) const {
    const Vec2 q = p - left;
    return dot(up, q) - half_curvature * squared_norm(q);
  }

  /// The signed distance of p above the arc: of first order, with the correct sign. The error is a
  /// few roundings of |p - left| + |right - left|.
  double above(Vec2 p) const {
    const double value = above_circle(p);
    const double above_chord = cross(right - left, p - left);
    if (bulge * above_chord <= 0) return value;
    // On the other side of the chord, the arc is farther away than the chord.
    const double from_chord = std::abs(above_chord) / distance(left, right);
    return bulge < 0 ? std::min(value, -from_chord) : std::max(value, from_chord);
  }

  /// Whether p lies within the tolerance of the arc, ends included.
  bool is_near(Vec2 p, double tolerance) const {
    if (!(std::abs(above_circle(p)) <= tolerance)) return false;
    const Vec2 chord = right - left;
    const double length = norm(chord);
    const double along = dot(chord, p - left);
    if (along < -tolerance * length || along > length * (length + tolerance)) return false;
    const double above_chord = cross(chord, p - left);
    return bulge == 0 || above_chord * bulge <= 0 || std::abs(above_chord) <= tolerance * length;
  }

  /// Its y at x, clamped to its range.
  double y_at(double x) const {
    if (x <= left.x) return left.y;
    if (x >= right.x) return right.y;
    // The root of (K / 2) (X^2 + Y^2) - up.x X - up.y Y = 0 that is 0 at X = 0.
    const double dx = x - left.x;
    const double c = (half_curvature * dx - up.x) * dx;
    const double root = std::sqrt(std::max(0.0, up.y * up.y - 4 * half_curvature * c));
    const double y = left.y + 2 * c / (up.y + root);
    return std::isfinite(y) ? y : (left.y + right.y) / 2;
  }

  /// The point halfway between two of its points.
  Vec2 halfway(Vec2 from, Vec2 to) const {
    const double sine = std::clamp(half_curvature * distance(from, to), -1.0, 1.0);
    return apex({from, to, sine / (1 + std::sqrt(1 - sine * sine))});
  }
};

inline MonotoneArc monotone_arc(Vec2 left, Vec2 right, double bulge) {
  const BulgeArc arc{left, right, bulge};
  return {left, right, bulge, left_of(start_tangent(arc)), curvature(arc) / 2};
}

/// The signed distance of an arc above a longer one with the same left end, at its end or halfway,
/// whichever is larger; if both are 0, the difference of their turns. Of two arcs with common ends,
/// the one that bends downward more lies above, even if the apexes round to the same point.
inline double above_longer(const MonotoneArc& arc, const MonotoneArc& longer) {
  if (arc.right == longer.right) return longer.bulge - arc.bulge;
  const double at_end = longer.above(arc.right);
  const double before = longer.above(apex(arc.arc()));  // halfway() loses digits of half circles
  const double above = std::abs(at_end) > std::abs(before) ? at_end : before;
  return above != 0 ? above : arc.half_curvature - longer.half_curvature;
}

/// Whether a lies below b next to their common left end. Arcs may cross within the tolerance, so
/// the place where they are farther apart decides, not their tangents.
inline bool is_below(const MonotoneArc& a, const MonotoneArc& b) {
  if (dot(a.up, b.up) < 0) return a.up.x > b.up.x;  // the steeper descent is below
  return lexicographic_less(a.right, b.right) ? above_longer(a, b) < 0 : above_longer(b, a) > 0;
}

}  // namespace medial
