#include "verify/boundary_edge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace medial::verify_detail {

Arc::Arc(const BoundaryEdge& edge) : edge_(edge), length_(norm(edge.chord())) {
  const Vec2 half = half_angle(edge.bulge);
  cosine_ = half.x;
  sine_ = half.y;
  chord_ = (1 / length_) * edge.chord();
  start_tangent_ = turned(chord_, half.x, -half.y);
  end_tangent_ = turned(chord_, half.x, half.y);
  curvature_ = 2 * half.y / length_;
}

double Arc::signed_distance(Vec2 p) const {
  const Vec2 from = from_center(p);
  const double carrier = carrier_distance(p, from);
  if (is_beside(p, from)) return carrier;
  const double end = std::min(medial::distance(p, edge_.start), medial::distance(p, edge_.end));
  return carrier < 0 ? -end : end;
}

double distance_to_carrier(Vec2 p, const BoundaryEdge& edge) {
  if (edge.bulge == 0) {
    const Vec2 d = edge.chord(), u = p - edge.start, v = p - edge.end;
    return cross(d, squared_norm(u) <= squared_norm(v) ? u : v) / norm(d);
  }
  return Arc(edge).carrier_distance(p);
}

double distance_to_edge(Vec2 p, const BoundaryEdge& edge) {
  if (edge.bulge == 0) return distance_to_segment(p, edge.start, edge.end);
  return Arc(edge).distance(p);
}

double length_of(const BoundaryEdge& edge) {
  const double chord = norm(edge.chord());
  if (edge.bulge == 0) return chord;
  return chord * (1 + edge.bulge * edge.bulge) * (std::atan(edge.bulge) / edge.bulge);
}

double foot_at(const BoundaryEdge& edge, Vec2 p) {
  const double chord = norm(edge.chord());
  if (edge.bulge == 0) return std::clamp(dot(edge.chord(), p - edge.start) / chord, 0.0, chord);
  const Arc arc(edge);
  if (!arc.is_beside(p))
    return distance(p, edge.start) <= distance(p, edge.end) ? 0 : length_of(edge);
  const double along = std::max(0.0, arc.turned_at(p) / arc.curvature());
  return along < chord ? along : std::min(along, length_of(edge));
}

double opposite_at(const BoundaryEdge& arc, Vec2 p) {
  const Arc on(arc);
  const double angle = on.turned_at(p), curvature = on.curvature();
  const double opposite = angle * curvature > 0
                              ? angle - std::copysign(std::numbers::pi, angle)
                              : angle + std::copysign(std::numbers::pi, curvature);
  return opposite / curvature;
}

Vec2 point_at(const BoundaryEdge& edge, double length) {
  const double whole = length_of(edge);
  if (length <= 0) return edge.start;
  if (length >= whole) return edge.end;
  const bool from_start = length <= 0.5 * whole;
  const double way = from_start ? length : whole - length;
  if (edge.bulge == 0) {
    const Vec2 chord = (1 / norm(edge.chord())) * edge.chord();
    return from_start ? edge.start + way * chord : edge.end - way * chord;
  }
  const Arc arc(edge);
  const double half = 0.5 * way * arc.curvature();
  const double chord = way * (std::sin(half) / half);
  if (from_start)
    return edge.start + chord * turned(arc.start_tangent(), std::cos(half), std::sin(half));
  return edge.end - chord * turned(arc.end_tangent(), std::cos(half), -std::sin(half));
}

double foot_slack(const BoundaryEdge& edge, Vec2 p, double slack) {
  if (edge.bulge == 0) return slack;
  const double moved = slack / norm(Arc(edge).from_center(p));
  return moved < norm(edge.chord()) ? moved : std::min(moved, length_of(edge));
}

}  // namespace medial::verify_detail
