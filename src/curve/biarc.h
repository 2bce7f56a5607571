#pragma once

#include <optional>

#include "curve/bezier.h"

namespace medial::curve {

/// A circular arc as its end points and bulge (see Ring), which keeps its digits however large its
/// radius is.
struct Arc {
  Vec2 begin;
  Vec2 end;
  double bulge = 0;
};

/// The bulge of the arc over `chord` that leaves along the unit vector `tangent`, and of the one
/// that arrives along it. Relative error: some units in the last place over the angle between them.
double bulge_leaving(Vec2 tangent, Vec2 chord);
double bulge_arriving(Vec2 chord, Vec2 tangent);
/// Signed curvature, and unit tangents at both ends.
double curvature(const Arc& arc);
Vec2 tangent_at_begin(const Arc& arc);
Vec2 tangent_at_end(const Arc& arc);

/// The circle of the joints of all biarcs between two stations, by the station that it begins at.
struct JointCircle {
  Vec2 base;
  Vec2 direction;  ///< unit length
  double curvature = 0;

  /// How far p is off the circle, for points next to it; positive on its right.
  double off(Vec2 p) const {
    const Vec2 c = p - base;
    return 0.5 * curvature * squared_norm(c) - cross(direction, c);
  }
  /// The derivative of off().
  Vec2 normal(Vec2 p) const { return curvature * (p - base) - left_of(direction); }
};
JointCircle joint_circle(const Station& a, const Station& b);

/// The joint of the spiral biarc from `a` to `b` (Algorithm 1): where the osculating circle at the
/// end of the larger curvature meets the joint circle again. Where the curvatures are those of a
/// spiral the joint is an ordinary point between them; nothing is promised for others.
///
/// Not by centres, which are far away where curvatures are small, but by curvatures. With H the end
/// of larger curvature k and tangent v, d the way from there to the other end and v1 the tangent
/// there (both reversed where H is the second end), the joint circle leaves H in the direction
/// m of v + 2 (v1.d) d / |d|^2 - v1 with curvature q = 2 (m x d) / |d|^2. Points c on both circles
/// satisfy k |c|^2 = 2 (v x c) and q |c|^2 = 2 (m x c), so that c is a multiple of q v - k m.
Vec2 spiral_joint(const Station& a, const Station& b);

/// The joint of the biarc whose other arc is an osculating circle, that at the end of the smaller
/// curvature.
Vec2 flat_joint(const Station& a, const Station& b);

/// The joint between the other two, halfway if no tangent is tilted: the curvatures of both arcs
/// are then between those of the ends. Along a short spiral it is where the biarc's error is least,
/// less than a third of the spiral biarc's. Where curvature changes by d over the way c, between
/// tilts p d c and q d c, that joint is at 1/2 + 3 (p - q) of the way, and the others, whose arcs
/// osculate at either end, at (1/6 - p - q) / (1/2 + p - q) and (1/3 + 2 q) / (1/2 + q - p).
/// `circle`: joint_circle(a, b).
Vec2 balanced_joint(const Station& a, const Station& b, const JointCircle& circle);

/// The joint moved by whole steps of a grid to a grid point next to the joint circle: by at most
/// about `reach`, until it is off the circle by no more than a rounding of the chord.
///
/// Off the circle the arcs' tangents do not meet, along it they do: a joint that is merely rounded
/// to the grid leaves an angle of the grid's size over the chord. What is sought are two whole
/// numbers of steps whose effects on off() add up to it; Euclid's algorithm gives ever longer steps
/// of ever smaller effect. Requires a joint on the grid.
Vec2 settle_joint(const JointCircle& circle, Vec2 joint, Vec2 grid, double reach);

/// Two arcs with a common tangent at their joint.
struct Biarc {
  Arc first;
  Arc second;
};
/// The biarc between the stations with this joint. Its first arc leaves along a's tangent exactly
/// and its second arrives along b's; at the joint, tangents differ by what the joint is off the
/// joint circle, over the length of the chords.
Biarc make_biarc(const Station& a, Vec2 joint, const Station& b);

/// Where the normal of a biarc at its joint, with this tangent, meets the curve (the joint's
/// projection from the arcs' centres): the parameter, or nothing where it meets the curve more
/// often or not at all.
std::optional<double> projected_joint(const Bezier& curve, Vec2 joint, Vec2 tangent);

/// An upper bound on the Hausdorff distance between a curve and an arc with its end points on the
/// normals of the curve's ends: infinite where the bound does not hold, because the curve leaves
/// the arc's sector. The signed distance d from the arc's circle satisfies F = 2 d + k d^2 with
/// F = k |c|^2 - 2 (v x c), c the way from the arc's end with the tangent v to a point of the
/// curve: a polynomial of twice the curve's degree, bounded by its Bernstein coefficients. It does
/// not cancel for circles however large. Inside the sector each point of the arc is the foot of
/// some point of the curve, so that the bound holds both ways. Control points may be off by
/// `rounding`.
double certified_error(const Bezier& curve, const Arc& arc, double rounding);
/// The same of a biarc, each arc against its part of the curve, which is cut at the projection of
/// the joint.
double certified_error(const Bezier& curve, const Biarc& biarc, double rounding);

}  // namespace medial::curve
