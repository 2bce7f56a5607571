#include "verify/boundary_edge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace medial::verify_detail {
namespace {

/// An edge as its directions say it.
struct Directions {
  double length;  ///< of the chord
  Vec2 half;      ///< cosine and sine of half of its angle
  Vec2 chord;     ///< unit vector
  Vec2 start_tangent() const { return turned(chord, half.x, -half.y); }
  Vec2 end_tangent() const { return turned(chord, half.x, half.y); }
  double curvature() const { return 2 * half.y / length; }
};

Directions directions_of(const BoundaryEdge& edge) {
  const Vec2 d = edge.chord();
  const double length = norm(d);
  return {length, half_angle(edge.bulge), (1 / length) * d};
}

/// curvature * (p - centre): from the centre to p, in radii, whatever the radius.
Vec2 from_center(const Directions& directions, const BoundaryEdge& edge, Vec2 p) {
  const Vec2 middle = 0.5 * ((p - edge.start) + (p - edge.end));
  return directions.curvature() * middle - directions.half.x * left_of(directions.chord);
}

/// Whether the nearest point of the carrier to p lies on the edge: p between the normals at its
/// ends and, of an arc, on its side of the centre. Next to the centre of a short arc the normals
/// alone would leave that side to rounding.
bool is_beside(const Directions& directions, const BoundaryEdge& edge, Vec2 p) {
  return dot(directions.start_tangent(), p - edge.start) >= 0 &&
         dot(directions.end_tangent(), p - edge.end) <= 0 &&
         dot(left_of(directions.chord), from_center(directions, edge, p)) <= 0;
}

/// The angle by which the arc's circle has turned, from the start, at the point nearest to p.
double turned_at(const Directions& directions, const BoundaryEdge& edge, Vec2 p) {
  const Vec2 tangent = directions.start_tangent();
  const double sine = directions.curvature() * dot(tangent, p - edge.start);
  const double cosine = -dot(left_of(tangent), from_center(directions, edge, p));
  return std::atan2(sine, cosine);
}

double carrier_distance(const Directions& directions, const BoundaryEdge& edge, Vec2 p) {
  const Vec2 u = p - edge.start, v = p - edge.end;
  const double across = cross(directions.chord, squared_norm(u) <= squared_norm(v) ? u : v);
  const double along = dot((1 / directions.length) * u, v);
  const double power = directions.half.x * across - directions.half.y * along;
  return 2 * power / (1 + norm(from_center(directions, edge, p)));
}

}  // namespace

double distance_to_carrier(Vec2 p, const BoundaryEdge& edge) {
  if (edge.bulge == 0) {
    const Vec2 d = edge.chord(), u = p - edge.start, v = p - edge.end;
    return cross(d, squared_norm(u) <= squared_norm(v) ? u : v) / norm(d);
  }
  return carrier_distance(directions_of(edge), edge, p);
}

double distance_to_edge(Vec2 p, const BoundaryEdge& edge) {
  if (edge.bulge == 0) return distance_to_segment(p, edge.start, edge.end);
  const Directions directions = directions_of(edge);
  if (is_beside(directions, edge, p)) return std::abs(carrier_distance(directions, edge, p));
  return std::min(distance(p, edge.start), distance(p, edge.end));
}

double length_of(const BoundaryEdge& edge) {
  const double chord = norm(edge.chord());
  if (edge.bulge == 0) return chord;
  return chord * (1 + edge.bulge * edge.bulge) * (std::atan(edge.bulge) / edge.bulge);
}

double foot_at(const BoundaryEdge& edge, Vec2 p) {
  const double length = length_of(edge);
  if (edge.bulge == 0) return std::clamp(dot(edge.chord(), p - edge.start) / length, 0.0, length);
  const Directions directions = directions_of(edge);
  if (!is_beside(directions, edge, p))
    return distance(p, edge.start) <= distance(p, edge.end) ? 0 : length;
  return std::clamp(turned_at(directions, edge, p) / directions.curvature(), 0.0, length);
}

double opposite_at(const BoundaryEdge& arc, Vec2 p) {
  const Directions directions = directions_of(arc);
  const double angle = turned_at(directions, arc, p), curvature = directions.curvature();
  const double opposite = angle * curvature > 0
                              ? angle - std::copysign(std::numbers::pi, angle)
                              : angle + std::copysign(std::numbers::pi, curvature);
  return opposite / curvature;
}

Vec2 point_at(const BoundaryEdge& edge, double length) {
  const double whole = length_of(edge);
  if (length <= 0) return edge.start;
  if (length >= whole) return edge.end;
  const Directions directions = directions_of(edge);
  const bool from_start = length <= 0.5 * whole;
  const double way = from_start ? length : whole - length;
  if (edge.bulge == 0)
    return from_start ? edge.start + way * directions.chord : edge.end - way * directions.chord;
  const double half = 0.5 * way * directions.curvature();
  const double chord = way * (std::sin(half) / half);
  if (from_start)
    return edge.start + chord * turned(directions.start_tangent(), std::cos(half), std::sin(half));
  return edge.end - chord * turned(directions.end_tangent(), std::cos(half), -std::sin(half));
}

double foot_slack(const BoundaryEdge& edge, Vec2 p, double slack) {
  if (edge.bulge == 0) return slack;
  const double radii = norm(from_center(directions_of(edge), edge, p));
  return std::min(slack / radii, length_of(edge));
}

}  // namespace medial::verify_detail
