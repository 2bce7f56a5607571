#pragma once

#include "base/arc.h"
#include "medial/axis.h"

namespace medial::verify_detail {

/// A boundary edge, straight or an arc of at most a half circle, from its ends and its bulge alone:
/// formulas that share nothing with those of the engines' sites, which begin at a tangent.
using BoundaryEdge = BulgeArc;

inline BoundaryEdge edge_of(const Site& site) { return {site.start, site.end, site.bulge}; }

/// Distance from p to the closed segment a b. Coordinates are subtracted before anything is
/// multiplied, and the nearer end is the origin: the error is below two units in the last place of
/// half the segment's length plus the distance.
double distance_to_segment(Vec2 p, Vec2 a, Vec2 b);

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

/// How far rounding may move the foot of p along the edge if it moves p by `slack`: without bound
/// where p is the centre of the arc.
double foot_slack(const BoundaryEdge& edge, Vec2 p, double slack);

}  // namespace medial::verify_detail
