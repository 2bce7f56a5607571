#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

// The ten problems of Apollonius for segments, arcs and vertices, for numbers of any precision; see
// tangent_disks().
namespace medial::site::apollonius {

/// Arithmetic for all number types.
template <class Real>
struct Vector {
  Real x, y;
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y}; }
  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y}; }
  friend Vector operator-(const Vector& a) { return {-a.x, -a.y}; }
  friend Vector operator*(const Real& s, const Vector& a) { return {s * a.x, s * a.y}; }
};
template <class Real>
Real dot(const Vector<Real>& a, const Vector<Real>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class Real>
Real cross(const Vector<Real>& a, const Vector<Real>& b) {
  return a.x * b.y - a.y * b.x;
}

/// A carrier: a disk at d from `point` with radius r touches it if
/// round (d.d - r r) = 2 flat (normal.d - r). A line has round = 0, a point flat = 0.
template <class Real>
struct Carrier {
  Vector<Real> point;
  Vector<Real> normal;
  Real round, flat;
  bool vertex;
};

/// Sorts three elements in place; stable.
template <class T, class Before>
void sort_three(std::array<T, 3>& three, Before&& before) {
  if (before(three[1], three[0])) std::swap(three[0], three[1]);
  if (before(three[2], three[1])) std::swap(three[1], three[2]);
  if (before(three[1], three[0])) std::swap(three[0], three[1]);
}

template <class Real>
struct Solution {
  Vector<Real> center;
  Real radius;
};

template <class Real>
struct Solutions {
  std::array<Solution<Real>, 2> disk{};
  std::size_t count = 0;
};

/// The real roots of a l l + 2 half_b l + c, computed without cancellation.
template <class Real>
struct Roots {
  std::array<Real, 2> root{};
  std::size_t count = 0;

  Roots(const Real& a, const Real& half_b, const Real& c) {
    using std::sqrt;
    Real discriminant = half_b * half_b - a * c;
    // A double root that rounding has moved off the real axis.
    const Real noise = Real(16) * std::numeric_limits<Real>::epsilon();
    if (discriminant < Real(0)) {
      if (discriminant < -noise * half_b * half_b) return;
      discriminant = Real(0);
    }
    const Real size = sqrt(discriminant);
    const Real q = half_b > Real(0) ? Real(-half_b - size) : Real(size - half_b);
    if (a != Real(0)) root[count++] = q / a;
    if (q != Real(0)) root[count++] = c / q;
  }
};

/// The disks for which two contact equations hold: centres origin + l * along, radii radius + l *
/// slope.
template <class Real>
struct LineOfCenters {
  Vector<Real> origin, along;
  Real radius, slope;
  Real one_minus_slope_squared;
};

/// The disks of the line that touch a carrier. The line's origin is relative to the carrier's
/// point.
template <class Real>
Solutions<Real> disks_on(const LineOfCenters<Real>& line, const Carrier<Real>& carrier) {
  Real a = line.one_minus_slope_squared;
  Real half_b = dot(line.origin, line.along) - line.radius * line.slope;
  Real c = dot(line.origin, line.origin) - line.radius * line.radius;
  if (!carrier.vertex) {
    a *= carrier.round;
    half_b = carrier.round * half_b - carrier.flat * (dot(carrier.normal, line.along) - line.slope);
    c = carrier.round * c -
        Real(2) * carrier.flat * (dot(carrier.normal, line.origin) - line.radius);
  }
  Solutions<Real> result;
  const Roots<Real> roots(a, half_b, c);
  for (std::size_t i = 0; i < roots.count; ++i) {
    const Real& l = roots.root[i];
    const Real r = line.radius + l * line.slope;
    if (r >= Real(0))
      result.disk[result.count++] = {line.origin + l * line.along + carrier.point, r};
  }
  return result;
}

/// A linear equation g.(x, y) + s r = h of a disk.
template <class Real>
struct Plane {
  Vector<Real> g;
  Real s, h;
};

/// The disks that satisfy two linear equations; none if the equations are parallel.
template <class Real>
std::optional<LineOfCenters<Real>> line_of(const Plane<Real>& a, const Plane<Real>& b) {
  using std::sqrt;
  const Vector<Real> along{a.g.y * b.s - a.s * b.g.y, a.s * b.g.x - a.g.x * b.s};
  const Real rise = cross(a.g, b.g);
  const Real squared = dot(along, along) + rise * rise;
  if (squared == Real(0)) return std::nullopt;
  // The point of both planes nearest to the origin: (h_a (b x d) + h_b (d x a)) / d.d.
  const Vector<Real> b_d{b.g.y * rise - b.s * along.y, b.s * along.x - b.g.x * rise};
  const Vector<Real> d_a{along.y * a.s - rise * a.g.y, rise * a.g.x - along.x * a.s};
  const Real inverse = Real(1) / squared, scale = sqrt(inverse);
  LineOfCenters<Real> line;
  line.origin = inverse * (a.h * b_d + b.h * d_a);
  line.radius = inverse * (a.h * cross(b.g, along) + b.h * cross(along, a.g));
  line.along = scale * along;
  line.slope = scale * rise;
  line.one_minus_slope_squared = dot(line.along, line.along) - line.slope * line.slope;
  return line;
}

template <class Real>
Solutions<Real> three_lines(const Carrier<Real>& a, const Carrier<Real>& b,
                            const Carrier<Real>& c) {
  // Contact with a line: normal . (x - point) = r. Origin at a.point.
  const Vector<Real> ab = b.normal - a.normal, ac = c.normal - a.normal;
  const Real hb = dot(b.normal, b.point - a.point), hc = dot(c.normal, c.point - a.point);
  const Real determinant = cross(ab, ac);
  Solutions<Real> result;
  if (determinant == Real(0)) return result;
  const Real inverse = Real(1) / determinant;
  const Vector<Real> x{(hb * ac.y - hc * ab.y) * inverse, (ab.x * hc - ac.x * hb) * inverse};
  const Real r = dot(a.normal, x);
  if (r >= Real(0)) result.disk[result.count++] = {x + a.point, r};
  return result;
}

template <class Real>
Solutions<Real> two_lines_and_vertex(const Carrier<Real>& a, const Carrier<Real>& b,
                                     const Carrier<Real>& v) {
  using std::sqrt;
  const Real ha = dot(a.normal, a.point - v.point), hb = dot(b.normal, b.point - v.point);
  const Vector<Real> difference = a.normal - b.normal;
  const Real squared = dot(difference, difference);
  if (squared == Real(0)) return {};
  const Real size = sqrt(squared);
  const Vector<Real> across = (Real(1) / size) * difference;
  LineOfCenters<Real> line;
  line.origin = ((ha - hb) / size) * across;
  line.along = {-across.y, across.x};
  line.radius = dot(a.normal, line.origin) - ha;
  line.slope = dot(a.normal, line.along);
  line.one_minus_slope_squared = squared / Real(4);  // a.normal . across = |difference| / 2
  return disks_on(line, v);
}

template <class Real>
Solutions<Real> line_and_two_vertices(const Carrier<Real>& a, const Carrier<Real>& v,
                                      const Carrier<Real>& w) {
  using std::sqrt;
  const Vector<Real> chord = w.point - v.point;
  const Real squared = dot(chord, chord);
  if (squared == Real(0)) return {};
  const Real inverse = Real(1) / sqrt(squared);
  const Real across = dot(a.normal, chord) * inverse;
  LineOfCenters<Real> line;
  line.origin = Real(0.5) * chord;
  line.along = {-chord.y * inverse, chord.x * inverse};
  line.radius = dot(a.normal, line.origin - (a.point - v.point));
  line.slope = dot(a.normal, line.along);
  line.one_minus_slope_squared = across * across;
  return disks_on(line, v);
}

template <class Real>
Solutions<Real> three_vertices(const Carrier<Real>& u, const Carrier<Real>& v,
                               const Carrier<Real>& w) {
  using std::sqrt;
  const Vector<Real> p = v.point - u.point, q = w.point - u.point;
  const Real determinant = Real(2) * cross(p, q);
  Solutions<Real> result;
  if (determinant == Real(0)) return result;
  const Real pp = dot(p, p), qq = dot(q, q);
  const Vector<Real> x{(pp * q.y - qq * p.y) / determinant, (p.x * qq - q.x * pp) / determinant};
  result.disk[result.count++] = {x + u.point, sqrt(dot(x, x))};
  return result;
}

/// The disks of two segments that meet in a corner. Their centres lie on the line through the
/// corner along the sum of the normals, which is accurate for flat corners, or along the rotated
/// difference of the normals, which is accurate for sharp corners.
template <class Real>
Solutions<Real> corner_and_site(const Vector<Real>& corner, const Vector<Real>& before,
                                const Vector<Real>& after, const Carrier<Real>& c) {
  using std::sqrt;
  const Vector<Real> sum = before + after, difference = before - after;
  const Real size = sqrt(dot(sum, sum));
  Solutions<Real> result;
  if (size == Real(0)) return result;
  LineOfCenters<Real> line;
  const Real across = sqrt(dot(difference, difference));
  if (size > across)
    line.along = (Real(1) / size) * sum;
  else
    line.along = (Real(1) / across) * Vector<Real>{-difference.y, difference.x};
  line.radius = Real(0);
  line.slope = size / Real(2);  // the normals are unit vectors
  line.one_minus_slope_squared = dot(difference, difference) / Real(4);
  line.origin = corner - c.point;
  return disks_on(line, c);
}

/// The centre of an arc's circle, and its signed radius as in the contact equation.
template <class Real>
struct Circle {
  explicit Circle(const Carrier<Real>& arc)
      : radius(arc.flat / arc.round), center(arc.point + radius * arc.normal) {}
  Real radius;
  Vector<Real> center;
};

/// Whether two arcs lie almost on one circle, so that relative to their points most digits of their
/// difference cancel.
template <class Real>
bool nearly_concentric(const Carrier<Real>& a, const Carrier<Real>& b) {
  if (a.vertex || b.vertex || !(a.round * b.round > Real(0))) return false;
  constexpr double near = 0x1p-8;
  const Circle<Real> first(a), second(b);
  const Vector<Real> apart = second.center - first.center;
  const Real reach = Real(near) * first.radius;
  return dot(apart, apart) < reach * reach;
}

/// Whether an arc's circle is nearly tangent to another carrier.
template <class Real>
bool nearly_touches(const Circle<Real>& own, const Carrier<Real>& other) {
  using std::abs;
  constexpr double near = 0x1p-20;
  const Vector<Real> d = own.center - other.point;
  const Real error = other.round * (dot(d, d) - own.radius * own.radius) -
                     Real(2) * other.flat * (dot(other.normal, d) - own.radius);
  const Real scale = abs(own.radius) * (abs(other.round * own.radius) + other.flat);
  return abs(error) < Real(near) * scale;
}

/// The disks of three carriers, of which the first is an arc and another is nearly concentric to
/// it. Relative to the arc's centre, with x = c - q and s = rho - r, the arc's equation is x.x = s
/// s. The equation of another carrier is round (x + D).(x + D) - round (rho - s)^2 = 2 flat (n.(x +
/// D) - rho
/// + s), with D = q - point. Their difference is linear; for an arc with the centre q + u and the
/// radius rho + e it is u.x + e s = (u.u - e e) / 2, which is as accurate as u and e.
template <class Real>
Solutions<Real> about_center(const Carrier<Real>& arc,
                             const std::array<const Carrier<Real>*, 2>& others) {
  using std::sqrt;
  const Circle<Real> own(arc);
  // As an equation of x and s, of unit size.
  const auto plane_of = [&](const Carrier<Real>& c) {
    Plane<Real> plane;
    if (nearly_concentric(arc, c)) {
      const Circle<Real> circle(c);
      const Vector<Real> u = circle.center - own.center;
      const Real e = circle.radius - own.radius;
      plane = {u, e, (dot(u, u) - e * e) / Real(2)};
    } else {
      const Vector<Real> d = own.center - c.point;
      const Real rho = own.radius;
      plane = {c.round * d - c.flat * c.normal, c.round * rho - c.flat,
               c.flat * (dot(c.normal, d) - rho) - c.round * (dot(d, d) - rho * rho) / Real(2)};
    }
    const Real size = sqrt(dot(plane.g, plane.g) + plane.s * plane.s);
    if (size == Real(0)) return plane;
    return Plane<Real>{(Real(1) / size) * plane.g, plane.s / size, plane.h / size};
  };
  Solutions<Real> result;
  const auto line = line_of<Real>(plane_of(*others[0]), plane_of(*others[1]));
  if (!line) return result;
  // x.x = s s on the line.
  const Roots<Real> roots(line->one_minus_slope_squared,
                          dot(line->origin, line->along) - line->radius * line->slope,
                          dot(line->origin, line->origin) - line->radius * line->radius);
  for (std::size_t i = 0; i < roots.count; ++i) {
    const Real& l = roots.root[i];
    const Real s = line->radius + l * line->slope, r = own.radius - s;
    // Inside the circle of a convex arc, outside the other.
    if (r >= Real(0) && s * own.radius >= Real(0))
      result.disk[result.count++] = {own.center + line->origin + l * line->along, r};
  }
  return result;
}

/// The disks of three carriers of which at least one is an arc. The equation of the roundest
/// carrier eliminates the quadric from the other two. This leaves two planes in (x, y, r), whose
/// common line meets the roundest carrier.
template <class Real>
Solutions<Real> three_carriers(std::array<const Carrier<Real>*, 3> carriers) {
  using std::abs;
  sort_three(carriers, [](const auto* a, const auto* b) { return abs(a->round) > abs(b->round); });
  const Carrier<Real>& roundest = *carriers[0];
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = i + 1; j < 3; ++j)
      if (nearly_concentric(*carriers[i], *carriers[j]))
        return about_center<Real>(*carriers[i], {carriers[j], carriers[3 - i - j]});
  std::size_t first_arc = 0;
  while (carriers[first_arc]->vertex) ++first_arc;
  // A disk in the shape can be nearly equal to the arc's circle only if the circle is not larger
  // than the frame. Relative to the centre of a larger circle, nearby points lose their digits, and
  // all seem to touch it.
  if (Real(2) * carriers[first_arc]->round > carriers[first_arc]->flat) {
    const auto &arc = *carriers[first_arc], &b = *carriers[(first_arc + 1) % 3],
               &c = *carriers[(first_arc + 2) % 3];
    const Circle<Real> own(arc);
    if (nearly_touches(own, b) && nearly_touches(own, c)) return about_center<Real>(arc, {&b, &c});
  }
  const auto plane_of = [&](const Carrier<Real>& c) {
    const Vector<Real> p = c.point - roundest.point;
    const Real ratio = c.round / roundest.round;
    return Plane<Real>{c.round * p + c.flat * c.normal - (ratio * roundest.flat) * roundest.normal,
                       ratio * roundest.flat - c.flat,
                       c.round * dot(p, p) / Real(2) + c.flat * dot(c.normal, p)};
  };
  const auto line = line_of<Real>(plane_of(*carriers[1]), plane_of(*carriers[2]));
  return line ? disks_on(*line, roundest) : Solutions<Real>{};
}

template <class Real>
Solutions<Real> solve(std::array<const Carrier<Real>*, 3> c) {
  const auto is_arc = [](const auto* one) { return !one->vertex && one->round != Real(0); };
  if (is_arc(c[0]) || is_arc(c[1]) || is_arc(c[2])) return three_carriers<Real>(c);
  // Lines first.
  sort_three(c, [](const auto* a, const auto* b) { return a->vertex < b->vertex; });
  const int vertices = c[0]->vertex + c[1]->vertex + c[2]->vertex;
  switch (vertices) {
    case 0:
      return three_lines(*c[0], *c[1], *c[2]);
    case 1:
      return two_lines_and_vertex(*c[0], *c[1], *c[2]);
    case 2:
      return line_and_two_vertices(*c[0], *c[1], *c[2]);
    default:
      return three_vertices(*c[0], *c[1], *c[2]);
  }
}

}  // namespace medial::site::apollonius
