#include "verify/boundary_edge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/wide.h"

namespace medial::verify_detail {

Arc::Arc(const BoundaryEdge& edge)
    : edge_(edge), chord_length_(norm(edge.chord())), length_(length_of(edge)) {
  const Vec2 half = half_angle(edge.bulge);
  cosine_ = half.x;
  sine_ = half.y;
  chord_ = (1 / chord_length_) * edge.chord();
  start_tangent_ = turned(chord_, half.x, -half.y);
  end_tangent_ = turned(chord_, half.x, half.y);
  curvature_ = 2 * half.y / chord_length_;
}

double Arc::signed_distance(Vec2 p) const {
  const Vec2 from = from_center(p);
  const double carrier = carrier_distance(p, from);
  if (is_beside(p, from)) return carrier;
  const double end = std::min(medial::distance(p, edge_.start), medial::distance(p, edge_.end));
  return carrier < 0 ? -end : end;
}

MEDIAL_WIDE Pair Arc::signed_distances(const Pair& x, const Pair& y) const {
  const Pair ux = x - edge_.start.x, uy = y - edge_.start.y;
  const Pair vx = x - edge_.end.x, vy = y - edge_.end.y;
  const Pair from_x = curvature_ * (0.5 * (ux + vx)) + cosine_ * chord_.y;
  const Pair from_y = curvature_ * (0.5 * (uy + vy)) - cosine_ * chord_.x;
  const Pair to_start = ux * ux + uy * uy, to_end = vx * vx + vy * vy;
  const Pairwise first = to_start <= to_end;
  const Pair across = chord_.x * (first ? uy : vy) - chord_.y * (first ? ux : vx);
  const double scale = 1 / chord_length_;
  const Pair along = (scale * ux) * vx + (scale * uy) * vy;
  const Pair carrier =
      2 * (cosine_ * across - sine_ * along) / (1 + root_of(from_x * from_x + from_y * from_y));
  const Pairwise beside = (start_tangent_.x * ux + start_tangent_.y * uy >= 0) &
                          (end_tangent_.x * vx + end_tangent_.y * vy <= 0) &
                          (chord_.x * from_y - chord_.y * from_x <= 0);
  if (all(beside)) return carrier;
  return beside ? carrier : with_sign_of(root_of(smaller(to_start, to_end)), carrier);
}

double Arc::foot_at(Vec2 p) const {
  if (!is_beside(p))
    return medial::distance(p, edge_.start) <= medial::distance(p, edge_.end) ? 0 : length_;
  return std::min(std::max(0.0, turned_at(p) / curvature_), length_);
}

double Arc::opposite_at(Vec2 p) const {
  const double angle = turned_at(p);
  const double opposite = angle * curvature_ > 0
                              ? angle - std::copysign(std::numbers::pi, angle)
                              : angle + std::copysign(std::numbers::pi, curvature_);
  return opposite / curvature_;
}

Vec2 Arc::point_at(double length) const {
  if (length <= 0) return edge_.start;
  if (length >= length_) return edge_.end;
  const bool from_start = length <= 0.5 * length_;
  const double way = from_start ? length : length_ - length;
  const double half = 0.5 * way * curvature_;
  const double chord = way * (std::sin(half) / half);
  if (from_start)
    return edge_.start + chord * turned(start_tangent_, std::cos(half), std::sin(half));
  return edge_.end - chord * turned(end_tangent_, std::cos(half), -std::sin(half));
}

double Arc::foot_slack(Vec2 p, double slack) const {
  return std::min(slack / norm(from_center(p)), length_);
}

EdgeArcs::EdgeArcs(std::span<const BoundaryEdge> edges) {
  const auto is_arc = [](const BoundaryEdge& edge) { return edge.bulge != 0; };
  const auto count = static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), is_arc));
  if (count == 0) return;
  arcs_.reserve(count);
  place_.reserve(edges.size());
  for (const BoundaryEdge& edge : edges) {
    place_.push_back(static_cast<std::uint32_t>(arcs_.size()));
    if (is_arc(edge)) arcs_.emplace_back(edge);
  }
}

Vec2 Track::point_at(double length) const {
  if (arc_ != nullptr) return arc_->point_at(length);
  if (length <= 0) return edge_.start;
  if (length >= length_) return edge_.end;
  const bool from_start = length <= 0.5 * length_;
  const Vec2 chord = (1 / length_) * edge_.chord();
  return from_start ? edge_.start + length * chord : edge_.end - (length_ - length) * chord;
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
  return edge.bulge == 0 ? Track(edge).foot_at(p) : Arc(edge).foot_at(p);
}

double opposite_at(const BoundaryEdge& arc, Vec2 p) { return Arc(arc).opposite_at(p); }

Vec2 point_at(const BoundaryEdge& edge, double length) {
  return edge.bulge == 0 ? Track(edge).point_at(length) : Arc(edge).point_at(length);
}

}  // namespace medial::verify_detail
