#include "site/tangent_disk.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <limits>
#include <optional>

namespace medial::site {
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

/// A carrier: a disk at d from `point` with radius r touches it if
/// round (d.d - r r) = 2 flat (normal.d - r). A line has round = 0, a point flat = 0.
template <class Real>
struct Carrier {
  Vector<Real> point;
  Vector<Real> normal;
  Real round, flat;
  bool vertex;
};

/// A stable sort of three, in place.
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

/// The real roots of a l l + 2 half_b l + c, both without cancellation.
template <class Real>
struct Roots {
  std::array<Real, 2> root{};
  std::size_t count = 0;

  Roots(const Real& a, const Real& half_b, const Real& c) {
    using std::sqrt;
    Real discriminant = half_b * half_b - a * c;
    // A double root that rounding moved off the real axis.
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

/// Centres origin + l * along with radii radius + l * slope: where two contact equations hold.
template <class Real>
struct LineOfCenters {
  Vector<Real> origin, along;
  Real radius, slope;
  Real one_minus_slope_squared;
};

/// The line's disks that touch a carrier; the line's origin is relative to the carrier's point.
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

/// The disks that two linear equations leave; none where the two are parallel.
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
  return disks_on(line, c);
}

/// The centre of an arc's circle and its signed radius, as it stands in the contact equation.
template <class Real>
struct Circle {
  explicit Circle(const Carrier<Real>& arc)
      : radius(arc.flat / arc.round), center(arc.point + radius * arc.normal) {}
  Real radius;
  Vector<Real> center;
};

/// Whether two arcs are nearly of one circle, so that seen from their points most digits of
/// their difference are lost.
template <class Real>
bool nearly_concentric(const Carrier<Real>& a, const Carrier<Real>& b) {
  if (a.vertex || b.vertex || !(a.round * b.round > Real(0))) return false;
  constexpr double near = 0x1p-8;
  const Circle<Real> first(a), second(b);
  const Vector<Real> apart = second.center - first.center;
  const Real reach = Real(near) * first.radius;
  return dot(apart, apart) < reach * reach;
}

/// Whether the own circle of an arc is nearly tangent to another carrier.
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

/// Three carriers, the first one an arc to which another one is nearly concentric. Seen from the
/// arc's centre, x = c - q and s = rho - r, its own equation is x.x = s s, and that of another one
/// round (x + D).(x + D) - round (rho - s)^2 = 2 flat (n.(x + D) - rho + s), with D = q - point.
/// Their difference is linear, and for an arc with the centre q + u and the radius rho + e it is
/// u.x + e s = (u.u - e e) / 2, which is as exact as u and e are.
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
    // Inside of the circle of a convex arc, outside of the other.
    if (r >= Real(0) && s * own.radius >= Real(0))
      result.disk[result.count++] = {own.center + line->origin + l * line->along, r};
  }
  return result;
}

/// Three carriers, one of which is an arc: the equation of the roundest eliminates the quadric from
/// the other two, which leaves two planes in (x, y, r); their line meets the roundest.
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
  // A disk in the shape may be nearly the arc's own circle only if that is no larger than the
  // frame. Seen from the centre of a larger one, near places lose their digits, and all seem to
  // touch it.
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

/// The flattest pair among three sites of a segment that ends where another one begins; -1 if there
/// is none.
struct Corner {
  int before = -1;
  int after = -1;
};
Corner find_corner(const std::array<const Site*, 3>& sites) {
  Corner flattest;
  double along = -2;
  const auto is_segment = [](const Site& site) { return !site.is_vertex() && !site.is_arc(); };
  for (int i = 0; i < 3; ++i) {
    const Site& before = *sites[static_cast<std::size_t>(i)];
    if (!is_segment(before)) continue;
    const Vec2 end = before.end();
    for (int j = 0; j < 3; ++j) {
      const Site& after = *sites[static_cast<std::size_t>(j)];
      if (i == j || !is_same_place(end, after.point) || !is_segment(after)) continue;
      const double turn = dot(before.direction, after.direction);
      if (turn <= along) continue;
      along = turn;
      flattest = {i, j};
    }
  }
  return flattest;
}

/// Round and flat are scaled so that their sizes add up to one.
template <class Real>
Carrier<Real> carrier(const Site& site) {
  using std::abs, std::sqrt;
  Carrier<Real> result{{Real(site.point.x), Real(site.point.y)},
                       {Real(-site.direction.y), Real(site.direction.x)},
                       Real(0),
                       Real(1),
                       site.is_vertex()};
  if (site.is_vertex()) {
    result.round = Real(1);
    result.flat = Real(0);
  } else if (site.is_arc()) {
    const Real curvature(site.curvature);
    result.flat = Real(1) / (Real(1) + abs(curvature));
    result.round = curvature * result.flat;
  }
  return result;
}

/// Whether a disk that touches the carriers of arcs from inside could also touch the arcs: a larger
/// one than the arc's circle contains it.
bool fits_into(double radius, const Site& site) {
  constexpr double slack = 0x1p-20;
  return radius * site.curvature <= 1 + slack;
}

/// One Newton step towards contact with three carriers; the same disk where the step is singular.
Disk improved(const Disk& disk, const Site& a, const Site& b, const Site& c) {
  const auto error = [&](const Site& s) { return carrier_distance(s, disk.center) - disk.radius; };
  const Vec2 ga = outward(a, disk.center);
  const Vec2 ab = outward(b, disk.center) - ga, ac = outward(c, disk.center) - ga;
  const double ea = error(a), eb = ea - error(b), ec = ea - error(c);
  const double determinant = medial::cross(ab, ac);
  const Vec2 step{(eb * ac.y - ec * ab.y) / determinant, (ab.x * ec - ac.x * eb) / determinant};
  const Disk better{disk.center + step, disk.radius + medial::dot(ga, step) + ea};
  const bool usable = std::isfinite(better.center.x) && std::isfinite(better.center.y) &&
                      std::isfinite(better.radius) && better.radius >= 0;
  return usable ? better : disk;
}

/// tangent_disks() in 113-bit arithmetic, rounded to double: of its disks the one nearest to
/// `near`, if there is one.
std::optional<Disk> tangent_disk_in_high_precision(const Site& a, const Site& b, const Site& c,
                                                   const Disk& near) {
  using Real = boost::multiprecision::cpp_bin_float_quad;
  std::array<Carrier<Real>, 3> carriers{carrier<Real>(a), carrier<Real>(b), carrier<Real>(c)};
  for (Carrier<Real>& one : carriers)
    if (!one.vertex) one.normal = (Real(1) / sqrt(dot(one.normal, one.normal))) * one.normal;
  const Solutions<Real> solved = solve<Real>({&carriers[0], &carriers[1], &carriers[2]});
  double best = std::numeric_limits<double>::infinity();
  std::optional<Disk> disk;
  for (std::size_t i = 0; i < solved.count; ++i) {
    const auto& s = solved.disk[i];
    const Disk candidate{{static_cast<double>(s.center.x), static_cast<double>(s.center.y)},
                         static_cast<double>(s.radius)};
    // The circle of an arc is touched from its other side at the same place; the residual decides.
    const double off =
        std::max(distance(candidate.center, near.center), residual(candidate, a, b, c));
    if (off < best) {
      best = off;
      disk = candidate;
    }
  }
  return disk;
}

}  // namespace

double tangent_radius(Vec2 foot, Vec2 normal, const Site& site) {
  constexpr double none = std::numeric_limits<double>::infinity();
  // Rounding turns unit normals by up to so much: of those that differ by less nothing is known.
  constexpr double parallel = 0x1p-51;
  if (site.is_vertex()) {
    const Vec2 d = site.point - foot;
    const double ahead = 2 * medial::dot(normal, d);
    return ahead > 0 ? squared_norm(d) / ahead : none;
  }
  const Vec2 d = foot - site.point;
  double height = medial::cross(site.direction, d);
  double closing = 0.5 * squared_norm(normal - site.normal());
  if (site.is_arc()) {
    height -= 0.5 * site.curvature * squared_norm(d);
    closing += site.curvature * medial::dot(normal, d);
  }
  if (!(height >= 0 && closing > 0.5 * parallel * parallel)) return none;
  double radius = height / closing;
  // Where the disk is nearly the arc's own circle, the contact equation is its residual times
  // 1 - radius * curvature: Newton's method on the distance itself wins the digits back, in a step
  // or two unless the centres are very close. Distance less radius falls and is concave in the
  // radius: a step may lead too far, from where the next ones come back, and at the arc's own
  // radius it is far enough.
  constexpr double nearly = 0.25;
  constexpr int most_steps = 32;
  if (!site.is_arc() || !(std::abs(1 - radius * site.curvature) < nearly))
    return fits_into(radius, site) ? radius : none;
  const double own = 1 / site.curvature;
  radius = std::min(radius, own);
  for (int step = 0; step < most_steps; ++step) {
    const ArcView view = view_of_arc(site, foot + radius * normal);
    const double error = view.distance - radius;
    if (std::abs(error) <= std::numeric_limits<double>::epsilon() * radius) break;
    const double slope = medial::dot(view.toward, normal) / view.size - 1;
    const double next = slope < 0 ? std::min(radius - error / slope, own) : own;
    if (!(next != radius)) break;
    radius = next;
  }
  return fits_into(radius, site) ? radius : none;
}

double touching_radius(Vec2 foot, Vec2 normal, const Site& site) {
  if (site.is_vertex()) return tangent_radius(foot, normal, site);
  double radius = std::min(tangent_radius(foot, normal, make_vertex(site.point)),
                           tangent_radius(foot, normal, make_vertex(site.end())));
  for (const Site& facing : {site, reversed(site)}) {
    const double on_carrier = tangent_radius(foot, normal, facing);
    if (!(on_carrier < radius)) continue;
    const double s = carrier_parameter(facing, foot + on_carrier * normal);
    if (s >= 0 && s <= facing.length) radius = on_carrier;
  }
  return radius;
}

TangentDisks tangent_disks(const Site& a, const Site& b, const Site& c) {
  const std::array<const Site*, 3> sites{&a, &b, &c};
  const std::array<Carrier<double>, 3> carriers{carrier<double>(a), carrier<double>(b),
                                                carrier<double>(c)};
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
    const Disk disk{{s.center.x, s.center.y}, s.radius};
    const bool finite =
        std::isfinite(disk.center.x) && std::isfinite(disk.center.y) && std::isfinite(disk.radius);
    if (finite && fits_into(disk.radius, a) && fits_into(disk.radius, b) &&
        fits_into(disk.radius, c))
      result.disk[result.count++] = disk;
  }
  return result;
}

double residual(const Disk& disk, const Site& a, const Site& b, const Site& c) {
  return std::max({std::abs(carrier_distance(a, disk.center) - disk.radius),
                   std::abs(carrier_distance(b, disk.center) - disk.radius),
                   std::abs(carrier_distance(c, disk.center) - disk.radius)});
}

void polish(Disk& disk, const Site& a, const Site& b, const Site& c, double good, double bad,
            std::uint64_t& precision_retries) {
  constexpr double reach = 1e-3;
  const double furthest = reach * disk.radius;
  double error = residual(disk, a, b, c);
  const auto take_if_better = [&](const Disk& better) {
    const double better_error = residual(better, a, b, c);
    if (!(better_error < error && distance(better.center, disk.center) <= furthest)) return false;
    disk = better;
    error = better_error;
    return true;
  };
  for (int step = 0; step < 2 && error > good; ++step)
    if (!take_if_better(improved(disk, a, b, c))) break;
  if (error <= bad) return;
  ++precision_retries;
  if (const auto precise = tangent_disk_in_high_precision(a, b, c, disk)) take_if_better(*precise);
}

}  // namespace medial::site
