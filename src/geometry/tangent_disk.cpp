#include "geometry/tangent_disk.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <limits>

namespace medial::geometry {
namespace {

/// The solver's own arithmetic, for double and for the 113-bit type.
template <class Real>
struct Vector {
  Real x, y;
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y}; }
  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y}; }
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

/// A carrier: the line through `point` with left normal `normal`, or a point.
template <class Real>
struct Carrier {
  Vector<Real> point;
  Vector<Real> normal;
  bool vertex;
};

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

/// Centres origin + l * along with radii r0 + l * slope: where two contact equations hold.
template <class Real>
struct LineOfCenters {
  Vector<Real> origin, along;
  Real radius, slope;
  Real one_minus_slope_squared;
};

/// The line's disks through (0, 0): |origin + l along|^2 = (radius + l slope)^2, where origin and
/// along are perpendicular or not.
template <class Real>
Solutions<Real> through_zero(const LineOfCenters<Real>& line) {
  using std::sqrt;
  const Real a = line.one_minus_slope_squared;
  const Real half_b = dot(line.origin, line.along) - line.radius * line.slope;
  const Real c = dot(line.origin, line.origin) - line.radius * line.radius;
  Solutions<Real> result;
  const auto add = [&](const Real& l) {
    const Real r = line.radius + l * line.slope;
    if (r >= Real(0)) result.disk[result.count++] = {line.origin + l * line.along, r};
  };
  Real discriminant = half_b * half_b - a * c;
  // A double root that rounding moved off the real axis.
  const Real noise = Real(16) * std::numeric_limits<Real>::epsilon();
  if (discriminant < Real(0)) {
    if (discriminant < -noise * half_b * half_b) return result;
    discriminant = Real(0);
  }
  const Real root = sqrt(discriminant);
  const Real q = half_b > Real(0) ? Real(-half_b - root) : Real(root - half_b);
  if (a != Real(0)) add(q / a);
  if (q != Real(0)) add(c / q);
  return result;
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
Solutions<Real> moved(Solutions<Real> disks, const Vector<Real>& by) {
  for (std::size_t i = 0; i < disks.count; ++i) disks.disk[i].center = disks.disk[i].center + by;
  return disks;
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
  return moved(through_zero(line), v.point);
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
  return moved(through_zero(line), v.point);
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

/// Two segments that meet in a corner: their disks' centres lie on the line through the corner
/// along the sum of the normals, which keeps its digits however flat the corner is, or along their
/// difference turned, which does however sharp it is.
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
  if (c.vertex) return moved(through_zero(line), c.point);
  const Real closing = line.slope - dot(c.normal, line.along);
  if (closing == Real(0)) return result;
  const Real l = dot(c.normal, line.origin) / closing;
  if (l >= Real(0)) result.disk[result.count++] = {corner + l * line.along, l * line.slope};
  return result;
}

template <class Real>
Solutions<Real> solve(std::array<const Carrier<Real>*, 3> c) {
  // Lines first.
  std::stable_sort(c.begin(), c.end(),
                   [](const auto* a, const auto* b) { return a->vertex < b->vertex; });
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

/// The flattest pair among three sites of a segment that ends where another one begins; -1 if there
/// is none.
struct Corner {
  int before = -1;
  int after = -1;
};
Corner find_corner(const std::array<const Site*, 3>& sites) {
  Corner flattest;
  double along = -2;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Site &before = *sites[static_cast<std::size_t>(i)],
                 &after = *sites[static_cast<std::size_t>(j)];
      if (i == j || before.is_vertex() || after.is_vertex() || !meets(before, after)) continue;
      const double turn = dot(before.direction, after.direction);
      if (turn <= along) continue;
      along = turn;
      flattest = {i, j};
    }
  }
  return flattest;
}

Carrier<double> carrier(const Site& site) {
  return {{site.point.x, site.point.y}, {-site.direction.y, site.direction.x}, site.is_vertex()};
}

}  // namespace

double tangent_radius(Vec2 foot, Vec2 normal, const Site& site) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (site.is_vertex()) {
    const Vec2 d = site.point - foot;
    const double ahead = 2 * medial::dot(normal, d);
    return ahead > 0 ? squared_norm(d) / ahead : none;
  }
  const double height = medial::cross(site.direction, foot - site.point);
  const double closing = 0.5 * squared_norm(normal - site.normal());
  return height >= 0 && closing > 0 ? height / closing : none;
}

TangentDisks tangent_disks(const Site& a, const Site& b, const Site& c) {
  const std::array<const Site*, 3> sites{&a, &b, &c};
  const std::array<Carrier<double>, 3> carriers{carrier(a), carrier(b), carrier(c)};
  Solutions<double> solved;
  const Corner corner = find_corner(sites);
  if (corner.before >= 0) {
    const auto at = [&](int i) { return carriers[static_cast<std::size_t>(i)]; };
    solved = corner_and_site<double>(at(corner.after).point, at(corner.before).normal,
                                     at(corner.after).normal, at(3 - corner.before - corner.after));
  } else {
    solved = solve<double>({&carriers[0], &carriers[1], &carriers[2]});
  }
  TangentDisks result;
  for (std::size_t i = 0; i < solved.count; ++i) {
    const auto& s = solved.disk[i];
    if (!(std::isfinite(s.center.x) && std::isfinite(s.center.y) && std::isfinite(s.radius)))
      continue;
    result.disk[result.count++] = {{s.center.x, s.center.y}, s.radius};
  }
  return result;
}

double residual(const Disk& disk, const Site& a, const Site& b, const Site& c) {
  return std::max({std::abs(carrier_distance(a, disk.center) - disk.radius),
                   std::abs(carrier_distance(b, disk.center) - disk.radius),
                   std::abs(carrier_distance(c, disk.center) - disk.radius)});
}

Disk improve(const Disk& disk, const Site& a, const Site& b, const Site& c) {
  const auto gradient = [&](const Site& s) {
    if (!s.is_vertex()) return s.normal();
    const Vec2 d = disk.center - s.point;
    return (1 / norm(d)) * d;
  };
  const auto error = [&](const Site& s) { return carrier_distance(s, disk.center) - disk.radius; };
  const Vec2 ga = gradient(a), ab = gradient(b) - ga, ac = gradient(c) - ga;
  const double ea = error(a), eb = ea - error(b), ec = ea - error(c);
  const double determinant = medial::cross(ab, ac);
  const Vec2 step{(eb * ac.y - ec * ab.y) / determinant, (ab.x * ec - ac.x * eb) / determinant};
  const Disk better{disk.center + step, disk.radius + medial::dot(ga, step) + ea};
  const bool usable = std::isfinite(better.center.x) && std::isfinite(better.center.y) &&
                      std::isfinite(better.radius) && better.radius >= 0;
  return usable ? better : disk;
}

bool tangent_disk_in_high_precision(const std::array<Ends, 3>& ends, const Disk& near, Disk& disk) {
  using Real = boost::multiprecision::cpp_bin_float_quad;
  std::array<Carrier<Real>, 3> carriers;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector<Real> p{Real(ends[i].start.x), Real(ends[i].start.y)};
    const Vector<Real> d = Vector<Real>{Real(ends[i].end.x), Real(ends[i].end.y)} - p;
    const Real squared = dot(d, d);
    carriers[i] = {p, {Real(0), Real(0)}, squared == Real(0)};
    if (carriers[i].vertex) continue;
    const Real inverse = Real(1) / sqrt(squared);
    carriers[i].normal = {-d.y * inverse, d.x * inverse};
  }
  const Solutions<Real> solved = solve<Real>({&carriers[0], &carriers[1], &carriers[2]});
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < solved.count; ++i) {
    const auto& s = solved.disk[i];
    const Disk candidate{{static_cast<double>(s.center.x), static_cast<double>(s.center.y)},
                         static_cast<double>(s.radius)};
    const double off = distance(candidate.center, near.center);
    if (off < best) {
      best = off;
      disk = candidate;
    }
  }
  return best < std::numeric_limits<double>::infinity();
}

}  // namespace medial::geometry
