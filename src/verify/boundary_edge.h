#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/arc.h"
#include "base/pair.h"
#include "medial/axis.h"

namespace medial::verify_detail {

/// A boundary edge, straight or an arc of at most a half circle, from its ends and its bulge alone:
/// formulas that share nothing with those of the engines' sites, which begin at a tangent.
using BoundaryEdge = BulgeArc;

inline BoundaryEdge edge_of(const Site& site) { return {site.start, site.end, site.bulge}; }

/// A closed segment that distances of many places are measured from. Coordinates are subtracted
/// before anything is multiplied, and the nearer end is the origin: the error is below two units in
/// the last place of half the segment's length plus the distance.
class Segment {
 public:
  Segment(Vec2 a, Vec2 b) : a_(a), b_(b), along_(b - a), length_(norm(along_)) {}

  double length() const { return length_; }
  double distance(Vec2 p) const { return std::abs(signed_distance(p)); }
  /// signed_distance() of two places.
  Pair signed_distances(const Pair& x, const Pair& y) const {
    const Pair from_a_x = x - a_.x, from_a_y = y - a_.y, from_b_x = x - b_.x, from_b_y = y - b_.y;
    const Pair along_a = from_a_x * along_.x + from_a_y * along_.y;
    const Pair along_b = -(from_b_x * along_.x + from_b_y * along_.y);
    const Pair nearer_x = along_a <= along_b ? from_a_x : from_b_x;
    const Pair nearer_y = along_a <= along_b ? from_a_y : from_b_y;
    const Pair across = along_.x * nearer_y - along_.y * nearer_x, within = across / length_;
    const Pairwise beyond_a = along_a <= 0, beyond = beyond_a | (along_b <= 0);
    if (!any(beyond)) return within;
    const Pair end_x = beyond_a ? from_a_x : from_b_x, end_y = beyond_a ? from_a_y : from_b_y;
    return beyond ? with_sign_of(root_of(end_x * end_x + end_y * end_y), across) : within;
  }
  Pair distances_from_start(const Pair& x, const Pair& y) const {
    const Pair from_x = x - a_.x, from_y = y - a_.y;
    return root_of(from_x * from_x + from_y * from_y);
  }
  /// Negative where p lies on the right.
  double signed_distance(Vec2 p) const {
    const Vec2 from_a = p - a_, from_b = p - b_;
    const double along_a = dot(from_a, along_), along_b = -dot(from_b, along_);
    const double across = cross(along_, along_a <= along_b ? from_a : from_b);
    const double sign = across < 0 ? -1 : 1;
    if (along_a <= 0) return sign * norm(from_a);
    if (along_b <= 0) return sign * norm(from_b);
    return across / length_;
  }

 private:
  Vec2 a_, b_, along_;
  double length_;
};
inline double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) { return Segment(a, b).distance(p); }

/// An arc that distances of many places are measured from, by its directions. A place on it is
/// known by the way from its start, 4 tan(a / 4) / k with the angle a turned so far: as good as a
/// length, which it exceeds by little, but without trigonometry.
class Arc {
 public:
  explicit Arc(const BoundaryEdge& edge);

  Vec2 start_tangent() const { return start_tangent_; }
  Vec2 end_tangent() const { return end_tangent_; }
  double curvature() const { return curvature_; }
  double whole_way() const { return whole_way_; }

  /// curvature() * (p - centre): from the centre to p, in radii, whatever the radius.
  Vec2 from_center(Vec2 p) const {
    const Vec2 middle = 0.5 * ((p - edge_.start) + (p - edge_.end));
    return curvature_ * middle - cosine_ * left_of(chord_);
  }
  /// Whether p lies on the arc's side of the circle's centre.
  bool is_in_front(Vec2 p) const { return dot(left_of(chord_), from_center(p)) <= 0; }
  /// Whether the nearest point of the circle to p lies on the arc.
  bool is_beside(Vec2 p) const { return is_beside(p, from_center(p)); }
  /// Of the whole circle, positive on its left: see distance_to_carrier().
  double carrier_distance(Vec2 p) const { return carrier_distance(p, from_center(p)); }
  /// The distance from the arc, negative on the right of its circle, or, if an end is nearest to p,
  /// on the right of the tangent there: a disk that touches an end may be larger than the circle.
  double signed_distance(Vec2 p) const;
  /// The same of two places.
  Pair signed_distances(const Pair& x, const Pair& y) const;
  double distance(Vec2 p) const { return std::abs(signed_distance(p)); }
  /// The way to the point nearest to p, and to the farthest one of the circle: beyond the arc's
  /// ends where that is none of the arc's.
  double way_to_foot(Vec2 p) const;
  double way_to_opposite(Vec2 p) const;
  /// The point at a way; exactly the ends at and beyond them.
  Vec2 point_at(double way) const;
  double length_at(double way) const;
  double way_at(double length) const;
  /// How far rounding may move the foot of p along the arc if it moves p by `slack`: without bound
  /// where p is the centre of the circle.
  double foot_slack(Vec2 p, double slack) const;

 private:
  /// p lies between the normals at the ends and on the arc's side of the centre. Next to the centre
  /// of a short arc the normals alone would leave that side to rounding.
  bool is_beside(Vec2 p, Vec2 from) const {
    return dot(start_tangent_, p - edge_.start) >= 0 && dot(end_tangent_, p - edge_.end) <= 0 &&
           dot(left_of(chord_), from) <= 0;
  }
  double carrier_distance(Vec2 p, Vec2 from) const {
    const Vec2 u = p - edge_.start, v = p - edge_.end;
    const double across = cross(chord_, squared_norm(u) <= squared_norm(v) ? u : v);
    const double along = dot((1 / chord_length_) * u, v);
    return 2 * (cosine_ * across - sine_ * along) / (1 + norm(from));
  }

  double quarter_tangent_at(Vec2 p) const;

  BoundaryEdge edge_;
  double chord_length_;
  Vec2 chord_;            ///< unit vector
  double cosine_, sine_;  ///< of half of its angle
  Vec2 start_tangent_, end_tangent_;
  double curvature_, whole_way_;
};

/// The arcs among some edges.
class EdgeArcs {
 public:
  EdgeArcs() = default;
  explicit EdgeArcs(std::span<const BoundaryEdge> edges);

  bool empty() const { return arcs_.empty(); }
  std::size_t size() const { return arcs_.size(); }
  /// Of an edge that is not straight.
  const Arc& operator[](std::size_t edge) const { return arcs_[place_[edge]]; }

 private:
  std::vector<Arc> arcs_;
  std::vector<std::uint32_t> place_;  ///< of each edge's arc; none if all are straight
};

/// Distance from p to the edge's whole line or circle, positive on its left. By the power of the
/// point: with u and v the vectors from the ends and 2 a half of the arc's angle, the circle is
/// where sin 2a (u.v) = cos 2a (u x v). The error is a few units in the last place of the edge's
/// length plus the distance to its nearer end.
double distance_to_carrier(Vec2 p, const BoundaryEdge& edge);

/// Distance from p to the closed edge.
double distance_to_edge(Vec2 p, const BoundaryEdge& edge);

double length_of(const BoundaryEdge& edge);

/// The length along the edge, from its start, to the point nearest to p.
double foot_at(const BoundaryEdge& edge, Vec2 p);

/// The length along the arc to the point opposite to that: the farthest one of its circle; beyond
/// the arc's ends where that is none of the arc's.
double opposite_at(const BoundaryEdge& arc, Vec2 p);

/// The point at a length along the edge; exactly the ends at and beyond them.
Vec2 point_at(const BoundaryEdge& edge, double length);

/// An edge with what is known of it, if it is an arc. Ways along straight edges are lengths.
class Track {
 public:
  explicit Track(const BoundaryEdge& edge, const Arc* arc = nullptr)
      : edge_(edge),
        arc_(arc),
        whole_way_(arc != nullptr ? arc->whole_way() : norm(edge.chord())) {}

  const BoundaryEdge& edge() const { return edge_; }
  bool is_straight() const { return arc_ == nullptr; }
  double whole_way() const { return whole_way_; }
  double way_to_foot(Vec2 p) const {
    if (arc_ != nullptr) return arc_->way_to_foot(p);
    return std::clamp(way_on_line(p), 0.0, whole_way_);
  }
  /// Of a straight edge, which may be longer.
  double way_on_line(Vec2 p) const { return dot(edge_.chord(), p - edge_.start) / whole_way_; }
  /// Of an arc.
  double way_to_opposite(Vec2 p) const { return arc_->way_to_opposite(p); }
  Vec2 point_at(double way) const;
  double length_at(double way) const { return arc_ != nullptr ? arc_->length_at(way) : way; }
  /// Of an arc: Arc::foot_slack(), as a way from there.
  double way_slack(Vec2 p, double slack, double way) const {
    const double quarter = 0.25 * way * arc_->curvature();
    return (1 + quarter * quarter) * arc_->foot_slack(p, slack);
  }

 private:
  BoundaryEdge edge_;
  const Arc* arc_;
  double whole_way_;
};

}  // namespace medial::verify_detail
