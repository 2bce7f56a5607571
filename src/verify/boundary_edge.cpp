#include "verify/boundary_edge.h"

#include <algorithm>
#include <cmath>

#include "base/wide.h"

namespace medial::verify_detail {

Arc::Arc(const BoundaryEdge& edge) : edge_(edge), chord_length_(norm(edge.chord())) {
  const Vec2 half = half_angle(edge.bulge);
  cosine_ = half.x;
  sine_ = half.y;
  chord_ = (1 / chord_length_) * edge.chord();
  start_tangent_ = turned(chord_, half.x, -half.y);
  end_tangent_ = turned(chord_, half.x, half.y);
  curvature_ = 2 * half.y / chord_length_;
  whole_way_ = 4 * edge.bulge / curvature_;
}

double Arc::signed_distance(Vec2 p) const {
  const Vec2 from = from_center(p);
  if (is_beside(p, from)) return carrier_distance(p, from);
  const Vec2 u = p - edge_.start, v = p - edge_.end;
  const bool first = squared_norm(u) <= squared_norm(v);
  return std::copysign(norm(first ? u : v),
                       first ? cross(start_tangent_, u) : cross(end_tangent_, v));
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
  const Pair ahead = first ? start_tangent_.x * uy - start_tangent_.y * ux
                           : end_tangent_.x * vy - end_tangent_.y * vx;
  return beside ? carrier : with_sign_of(root_of(smaller(to_start, to_end)), ahead);
}

/// tan(a / 4) with the angle a, in (-pi, pi], turned up to the point of the circle nearest to p.
double Arc::quarter_tangent_at(Vec2 p) const {
  const Vec2 from = from_center(p);
  const double radius = norm(from), sine = curvature_ * dot(start_tangent_, p - edge_.start);
  const double cosine = -dot(left_of(start_tangent_), from);
  if (cosine >= 0) {
    const double half = sine / (radius + cosine);  // tan(a / 2)
    return radius > 0 ? half / (1 + std::sqrt(1 + half * half)) : 0;
  }
  const double inverse = sine / (radius - cosine);
  return std::copysign(1 / (std::abs(inverse) + std::sqrt(1 + inverse * inverse)), inverse);
}

double Arc::way_to_foot(Vec2 p) const {
  // Next to the centre the distances from both ends are one but for their last digits.
  if (!is_beside(p)) return dot(chord_, (p - edge_.start) + (p - edge_.end)) <= 0 ? 0 : whole_way_;
  return std::min(std::max(0.0, 4 / curvature_ * quarter_tangent_at(p)), whole_way_);
}

double Arc::way_to_opposite(Vec2 p) const {
  // A half circle forward or back: tan((a + pi) / 4) or tan((a - pi) / 4), whichever is ahead
  // first.
  const double t = quarter_tangent_at(p);
  const double ahead = (1 + t) / (1 - t), behind = (t - 1) / (1 + t);
  const bool back = t * curvature_ > 0;
  return 4 / curvature_ * ((curvature_ > 0) != back ? ahead : behind);
}

Vec2 Arc::point_at(double way) const {
  if (way <= 0) return edge_.start;
  if (way >= whole_way_) return edge_.end;
  // From the nearer end: half of the angle from there has the tangent 2 t / (1 - t^2).
  const double from_start = 0.25 * way * curvature_;
  const double from_end = (edge_.bulge - from_start) / (1 + edge_.bulge * from_start);
  const bool by_start = std::abs(from_start) <= std::abs(from_end);
  const double t = by_start ? from_start : from_end, scale = 1 / (1 + t * t);
  const double chord = (by_start ? way : 4 * t / curvature_) * scale;
  const double cosine = (1 - t) * (1 + t) * scale, sine = 2 * t * scale;
  if (by_start) return edge_.start + chord * turned(start_tangent_, cosine, sine);
  return edge_.end - chord * turned(end_tangent_, cosine, -sine);
}

double Arc::length_at(double way) const {
  return 4 / curvature_ * std::atan(0.25 * way * curvature_);
}
double Arc::way_at(double length) const {
  return 4 / curvature_ * std::tan(0.25 * length * curvature_);
}

double Arc::foot_slack(Vec2 p, double slack) const {
  return std::min(slack / norm(from_center(p)), whole_way_);
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

Vec2 Track::point_at(double way) const {
  if (arc_ != nullptr) return arc_->point_at(way);
  if (way <= 0) return edge_.start;
  if (way >= whole_way_) return edge_.end;
  const bool from_start = way <= 0.5 * whole_way_;
  const Vec2 chord = (1 / whole_way_) * edge_.chord();
  return from_start ? edge_.start + way * chord : edge_.end - (whole_way_ - way) * chord;
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
  if (edge.bulge == 0) return Track(edge).way_to_foot(p);
  const Arc arc(edge);
  return arc.length_at(arc.way_to_foot(p));
}

double opposite_at(const BoundaryEdge& arc, Vec2 p) {
  const Arc known(arc);
  return known.length_at(known.way_to_opposite(p));
}

Vec2 point_at(const BoundaryEdge& edge, double length) {
  if (edge.bulge == 0) return Track(edge).point_at(length);
  const Arc arc(edge);
  return length < length_of(edge) ? arc.point_at(arc.way_at(length)) : edge.end;
}

}  // namespace medial::verify_detail
