#pragma once

#include <optional>

#include "curve/bezier.h"

namespace medial::curve {

/// A circular arc by its end points and bulge (see Ring), which is accurate for any radius.
struct Arc {
  Vec2 begin;
  Vec2 end;
  double bulge = 0;
};

/// The bulge of the arc over `chord` that leaves along the unit vector `tangent`, and of the one
/// that arrives along it. Relative error: a few units in the last place, divided by the angle
/// between them.
double bulge_leaving(Vec2 tangent, Vec2 chord);
double bulge_arriving(Vec2 chord, Vec2 tangent);
/// Signed curvature, and unit tangents at both ends.
double curvature(const Arc& arc);
Vec2 tangent_at_begin(const Arc& arc);
Vec2 tangent_at_end(const Arc& arc);

/// The circle of the joints of all biarcs between two stations, by the station at which it begins.
struct JointCircle {
  Vec2 base;
  Vec2 direction;  ///< unit length
  double curvature = 0;

  /// The signed distance of p, which must be close to the circle; positive on the circle's right.
  double off(Vec2 p) const {
    const Vec2 c = p - base;
    return 0.5 * curvature * squared_norm(c) - cross(direction, c);
  }
  /// The derivative of off().
  Vec2 normal(Vec2 p) const { return curvature * (p - base) - left_of(direction); }
};
JointCircle joint_circle(const Station& a, const Station& b);

/// The joint of the spiral biarc from `a` to `b` (Algorithm 1): the second intersection of the
/// joint circle with the osculating circle at the end of larger curvature. If the curvatures are
/// those of a spiral, the joint is an ordinary point between the stations; otherwise, it is
/// unspecified.
///
/// Computed from curvatures, because centres are far away if curvatures are small. Let H be the end
/// of larger curvature k, with the tangent v; d the vector from H to the other end, and v1 the
/// tangent there (both reversed if H is the second end). The joint circle leaves H in the direction
/// m of v + 2 (v1.d) d / |d|^2 - v1 with the curvature q = 2 (m x d) / |d|^2. Points c on both
/// circles satisfy k |c|^2 = 2 (v x c) and q |c|^2 = 2 (m x c), so c is a multiple of q v - k m.
Vec2 spiral_joint(const Station& a, const Station& b);

/// The joint of the biarc whose other arc lies on an osculating circle, at the end of smaller
/// curvature.
Vec2 flat_joint(const Station& a, const Station& b);

/// The joint between the other two, halfway if no tangent is tilted; then the curvatures of both
/// arcs are between those of the ends. Along a short spiral, this joint minimises the biarc's
/// error, to less than a third of the spiral biarc's. If the curvature changes by d over the length
/// c, between tilts p d c and q d c, this joint is at the fraction 1/2 + 3 (p - q) of the length,
/// and the joints of the biarcs that osculate at either end are at (1/6 - p - q) / (1/2 + p - q)
/// and (1/3 + 2 q) / (1/2 + q - p). `circle`: joint_circle(a, b).
Vec2 balanced_joint(const Station& a, const Station& b, const JointCircle& circle);

/// The joint moved by whole steps of a grid to a grid point next to the joint circle: by at most
/// about `reach`, until it is off the circle by no more than a rounding of the chord.
///
/// The arcs' tangents agree at a joint on the circle, but not off the circle: a joint that is only
/// rounded to the grid leaves an angle of the grid's spacing divided by the chord. The function
/// finds two integer numbers of steps whose effects on off() cancel it; Euclid's algorithm yields
/// ever longer steps of ever smaller effect. Requires a joint on the grid.
Vec2 settle_joint(const JointCircle& circle, Vec2 joint, Vec2 grid, double reach);

/// Two arcs with a common tangent at their joint.
struct Biarc {
  Arc first;
  Arc second;
};
/// The biarc between the stations with this joint. Its first arc leaves exactly along a's tangent,
/// and its second arrives exactly along b's. At the joint, the tangents differ by the joint's
/// distance from the joint circle, divided by the length of the chords.
Biarc make_biarc(const Station& a, Vec2 joint, const Station& b);

/// The parameter at which the normal of a biarc at its joint, with this tangent, meets the curve
/// (the joint's projection from the arcs' centres); nothing if it meets the curve not exactly once.
std::optional<double> projected_joint(const Bezier& curve, Vec2 joint, Vec2 tangent);

/// An upper bound on the Hausdorff distance between a curve and an arc whose end points lie on the
/// normals of the curve's ends; infinite if the curve leaves the arc's sector, where the bound does
/// not hold. The signed distance d from the arc's circle satisfies F = 2 d + k d^2 with F = k |c|^2
/// - 2 (v x c), where c is the vector from the arc's end with the tangent v to a point of the
/// curve. F is a polynomial of twice the curve's degree, bounded by its Bernstein coefficients,
/// without cancellation for circles of any size. Inside the sector, each point of the arc is the
/// foot of some point of the curve, so the bound holds in both directions. Control points may be
/// off by `rounding`.
double certified_error(const Bezier& curve, const Arc& arc, double rounding);
/// The same for a biarc. Compares each arc with its part of the curve, which is split at the
/// projection of the joint.
double certified_error(const Bezier& curve, const Biarc& biarc, double rounding);

}  // namespace medial::curve
