#pragma once

// Circular arcs by their end points and bulge (see Ring). No function uses the centre or the
// radius, so nearly straight arcs are as well-conditioned as others.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "medial/geometry.h"

namespace medial {

/// The angle from u to v in (-pi, pi], positive to the left.
inline double signed_angle(Vec2 u, Vec2 v) { return std::atan2(cross(u, v), dot(u, v)); }
/// The angle from u to v, turning left, in [0, 2 pi).
inline double left_turn(Vec2 u, Vec2 v) {
  const double angle = signed_angle(u, v);
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

/// A circular arc, or a segment if the bulge is 0. Requires start != end.
struct BulgeArc {
  Vec2 start;
  Vec2 end;
  double bulge = 0;

  Vec2 chord() const { return end - start; }
  BulgeArc reversed() const { return {end, start, -bulge}; }
};

/// Rotates v to the left by the angle with this cosine and sine.
constexpr Vec2 turned(Vec2 v, double cosine, double sine) {
  return {v.x * cosine - v.y * sine, v.x * sine + v.y * cosine};
}

/// Cosine and sine of half the arc's angle, which is the angle between its chord and the tangents
/// at its ends.
constexpr Vec2 half_angle(double bulge) {
  const double square = bulge * bulge;
  return {(1 - square) / (1 + square), 2 * bulge / (1 + square)};
}

/// The unit tangents at both ends, in the arc's direction.
inline Vec2 start_tangent(const BulgeArc& arc) {
  const Vec2 half = half_angle(arc.bulge);
  return turned((1 / norm(arc.chord())) * arc.chord(), half.x, -half.y);
}
inline Vec2 end_tangent(const BulgeArc& arc) {
  const Vec2 half = half_angle(arc.bulge);
  return turned((1 / norm(arc.chord())) * arc.chord(), half.x, half.y);
}

/// Positive if the arc turns to the left.
inline double curvature(const BulgeArc& arc) {
  return 4 * arc.bulge / (norm(arc.chord()) * (1 + arc.bulge * arc.bulge));
}

/// The point of the arc halfway between its ends.
constexpr Vec2 apex(const BulgeArc& arc) {
  return midpoint(arc.start, arc.end) - (arc.bulge / 2) * left_of(arc.end - arc.start);
}

/// The length of an arc with this chord and bulge b; its angle is 4 atan b.
inline double arc_length(double chord, double bulge) {
  const double b = std::abs(bulge);
  return b > 0 ? chord * (1 + b * b) * std::atan(b) / b : chord;
}

/// The point at this share of the arc's length.
inline Vec2 point_at_share(const BulgeArc& arc, double share) {
  if (share <= 0) return arc.start;
  if (share >= 1) return arc.end;
  if (arc.bulge == 0) return arc.start + share * arc.chord();
  const double half = 2 * share * std::atan(arc.bulge);
  return arc.start + (2 * std::sin(half) / curvature(arc)) *
                         turned(start_tangent(arc), std::cos(half), std::sin(half));
}

/// The bulge of half the arc.
inline double half_bulge(double bulge) { return bulge / (1 + std::hypot(1.0, bulge)); }

/// The bulge of the arc with this unit tangent at its start and this chord.
inline double bulge_of(Vec2 tangent, Vec2 chord) {
  return cross(tangent, chord) / (norm(chord) + dot(tangent, chord));
}

/// The bulge of the part of an arc between two of its points, in order along the arc up to
/// rounding. Requires an arc of at most a half circle. The angle of a short part follows from its
/// length, because rounding may decide its direction. No part turns by more than the whole arc.
inline double partial_bulge(const BulgeArc& arc, Vec2 from, Vec2 to) {
  if (arc.bulge == 0) return 0;
  const double whole = std::abs(arc.bulge);
  const double sine = 0.5 * curvature(arc) * norm(to - from);  // of half the angle of its turn
  if (sine * sine <= 0.5) return std::clamp(sine / (1 + std::sqrt(1 - sine * sine)), -whole, whole);
  // The tangent at p is T(p) = T(start) + curvature * left_of(p - start).
  const Vec2 tangent = start_tangent(arc) + curvature(arc) * left_of(from - arc.start);
  return std::clamp(bulge_of(tangent, to - from), -whole, whole);
}

/// The interior point of the arc at which its tangent is parallel to `direction` (a unit vector).
/// Requires an arc of at most a half circle, which has at most one such point.
inline std::optional<Vec2> parallel_point(const BulgeArc& arc, Vec2 direction) {
  if (arc.bulge == 0) return std::nullopt;
  const Vec2 tangent = start_tangent(arc);
  const double begin = cross(direction, tangent);
  const double end = cross(direction, end_tangent(arc));
  if (!(begin * end < 0)) return std::nullopt;
  // Turning by `angle` gives the direction or the opposite one.
  const double sine = std::abs(begin);
  const double along = dot(direction, tangent);
  const double sign = arc.bulge > 0 ? 1 : -1;
  const double cosine = begin * sign < 0 ? along : -along;
  const double half = std::atan2(sine, cosine) / 2;
  const Vec2 chord = turned(tangent, std::cos(half), sign * std::sin(half));
  return arc.start + (2 * std::sin(half) / std::abs(curvature(arc))) * chord;
}

/// The area between the arc and its chord, positive if the arc turns to the left. With the chord's
/// length L, it is L^2 ((1 + b^2)^2 atan b - b (1 - b^2)) / (8 b^2).
inline double area_beside_chord(const BulgeArc& arc) {
  const double b = arc.bulge;
  const double square = b * b;
  double factor = 0;
  if (square < 1.0 / 64) {
    // The closed form would cancel here. The series is 1/3, then 1 / ((2 j + 1) (2 j - 1) (2 j -
    // 3)); its tenth term is below 2^-54 / 3000.
    double power = b;
    factor = b / 3;
    double sign = 1;
    for (int j = 2; j <= 9; ++j) {
      power *= square;
      factor += sign * power / ((2 * j + 1) * (2 * j - 1) * (2 * j - 3));
      sign = -sign;
    }
  } else {
    factor = ((1 + square) * (1 + square) * std::atan(b) - b * (1 - square)) / (8 * square);
  }
  return squared_norm(arc.chord()) * factor;
}

}  // namespace medial
