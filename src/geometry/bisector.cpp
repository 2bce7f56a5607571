#include "geometry/bisector.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <optional>
#include <utility>

namespace medial::geometry {
namespace {

/// The disk that touches segment `s` at parameter `at` and the vertex.
Disk disk_over(const Site& s, double at, Vec2 vertex) {
  const Vec2 foot = s.point + at * s.direction;
  const Vec2 d = vertex - foot;
  const double r = squared_norm(d) / (2 * dot(s.normal(), d));
  return {foot + r * s.normal(), r};
}

/// A disk, or a difference of two, and the product that contact equations are made of.
template <class Real>
struct Triple {
  Real x, y, r;

  friend Triple operator-(const Triple& u, const Triple& v) {
    return {u.x - v.x, u.y - v.y, u.r - v.r};
  }
  friend Real product(const Triple& u, const Triple& v) {
    return u.x * v.x + u.y * v.y - u.r * v.r;
  }
};

/// The control point of an edge with an arc. With P the product above, a contact equation is
/// round P(d, d) = 2 flat (n.d - r) for the disk seen from the site's point, and its polar form at
/// both ends holds for the control point, the pole of the edge's chord: it lies in the plane of the
/// edge, P-perpendicular to the chord over its middle. Of the two sites the rounder one gives the
/// height over the chord and the weight. None where that has no number.
template <class Real>
std::optional<Control> pole_of_chord(const Site& a, const Site& b, const Disk& from,
                                     const Disk& to) {
  using std::abs, std::sqrt;
  using Triple = Triple<Real>;
  const auto triple = [](const Disk& disk) {
    return Triple{Real(disk.center.x), Real(disk.center.y), Real(disk.radius)};
  };
  const Triple start = triple(from), end = triple(to);
  const Triple middle{(start.x + end.x) / Real(2), (start.y + end.y) / Real(2),
                      (start.r + end.r) / Real(2)};
  // A site's contact equation seen from the middle, where points keep their digits; scaled so that
  // round and flat add up to one in size.
  struct Contact {
    Real round, flat;
    Triple point, normal;
  };
  const auto contact_of = [&](const Site& s) {
    const Triple point{Real(s.point.x) - middle.x, Real(s.point.y) - middle.y, Real(0)};
    if (s.is_vertex()) return Contact{Real(1), Real(0), point, {Real(0), Real(0), Real(0)}};
    const Real flat = Real(1) / (Real(1) + abs(Real(s.curvature)));
    return Contact{Real(s.curvature) * flat,
                   flat,
                   point,
                   {Real(-s.direction.y), Real(s.direction.x), Real(0)}};
  };
  Contact site = contact_of(a), other = contact_of(b);
  if (abs(site.round) < abs(other.round)) std::swap(site, other);
  // The plane of the edge: g.(x, y) + s r = constant.
  const Real ratio = other.round / site.round, flat = ratio * site.flat;
  const auto plane = [&](const Real& q, const Real& p, const Real& m, const Real& n) {
    return other.round * (q - p) + other.flat * m - flat * n;
  };
  const Real gx = plane(other.point.x, site.point.x, other.normal.x, site.normal.x);
  const Real gy = plane(other.point.y, site.point.y, other.normal.y, site.normal.y);
  const Real s = flat - other.flat;
  const Triple chord = end - start;
  // In the plane, and P-perpendicular to the chord.
  const Triple across{-gy * chord.r - s * chord.y, s * chord.x + gx * chord.r,
                      gx * chord.y - gy * chord.x};
  // The gradient of the site's contact equation, the mean of both ends.
  const Triple gradient{-site.round * site.point.x - site.flat * site.normal.x,
                        -site.round * site.point.y - site.flat * site.normal.y,
                        site.round * middle.r - site.flat};
  const Real squared = product(chord, chord);
  const Real height = site.round * squared / (Real(4) * product(across, gradient));
  const Real weight_squared =
      squared / (squared + Real(4) * height * height * product(across, across));
  const Control control{{{static_cast<double>(middle.x + height * across.x),
                          static_cast<double>(middle.y + height * across.y)},
                         static_cast<double>(middle.r + height * across.r)},
                        static_cast<double>(sqrt(weight_squared))};
  const bool usable = std::isfinite(static_cast<double>(height)) && control.weight > 0 &&
                      std::isfinite(control.weight);
  if (!usable) return std::nullopt;
  return control;
}

/// How far the edge with this control point strays from touching both sites, at three places.
double deviation(const Control& control, const Site& a, const Site& b, const Disk& from,
                 const Disk& to) {
  double worst = 0;
  for (const double t : {0.25, 0.5, 0.75}) {
    const double first = (1 - t) * (1 - t), last = t * t, middle = 2 * t * (1 - t) * control.weight;
    const double scale = 1 / (first + middle + last);
    const Vec2 center =
        scale * (first * from.center + middle * control.point.center + last * to.center);
    const double radius =
        scale * (first * from.radius + middle * control.point.radius + last * to.radius);
    for (const Site* s : {&a, &b})
      worst = std::max(worst, std::abs(carrier_distance(*s, center) - radius));
  }
  return worst;
}

/// The control point of an edge with an arc. Where centre and radius change almost alike, or an end
/// is next to the centre of an arc, the pole loses its digits: it is worked out anew with more of
/// them. What is left where that does not help is so nearly straight that a parabola through the
/// disk halfway does better.
Control control_with_arc(const Site& a, const Site& b, const Disk& from, const Disk& to) {
  constexpr double few_roundings = 0x1p-50, long_enough = 0x1p-7, straight = 1e-8;
  const Disk middle{midpoint(from.center, to.center), 0.5 * (from.radius + to.radius)};
  // An edge this short against its radius, its arcs' and the distances to their centres (its foci)
  // is straight to rounding; its plane would be lost.
  double size = middle.radius;
  for (const Site* s : {&a, &b})
    if (s->is_arc())
      size =
          std::min({size, 1 / std::abs(s->curvature), std::abs(1 / s->curvature - middle.radius)});
  const double length = distance(from.center, to.center);
  if (length <= straight * size) return {middle, 1};
  Control best = pole_of_chord<double>(a, b, from, to).value_or(Control{middle, 1});
  if (length < long_enough * from.radius) return best;
  double strays = deviation(best, a, b, from, to);
  const auto take_if_better = [&](const Control& control) {
    const double now = deviation(control, a, b, from, to);
    if (!(now < strays)) return;
    strays = now;
    best = control;
  };
  if (strays <= few_roundings) return best;
  if (const auto precise = pole_of_chord<boost::multiprecision::cpp_bin_float_quad>(a, b, from, to))
    take_if_better(*precise);
  if (strays <= few_roundings) return best;
  const Bisector bisector(b, a);
  const Disk halfway =
      bisector.disk_at(0.5 * (bisector.position(from.center) + bisector.position(to.center)), from);
  if (std::isfinite(halfway.center.x) && std::isfinite(halfway.center.y))
    take_if_better({{2 * halfway.center - middle.center, 2 * halfway.radius - middle.radius}, 1});
  return best;
}

}  // namespace

Vec2 Bisector::tangent(Vec2 center) const {
  if (!right.is_vertex() && !left.is_vertex() && reference == nullptr) return direction;
  const Vec2 along = left_of(outward(left, center) - outward(right, center));
  const double size = norm(along);
  return (reference == nullptr && dot(along, direction) < 0 ? -1 / size : 1 / size) * along;
}

Disk Bisector::disk_at(double position, const Disk& near) const {
  if (reference != nullptr) {
    const double s = position / scale;
    const Vec2 foot = reference->at(s), normal = reference->normal_at(s);
    const double radius = tangent_radius(foot, normal, reference == &right ? left : right);
    return {foot + radius * normal, radius};
  }
  if (right.is_vertex() && left.is_vertex()) {
    const Vec2 middle = midpoint(right.point, left.point);
    const Vec2 center = middle + (position - dot(direction, middle)) * direction;
    return {center, distance(center, right.point)};
  }
  if (left.is_vertex())
    return disk_over(right, dot(right.direction, position * direction - right.point), left.point);
  if (right.is_vertex())
    return disk_over(left, dot(left.direction, position * direction - left.point), right.point);
  const Vec2 center = near.center + (position - dot(direction, near.center)) * direction;
  return {center, carrier_distance(right, center)};
}

double Bisector::last_position(const Disk& near, double limit) const {
  if (reference != nullptr) {
    const double end = reference == &right ? scale * right.length : 0;
    double low = position(near.center), high = end;
    if (!(low < high) || disk_at(end, near).radius <= limit) return end;
    constexpr int halvings = 40;  // what is left of the interval is no matter
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (low + high);
      (disk_at(middle, near).radius <= limit ? low : high) = middle;
    }
    return low;
  }
  if (right.is_vertex() && left.is_vertex()) {
    const double half = 0.5 * distance(right.point, left.point);
    const double height = std::sqrt(std::max(0.0, limit * limit - half * half));
    return dot(direction, midpoint(right.point, left.point)) + height;
  }
  if (right.is_vertex() || left.is_vertex()) {
    const Site& segment = right.is_vertex() ? left : right;
    const Vec2 vertex = right.is_vertex() ? right.point : left.point;
    // Over the segment's line, a vertex at height y is reached by r = (x^2 + y^2) / (2 y).
    const double y = cross(segment.direction, vertex - segment.point);
    const double x = std::sqrt(std::max(0.0, (2 * limit - y) * y));
    return dot(direction, vertex) + x;
  }
  // Two segments: the radius is linear along the bisector.
  const double slope = dot(right.normal(), direction);
  const double reach =
      slope > 0 ? (limit - near.radius) / slope : (slope < 0 ? near.radius / -slope : limit);
  return position(near.center) + std::max(0.0, std::min(reach, 4 * limit));
}

Control control_of(const Site& a, const Site& b, const Disk& from, const Disk& to) {
  if (a.is_arc() || b.is_arc()) return control_with_arc(a, b, from, to);
  const Disk middle{midpoint(from.center, to.center), 0.5 * (from.radius + to.radius)};
  if (a.is_vertex() && b.is_vertex()) {
    // Along the line of centres the radius is a hyperbola: with h measured from the middle of the
    // vertices, r = d cosh u and h = d sinh u, and the shoulder point lies at the mean u. Its
    // weight is cosh of half the difference of u; written with differences to spare cancellation.
    const Vec2 foot = midpoint(a.point, b.point);
    const double squared = 0.25 * squared_norm(b.point - a.point);
    const double dh = distance(from.center, to.center), dr = to.radius - from.radius;
    const double weight_squared =
        squared > 0 ? 1 + std::max(0.0, (dh - dr) * (dh + dr)) / (4 * squared) : 1;
    return {{foot + (1 / weight_squared) * (middle.center - foot), middle.radius / weight_squared},
            std::sqrt(weight_squared)};
  }
  if (!a.is_vertex() && !b.is_vertex()) return {middle, 1};
  // A parabola over the segment: polynomial in the foot's parameter, so the control point is the
  // blossom at both ends. With x and y the vertex seen from the segment,
  // r(s) = ((s - x)^2 + y^2) / (2 y) has the blossom ((s - x)(t - x) + y^2) / (2 y).
  const Site& segment = a.is_vertex() ? b : a;
  const Vec2 vertex = a.is_vertex() ? a.point : b.point;
  const double y = cross(segment.direction, vertex - segment.point);
  const double s = dot(segment.direction, from.center - vertex);
  const double t = dot(segment.direction, to.center - vertex);
  if (!(y > 0)) return {middle, 1};
  const double r = (s * t + y * y) / (2 * y);
  // Centres lie at height r over the line; the vertex at height y.
  const Vec2 center = vertex + (0.5 * (s + t)) * segment.direction + (r - y) * segment.normal();
  return {{center, r}, 1};
}

}  // namespace medial::geometry
