#pragma once

// A site as the exact decisions see it: as it stands in the shape, with the contact of a disk as an
// equation whose coefficients are rational up to one square root.

#include <cmath>

#include "medial/geometry.h"
#include "methods/exact/numbers.h"
#include "site/apollonius.h"

namespace medial::exact {

/// A site in the local frame, where coordinates are those of the input, exactly, but for a shift
/// and a power of two.
struct ExactSite {
  Vec2 start;
  Vec2 end;  ///< a vertex has end == start
  double bulge = 0;

  bool is_vertex() const { return start == end; }
  bool is_arc() const { return bulge != 0; }
};

using site::apollonius::Vector;

template <class Number>
Vector<Number> left_of(const Vector<Number>& a) {
  return {-a.y, a.x};
}
template <class Number>
Vector<Number> exact_vector(Vec2 p) {
  return {Number(p.x), Number(p.y)};
}

/// A disk whose centre and radius are known within bounds.
template <class Real>
struct DiskBounds {
  Vector<Bounded<Real>> center;
  Bounded<Real> radius;
};

/// The inward normal at an end of an edge, of length `size`. It is the line of centres of all disks
/// that touch the edge there.
template <class Number>
struct Spoke {
  Vector<Number> foot;
  Vector<Number> normal;
  Number size;
};

/// Along an edge's chord; where that is parallel to an axis a unit, so that no root is needed.
template <class Number>
Vector<Number> along_of(const ExactSite& edge) {
  const Vec2 from = edge.start, to = edge.end;
  const auto sign = [](double a, double b) { return Number(b > a ? 1.0 : b < a ? -1.0 : 0.0); };
  if (!edge.is_arc() && (from.x == to.x || from.y == to.y))
    return {sign(from.x, to.x), sign(from.y, to.y)};
  return exact_vector<Number>(to) - exact_vector<Number>(from);
}

/// The inward normal of an edge at its start or end, of one length at both: for an arc of bulge b,
/// whose tangents are the chord turned by half of its angle, 1 + b^2 times that along the chord.
template <class Number>
Vector<Number> normal_of(const ExactSite& edge, bool at_end) {
  const Vector<Number> along = along_of<Number>(edge), normal = left_of(along);
  if (!edge.is_arc()) return normal;
  const Number bulge(edge.bulge), twice(at_end ? -2.0 * edge.bulge : 2.0 * edge.bulge);
  return (Number(1.0) - bulge * bulge) * normal + twice * along;
}

template <class Number>
Spoke<Number> spoke_of(const ExactSite& edge, bool at_end) {
  const Vector<Number> along = along_of<Number>(edge);
  const bool is_unit = !edge.is_arc() && (edge.start.x == edge.end.x || edge.start.y == edge.end.y);
  Number size = is_unit ? Number(1.0) : root_of(dot(along, along));
  if (edge.is_arc()) size = (Number(1.0) + Number(edge.bulge) * Number(edge.bulge)) * size;
  return {exact_vector<Number>(at_end ? edge.end : edge.start), normal_of<Number>(edge, at_end),
          size};
}

/// The circle of an arc; the radius is negative where the arc turns to the right.
template <class Real>
DiskBounds<Real> circle_of(const ExactSite& arc) {
  using Number = Bounded<Real>;
  const Spoke<Number> spoke = spoke_of<Number>(arc, false);
  const Number times = Number(1.0) / Number(4 * arc.bulge);
  return {spoke.foot + times * spoke.normal, times * spoke.size};
}

/// The normal between the ends of an edge, at a `share` of the way from 1 at its start to -1 at its
/// end: for an arc of bulge b, that of its chord turned by twice the arc tangent of b share.
template <class Number>
Spoke<Number> spoke_at(const ExactSite& edge, const Number& share) {
  const Number one(1.0), two(2.0), bulge(edge.bulge), turn = bulge * share;
  const Vector<Number> start = exact_vector<Number>(edge.start),
                       along = exact_vector<Number>(edge.end) - start, normal = left_of(along);
  const Number squared = turn * turn, rest = one - share;
  const Number length = two * (one + squared);
  const Vector<Number> foot = start + (rest * (one - bulge * turn) / length) * along -
                              (bulge * rest * (one + share) / length) * normal;
  return {foot, (one - squared) * normal + two * turn * along,
          (one + squared) * root_of(dot(along, along))};
}

/// The share at which the foot of a place lies on an edge's carrier, as an approximation.
template <class Real>
Real share_of(const ExactSite& edge, const Vector<Real>& place) {
  using std::sqrt;
  const Real x = edge.end.x - Real(edge.start.x), y = edge.end.y - Real(edge.start.y);
  const Real dx = place.x - edge.start.x, dy = place.y - edge.start.y, squared = x * x + y * y;
  if (!edge.is_arc()) return 1 - 2 * (x * dx + y * dy) / squared;
  // The arc's normal at its start turned to where the place is seen.
  const Real bulge(edge.bulge), cosine = 1 - bulge * bulge;
  const Real nx = 2 * bulge * x - cosine * y - 4 * bulge * dx,
             ny = 2 * bulge * y + cosine * x - 4 * bulge * dy;
  const Real size = sqrt(Real((nx * nx + ny * ny) * squared));
  return (nx * x + ny * y) / (bulge * (size + x * ny - y * nx));
}

/// The contact of a disk with a site: round (x.x - r r) + slope.x - size r + height is zero, with x
/// the centre as seen from an origin; positive where the disk does not reach the site's carrier.
/// With d = x - point it is N.d - |N| r for a segment of inward normal N, and the same less
/// 2 b (d.d - r r) for an arc of bulge b; d.d - r r for a vertex.
template <class Number>
struct Form {
  Number round;
  Vector<Number> slope;
  Number size;
  Number height;
};

template <class Number>
Form<Number> form_of(const ExactSite& site, const Vector<Number>& origin) {
  const Vector<Number> d = origin - exact_vector<Number>(site.start);
  if (site.is_vertex()) return {Number(1.0), Number(2.0) * d, Number(0.0), dot(d, d)};
  const Spoke<Number> spoke = spoke_of<Number>(site, false);
  Form<Number> form{Number(0.0), spoke.normal, spoke.size, dot(spoke.normal, d)};
  if (site.is_arc()) {
    form.round = Number(-2.0 * site.bulge);
    form.slope = form.slope + Number(2.0) * form.round * d;
    form.height = form.height + form.round * dot(d, d);
  }
  return form;
}

}  // namespace medial::exact
