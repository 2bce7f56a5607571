#pragma once

#include <utility>
#include <vector>

#include "medial/axis.h"

namespace medial {

/// An edge of the axis as a curve, with control points relative to the first one. Coordinates are
/// subtracted before anything is multiplied, so no digits are lost far from the origin.
struct Curve {
  Vec2 origin;  ///< centre of the first disk
  Vec2 end;     ///< of the last disk
  Vec2 p1;      ///< control - origin
  Vec2 p2;      ///< end - origin
  double r0 = 0, r1 = 0, r2 = 0;
  double weight = 1;

  Curve(const Disk& from, const Disk& control, const Disk& to, double control_weight)
      : origin(from.center),
        end(to.center),
        p1(control.center - from.center),
        p2(to.center - from.center),
        r0(from.radius),
        r1(control.radius),
        r2(to.radius),
        weight(control_weight) {}

  /// The disk at t in [0, 1], which is exact at 0 and 1. Error: a few units in the last place of
  /// the control polygon's size, plus the rounding of the centre's coordinates.
  Disk at(double t) const { return at(1 - t, t); }
  /// The same from both s = 1 - t and t. If the weight is large, most of the curve is at parameters
  /// next to 0 and 1, and 1 - t would be inaccurate there.
  Disk at(double s, double t) const;
  /// at(t).center - origin, without the rounding of the addition.
  Vec2 offset(double t) const;

  /// The same curve from t0 to t1: exact, its weight positive. Requires t0 and t1 in [0, 1].
  Curve part(double t0, double t1) const {
    const auto [control, control_weight] = control_between(t0, t1);
    return {at(t0), control, at(t1), control_weight};
  }
  /// The control point of that part, and its weight.
  std::pair<Disk, double> control_between(double t0, double t1) const;

  /// The first derivative by t of offset().
  Vec2 velocity(double t) const;
  /// First and second derivatives by t of offset() and of the radius.
  struct Derivatives {
    Vec2 first, second;
    double radius_first = 0, radius_second = 0;
  };
  Derivatives derivatives(double t) const;

  /// Whether the centres lie on a straight line, up to rounding: for two segments or two vertices,
  /// and in some cases with arcs. Otherwise, they lie on a conic.
  bool straight() const;

  /// Length in the plane from 0 to t. Closed forms for a line and for a parabola, Gauss quadrature
  /// for an ellipse or a hyperbola. Relative error below 1e-13.
  double length(double t = 1) const;
  /// The t at which length(t) == s, for s in [0, length()].
  double at_length(double s) const;

  /// The t in [0, 1] of the point nearest to p in the plane.
  double nearest(Vec2 p) const;

  /// The area between the curve and its chord, positive if the control point is on the right.
  double area_beside_chord() const;
};

/// Appends the t in (0, 1) where a (1-t)^2 + 2 b t (1-t) + c t^2 is 0, without cancellation.
void add_roots(double a, double b, double c, std::vector<double>& out);

inline Curve curve_of(const MedialAxis& axis, const Edge& edge) {
  return {axis.nodes[edge.node[0]].disk, edge.control, axis.nodes[edge.node[1]].disk, edge.weight};
}

}  // namespace medial
