#include "site/tangent_disk.h"

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "site/apollonius.h"

namespace medial::site {
namespace {
using namespace apollonius;

/// Of the pairs of consecutive segments among three sites, the one with the flattest corner.
struct Corner {
  std::size_t before, after;
};
std::optional<Corner> find_corner(const std::array<const Site*, 3>& sites) {
  std::optional<Corner> flattest;
  double along = -2;
  const auto is_segment = [](const Site& site) { return !site.is_vertex() && !site.is_arc(); };
  for (std::size_t i = 0; i < 3; ++i) {
    const Site& before = *sites[i];
    if (!is_segment(before)) continue;
    const Vec2 end = before.end();
    for (std::size_t j = 0; j < 3; ++j) {
      const Site& after = *sites[j];
      if (i == j || !is_same_place(end, after.point) || !is_segment(after)) continue;
      const double turn = dot(before.direction, after.direction);
      if (turn <= along) continue;
      along = turn;
      flattest = Corner{i, j};
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

/// Whether a disk that touches an arc's carrier could also touch the arc from inside; a disk larger
/// than the circle of a convex arc contains the arc.
bool fits_into(double radius, const Site& site) {
  constexpr double slack = 0x1p-20;
  return radius * site.curvature <= 1 + slack;
}

/// One Newton step towards contact with three carriers; the same disk if the step is singular.
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

/// Numbers of 113 bits: the compiler's type, if there is one.
using Quad = std::conditional_t<std::numeric_limits<long double>::digits == 113, long double,
                                boost::multiprecision::cpp_bin_float_quad>;

/// The disk of tangent_disks() in 113-bit arithmetic that is nearest to `near`, rounded to double,
/// if there is one.
std::optional<Disk> tangent_disk_in_high_precision(const Site& a, const Site& b, const Site& c,
                                                   const Disk& near) {
  using Real = Quad;
  using std::sqrt;
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
    // The disk may touch an arc's circle from its other side there; the residual decides.
    const double off =
        std::max(distance(candidate.center, near.center), residual(candidate, a, b, c));
    if (off < best) {
      best = off;
      disk = candidate;
    }
  }
  return disk;
}

constexpr double none = std::numeric_limits<double>::infinity();

/// tangent_radius() for a point.
double radius_to_point(Vec2 foot, Vec2 normal, Vec2 point) {
  const Vec2 d = point - foot;
  const double ahead = 2 * medial::dot(normal, d);
  return ahead > 0 ? squared_norm(d) / ahead : none;
}

}  // namespace

double tangent_radius(Vec2 foot, Vec2 normal, const Site& site) {
  // Rounding turns unit normals by up to this, so a smaller difference means nothing.
  constexpr double parallel = 0x1p-51;
  if (site.is_vertex()) return radius_to_point(foot, normal, site.point);
  const Vec2 d = foot - site.point;
  double height = medial::cross(site.direction, d);
  double closing = 0.5 * squared_norm(normal - site.normal());
  if (site.is_arc()) {
    height -= 0.5 * site.curvature * squared_norm(d);
    closing += site.curvature * medial::dot(normal, d);
  }
  if (!(height >= 0 && closing > 0.5 * parallel * parallel)) return none;
  double radius = height / closing;
  // If the disk is nearly equal to the arc's circle, the contact equation is its residual times 1 -
  // radius * curvature. Newton's method on the distance restores the digits, in one or two steps
  // unless the centres are very close. Distance minus radius decreases and is concave in the
  // radius, so a step may overshoot, and the next steps return. No step goes beyond the arc's own
  // radius.
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
  double radius = std::min(radius_to_point(foot, normal, site.point),
                           radius_to_point(foot, normal, site.end()));
  const auto look_at = [&](const Site& facing) {
    const double on_carrier = tangent_radius(foot, normal, facing);
    if (!(on_carrier < radius)) return;
    const double s = carrier_parameter(facing, foot + on_carrier * normal);
    if (s >= 0 && s <= facing.length) radius = on_carrier;
  };
  look_at(site);
  look_at(reversed(site));
  return radius;
}

TangentDisks tangent_disks(const Site& a, const Site& b, const Site& c) {
  const std::array<const Site*, 3> sites{&a, &b, &c};
  const std::array<Carrier<double>, 3> carriers{carrier<double>(a), carrier<double>(b),
                                                carrier<double>(c)};
  Solutions<double> solved;
  if (const auto corner = find_corner(sites)) {
    const Carrier<double>&before = carriers[corner->before], &after = carriers[corner->after];
    solved = corner_and_site<double>(after.point, before.normal, after.normal,
                                     carriers[3 - corner->before - corner->after]);
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
