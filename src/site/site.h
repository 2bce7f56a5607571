#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "medial/geometry.h"

namespace medial::site {

/// A site for the kernels: a curve of constant curvature with the interior on its left, or a
/// vertex. It starts at `point` in the unit direction `direction`. Its parameter is
///
///     s = (2 / curvature) tan(phi / 2),
///
/// where phi is the angle by which the curve has turned to the left. This is the arc length on a
/// segment and a rational parametrisation on an arc, and it is well-conditioned in between.
/// Positive curvature is convex as seen from the interior. An arc turns by at most a quarter of a
/// circle.
///
/// A disk of centre c and radius r touches the carrier (the whole line or circle) from inside if,
/// with d = c - point and the left normal n,
///
///     n.d - r = curvature (d.d - r r) / 2.
///
/// If the equation of an arc is multiplied by its radius, the limit of radius 0 is the equation of
/// a vertex. So one formula covers all sites; it is linear in (c, r) and the quadric d.d - r r.
struct Site {
  Vec2 point;
  Vec2 direction;     ///< unit length, or (0, 0) for a vertex
  double length = 0;  ///< the parameter of the end; 0 for a vertex
  double curvature = 0;

  bool is_vertex() const { return length == 0; }
  bool is_arc() const { return curvature != 0; }
  Vec2 normal() const { return left_of(direction); }
  /// The point at parameter s.
  Vec2 at(double s) const {
    if (!is_arc()) return point + s * direction;
    const double tau = 0.5 * curvature * s;
    return point + (s / (1 + tau * tau)) * (direction + tau * normal());
  }
  /// The left unit normal at parameter s.
  Vec2 normal_at(double s) const {
    if (!is_arc()) return normal();
    const double tau = 0.5 * curvature * s, scale = 1 / (1 + tau * tau);
    return scale * ((1 - tau * tau) * normal() - (2 * tau) * direction);
  }
  Vec2 end() const { return at(length); }
  /// The intersection of the tangents at both ends. The site lies in the triangle of its ends and
  /// its apex.
  Vec2 apex() const { return point + (0.5 * length) * direction; }
  Vec2 end_normal() const { return normal_at(length); }
};

inline Site make_segment(Vec2 start, Vec2 end) {
  const Vec2 d = end - start;
  const double length = norm(d);
  return {start, (1 / length) * d, length};
}

/// The largest bulge of an arc that is one site: a quarter of a circle, tan(pi / 8).
constexpr double largest_bulge = 0.41421356237309515;

inline Site make_vertex(Vec2 point) { return {point, {0, 0}, 0}; }

/// The arc from `start` to `end` with the given bulge, at most largest_bulge in size.
inline Site make_arc(Vec2 start, Vec2 end, double bulge) {
  const Vec2 d = end - start;
  const double chord = norm(d), squared = bulge * bulge;
  // The tangent at the start is the chord turned to the right by half of the arc's angle.
  const double scale = 1 / ((1 + squared) * chord);
  const Vec2 tangent = scale * ((1 - squared) * d - (2 * bulge) * left_of(d));
  return {start, tangent, chord * (1 + squared) / (1 - squared),
          4 * bulge / (chord * (1 + squared))};
}

/// The part of a segment or arc from parameter `from` to `to`. Its length is never 0.
inline Site part_of(const Site& site, double from, double to) {
  const double half = 0.5 * site.curvature;
  const double length = (to - from) / (1 + (half * from) * (half * to));
  return {site.at(from), -left_of(site.normal_at(from)),
          std::max(length, std::numeric_limits<double>::min()), site.curvature};
}

/// The same segment or arc seen from its other side.
inline Site reversed(const Site& site) {
  return {site.end(), left_of(site.end_normal()), site.length, -site.curvature};
}

/// Whether the end of an edge is this point. The error of an end is below four roundings of a local
/// coordinate.
inline bool is_same_place(Vec2 end, Vec2 point) {
  constexpr double same_point = 0x1p-50;
  const Vec2 gap = end - point;
  return std::abs(gap.x) <= same_point && std::abs(gap.y) <= same_point;
}

/// Whether two edges are certainly the two sides of one edge, with bitwise equal lengths.
inline bool are_two_sides(const Site& a, const Site& b) {
  return a.length == b.length && a.curvature == -b.curvature && is_same_place(a.point, b.end()) &&
         is_same_place(a.end(), b.point);
}

/// Whether edge `before` ends where edge `after` begins.
inline bool meets(const Site& before, const Site& after) {
  return is_same_place(before.end(), after.point);
}

/// The position of a point c relative to the carrier of an arc.
struct ArcView {
  Vec2 toward;      ///< (1 - curvature * distance) times the unit normal at the foot
  double size;      ///< |toward|
  double distance;  ///< positive on the left
};
inline ArcView view_of_arc(const Site& arc, Vec2 c) {
  const Vec2 d = c - arc.point, normal = arc.normal();
  const Vec2 toward = normal - arc.curvature * d;
  const double size = norm(toward);
  const double height = dot(normal, d) - 0.5 * arc.curvature * squared_norm(d);
  return {toward, size, 2 * height / (1 + size)};
}

/// The parameter, not clamped, of the carrier's point nearest to c; infinite opposite to the start
/// on an arc's circle. Not for a vertex.
inline double carrier_parameter(const Site& site, Vec2 c) {
  const Vec2 d = c - site.point;
  const double along = dot(site.direction, d);
  if (!site.is_arc()) return along;
  const Vec2 toward = site.normal() - site.curvature * d;
  const double size = norm(toward), forward = dot(site.normal(), toward);
  if (forward >= 0) return 2 * along / (size + forward);
  // Beyond a quarter turn, the other formula for tan(phi / 2) is accurate.
  const double squared = site.curvature * site.curvature;
  return 2 * (size - forward) / (squared * along);
}

/// Whether the foot on a site moves forward, up to `slack`, from a disk with the centre `from` to
/// one with the centre `to`.
inline bool foot_advances(const Site& site, Vec2 from, Vec2 to, double slack) {
  // Around a vertex, normals turn to the right.
  if (site.is_vertex())
    return cross(to - site.point, from - site.point) >= -slack * distance(site.point, from);
  // Close to an arc's centre, feet are less accurate than centres.
  const double size = std::min(view_of_arc(site, from).size, view_of_arc(site, to).size);
  return (carrier_parameter(site, to) - carrier_parameter(site, from)) * size >= -slack;
}

/// Parameter of the site's point nearest to c.
inline double foot_parameter(const Site& site, Vec2 c) {
  if (!site.is_arc()) return std::clamp(dot(site.direction, c - site.point), 0.0, site.length);
  const double s = carrier_parameter(site, c);
  if (s >= 0 && s <= site.length) return s;
  // Choose the nearer end by the side of the chord's midpoint; distances may be equal up to
  // rounding.
  const Vec2 end = site.end();
  return dot(end - site.point, (c - site.point) + (c - end)) <= 0 ? 0 : site.length;
}

inline Vec2 foot(const Site& site, Vec2 c) { return site.at(foot_parameter(site, c)); }

/// squared_distance() for an arc. Not inline, to keep the code of searches among segments small.
double squared_distance_to_arc(const Site& arc, Vec2 c);

/// Distance from c to the closed site. Error: about two units in the last place of |c - point|.
inline double squared_distance(const Site& site, Vec2 c) {
  if (site.is_arc()) return squared_distance_to_arc(site, c);
  const Vec2 d = c - site.point;
  const double s = std::min(std::max(dot(site.direction, d), 0.0), site.length);
  return squared_norm(d - s * site.direction);
}

/// The distance of a disk from the closed site; negative if the disk reaches over it.
inline double gap(const Site& site, const Disk& disk) {
  return std::sqrt(squared_distance(site, disk.center)) - disk.radius;
}

/// Signed distance to the site's carrier (the whole line or circle, or the vertex), positive on its
/// left.
inline double carrier_distance(const Site& site, Vec2 c) {
  if (site.is_vertex()) return norm(c - site.point);
  return site.is_arc() ? view_of_arc(site, c).distance : cross(site.direction, c - site.point);
}

/// The gradient of carrier_distance(): the unit vector from the foot to c. c must not be a vertex
/// site itself.
inline Vec2 outward(const Site& site, Vec2 c) {
  if (site.is_vertex()) {
    const Vec2 d = c - site.point;
    return (1 / norm(d)) * d;
  }
  if (!site.is_arc()) return site.normal();
  const ArcView view = view_of_arc(site, c);
  return (1 / view.size) * view.toward;
}

}  // namespace medial::site
