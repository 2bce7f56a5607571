#include "support/generate_arcs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace medial::test {
namespace {

constexpr double pi = std::numbers::pi;

Vec2 at_angle(double angle, double radius) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double t = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
  return distance(p, a + t * along);
}

double distance_of_segments(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d),
                   distance_to_segment(c, a, b), distance_to_segment(d, a, b)});
}

/// The angle between two directions, in [0, pi].
double angle_between(Vec2 a, Vec2 b) { return std::abs(std::atan2(cross(a, b), dot(a, b))); }

/// Bulge of the arc that leaves in the direction of the unit tangent.
double bulge_from(Vec2 tangent, Vec2 chord) {
  return cross(tangent, chord) / (norm(chord) + dot(tangent, chord));
}

/// Turned, scaled, moved, mirrored, reversed and re-started at random.
Rings placed(Random& random, const Rings& rings) {
  Symmetry s;
  const double scale = random.chance(0.5) ? 1 : random.power_of_ten(-6, 6);
  const double angle = random.chance(0.3) ? 0 : random.between(0, 2 * pi);
  const double mirror = random.chance(0.5) ? -1 : 1;
  s.xx = scale * std::cos(angle);
  s.yx = scale * std::sin(angle);
  s.xy = -mirror * s.yx;
  s.yy = mirror * s.xx;
  if (random.chance(0.3)) {
    s.dx = scale * random.between(-20, 20);
    s.dy = scale * random.between(-20, 20);
  }
  s.reverse = random.chance(0.5);
  s.restart = static_cast<std::size_t>(random.integer(0, 5));
  return transformed(rings, s);
}

Ring scaled(Ring ring, double factor, Vec2 offset) {
  for (Vec2& p : ring.points) p = factor * p + offset;
  return ring;
}

}  // namespace

Ring circle(Vec2 center, double radius, double angle) {
  const Vec2 arm = at_angle(angle, radius);
  return {{center + arm, center - arm}, RingRole::any, {1, 1}};
}

Ring stadium(Vec2 a, Vec2 b, double radius) {
  const Vec2 side = (radius / distance(a, b)) * left_of(b - a);
  return {{a - side, b - side, b + side, a + side}, RingRole::any, {0, 1, 0, 1}};
}

Ring bulged_polygon(std::size_t n, double bulge, double radius) {
  Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    ring.points.push_back(
        at_angle(2 * pi * static_cast<double>(i) / static_cast<double>(n), radius));
    ring.bulges.push_back(bulge);
  }
  return ring;
}

Ring gear(std::size_t teeth, double root) {
  Ring ring;
  const double step = pi / (2 * static_cast<double>(teeth));
  const double bulge = std::tan(step / 4);
  for (std::size_t i = 0; i < 4 * teeth; ++i) {
    const bool top = i % 4 < 2;
    ring.points.push_back(at_angle(step * static_cast<double>(i), top ? 1 : root));
    ring.bulges.push_back(i % 2 == 0 ? bulge : 0);
  }
  return ring;
}

Ring rounded(const Ring& polygon, double radius) {
  Ring ring;
  const std::vector<Vec2>& points = polygon.points;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 in = points[i] - points[(i + n - 1) % n];
    const Vec2 out = points[(i + 1) % n] - points[i];
    const double turn = std::atan2(cross(in, out), dot(in, out));
    const double tangent = std::tan(turn / 2);
    const double cut = std::min(radius * std::abs(tangent), 0.45 * std::min(norm(in), norm(out)));
    ring.points.push_back(points[i] - (cut / norm(in)) * in);
    ring.bulges.push_back(std::tan(turn / 4));
    ring.points.push_back(points[i] + (cut / norm(out)) * out);
    ring.bulges.push_back(0);
  }
  return ring;
}

Rings bent(Random& random, const Rings& rings, double keep_straight, double slight) {
  Rings result = rings;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::vector<Vec2>& points = rings[r].points;
    const std::size_t n = points.size();
    result[r].bulges.assign(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 a = points[i];
      const Vec2 b = points[(i + 1) % n];
      // Each of two edges may use 0.4 of the gap between them.
      double clearance = std::numeric_limits<double>::infinity();
      for (const Ring& other : rings) {
        const std::size_t m = other.points.size();
        for (std::size_t j = 0; j < m; ++j) {
          const Vec2 c = other.points[j];
          const Vec2 d = other.points[(j + 1) % m];
          if (a != c && a != d && b != c && b != d) {
            clearance = std::min(clearance, distance_of_segments(a, b, c, d));
          }
        }
      }
      const Vec2 before = points[(i + n - 1) % n];
      const Vec2 after = points[(i + 2) % n];
      const double angle =
          std::min(angle_between(before - a, b - a), angle_between(after - b, a - b));
      const double most =
          std::min({1.0, 2 * 0.4 * clearance / distance(a, b), std::tan(0.4 * angle / 2)});
      const double sign = random.chance(0.5) ? 1 : -1;
      const double u = random.unit();
      const double power = random.power_of_ten(-14, -3);
      double factor = random.chance(0.1) ? 1 : random.unit();
      if (u < keep_straight) factor = 0;
      if (u >= 1 - slight) factor = power;
      result[r].bulges[i] = sign * factor * most + 0.0;
    }
  }
  return result;
}

Ring smooth_biarcs(Random& random, std::size_t n, int waves) {
  std::vector<double> weight;
  std::vector<double> phase;
  for (int k = 1; k <= waves; ++k) {
    weight.push_back(random.between(-0.5, 0.5) / (k * waves));
    phase.push_back(random.between(0, 2 * pi));
  }
  const auto curve = [&](double t, Vec2& point, Vec2& tangent) {
    double r = 1;
    double slope = 0;
    for (std::size_t k = 0; k < weight.size(); ++k) {
      const auto frequency = static_cast<double>(k + 1);
      r += weight[k] * std::cos(frequency * t + phase[k]);
      slope -= weight[k] * frequency * std::sin(frequency * t + phase[k]);
    }
    const Vec2 out = at_angle(t, 1);
    point = r * out;
    tangent = slope * out + r * left_of(out);
    tangent = (1 / norm(tangent)) * tangent;
  };
  std::vector<Vec2> points(n);
  std::vector<Vec2> tangents(n);
  for (std::size_t i = 0; i < n; ++i) {
    curve(2 * pi * static_cast<double>(i) / static_cast<double>(n), points[i], tangents[i]);
  }
  Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 p = points[i];
    const Vec2 q = points[(i + 1) % n];
    const Vec2 t = tangents[i];
    const Vec2 u = tangents[(i + 1) % n];
    // The joint of the biarc whose two tangent lengths d are equal: |q - p - d (t + u)| = 2 d.
    const Vec2 v = q - p;
    const double linear = dot(v, t + u);
    const double square = 2 * (1 - dot(t, u));
    const double d = dot(v, v) / (linear + std::sqrt(linear * linear + square * dot(v, v)));
    const Vec2 joint = midpoint(p + d * t, q - d * u);
    ring.points.push_back(p);
    ring.bulges.push_back(bulge_from(t, joint - p));
    ring.points.push_back(joint);
    ring.bulges.push_back(0 - bulge_from(-u, joint - q));
  }
  return ring;
}

Rings circle_grid(std::size_t k, double radius) {
  const auto side = static_cast<double>(k);
  Rings rings = rectangle(side, side);
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t j = 0; j < k; ++j) {
      rings.push_back(circle({static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5}, radius));
      rings.back().role = RingRole::hole;
    }
  }
  rings[0].role = RingRole::outer;
  for (Ring& ring : rings) ring.role = RingRole::any;
  return rings;
}

Ring arcs_of_circle(int n) {
  constexpr double turn = 0.1;
  Ring ring;
  for (int i = 0; i < n; ++i) {
    ring.points.push_back(at_angle(2 * pi * i / n + turn, 1));
    ring.bulges.push_back(std::tan(pi / (2 * n)));
  }
  return ring;
}

Ring with_digits(Ring ring, int point_digits, int bulge_digits) {
  const auto rounded_to = [](double x, int digits) {
    const double scale = std::pow(10.0, digits);
    return std::round(x * scale) / scale;
  };
  for (Vec2& p : ring.points) p = {rounded_to(p.x, point_digits), rounded_to(p.y, point_digits)};
  for (double& bulge : ring.bulges) bulge = rounded_to(bulge, bulge_digits);
  return ring;
}

Ring near_circle(int index) {
  constexpr std::array point_digits{3, 5, 8, 10, 12};
  constexpr std::array bulge_digits{3, 6, 8, 9, 11, 13};
  constexpr int rounded = static_cast<int>(point_digits.size() * bulge_digits.size());
  const int n = 3 + index / near_circles_of_each_count, kind = index % near_circles_of_each_count;
  Ring ring = arcs_of_circle(n);
  if (kind < rounded) {
    const auto i = static_cast<std::size_t>(kind);
    return with_digits(std::move(ring), point_digits[i / bulge_digits.size()],
                       bulge_digits[i % bulge_digits.size()]);
  }
  const int i = kind - rounded;
  const double size = std::pow(10.0, -(3 + i / 3));
  Random random(static_cast<std::uint64_t>(n * 1000 + i));
  if (i % 3 != 1)
    for (Vec2& p : ring.points)
      p = p + Vec2{random.between(-size, size), random.between(-size, size)};
  if (i % 3 != 0)
    for (double& bulge : ring.bulges) bulge *= 1 + random.between(-size, size);
  return ring;
}

namespace {

std::size_t random_size(Random& random, double low, double high) {
  return static_cast<std::size_t>(std::lround(low * std::pow(high / low, random.unit())));
}

/// A disk with circular holes that touch each other or it, or nearly so.
Rings tangent_circles(Random& random, double gap) {
  Rings rings = {circle({0, 0}, 1, random.between(0, pi))};
  const double first = random.between(0.2, 0.6);
  const double angle = random.between(0, 2 * pi);
  rings.push_back(circle(at_angle(angle, 1 - first - gap), first, random.between(0, pi)));
  if (random.chance(0.6)) {
    // Opposite, in the rest of the diameter.
    const double room = 2 - 2 * first;
    const double second =
        random.chance(0.5) ? (room - 2 * gap) / 2 : random.between(0.1, 0.4) * room;
    rings.push_back(circle(at_angle(angle + pi, 1 - second - gap / 2), second,
                           random.chance(0.5) ? angle : random.between(0, pi)));
  }
  return rings;
}

/// Smooth rings in each other.
Rings nested_biarcs(Random& random, std::size_t n, std::size_t depth) {
  Rings rings;
  double scale = 1;
  for (std::size_t i = 0; i < depth; ++i) {
    rings.push_back(scaled(smooth_biarcs(random, n, static_cast<int>(n) / 16), scale, {0, 0}));
    scale *= 0.3;
  }
  return rings;
}

Ring with_role_any(Ring ring) {
  ring.role = RingRole::any;
  return ring;
}

}  // namespace

RandomShape random_arc_shape(std::uint64_t seed) {
  Random random(seed * 2 + 1);
  const auto anywhere = [&](std::string kind, Rings rings, bool rigid = true) {
    for (Ring& ring : rings) ring = with_role_any(std::move(ring));
    if (random.chance(0.5)) rings = placed(random, rings);
    return RandomShape{std::move(kind), std::move(rings), rigid};
  };
  switch (random.integer(0, 15)) {
    case 0:
      return anywhere("bent star", bent(random, {star(random, random_size(random, 4, 60))}));
    case 1:
      return anywhere("bent untangled",
                      bent(random, untangled(random, random_size(random, 3, 40), 1 << 20)));
    case 2:
      return anywhere("bent star with holes",
                      bent(random, star_with_holes(random, random_size(random, 12, 30),
                                                   random_size(random, 1, 3))));
    case 3:
      return anywhere("bent lattice cells",
                      bent(random, lattice_cells(random, random_size(random, 2, 40),
                                                 {.touching = false, .equal_steps = false})));
    case 4:
      return anywhere("bent lattice cells that touch",
                      bent(random, lattice_cells(random, random_size(random, 2, 40)), 0.5), false);
    case 5:
      return anywhere("smooth biarcs", {smooth_biarcs(random, random_size(random, 32, 400), 2)});
    case 6:
      return anywhere("smooth biarcs of many waves",
                      {smooth_biarcs(random, random_size(random, 160, 400), 10)});
    case 7:
      return anywhere("nested smooth biarcs",
                      nested_biarcs(random, random_size(random, 16, 64),
                                    static_cast<std::size_t>(random.integer(2, 5))));
    case 8: {
      Rings rings = lattice_cells(random, random_size(random, 2, 40), {.touching = false});
      const double radius = random.chance(0.3) ? random.power_of_ten(-9, -2) : random.between(0, 1);
      for (Ring& ring : rings) ring = rounded(ring, radius);
      return anywhere("rounded lattice cells", std::move(rings), false);
    }
    case 9: {
      Rings rings = {rounded(star(random, random_size(random, 4, 60)), random.between(0, 0.1))};
      return anywhere("rounded star", std::move(rings));
    }
    case 10: {
      const bool touching = random.chance(0.5);
      return anywhere("tangent circles",
                      tangent_circles(random, touching ? 0 : random.power_of_ten(-12, -1)), false);
    }
    case 11:
      return anywhere("circle grid",
                      circle_grid(random_size(random, 1, 5),
                                  random.chance(0.4) ? 0.5 : 0.5 - random.power_of_ten(-12, -1)),
                      false);
    case 12: {
      Rings rings = {gear(random_size(random, 3, 40), random.between(0.5, 0.95))};
      if (random.chance(0.7)) rings.push_back(circle({0, 0}, random.between(0.05, 0.45)));
      return anywhere("gear", std::move(rings), false);
    }
    case 13: {
      const std::size_t n = random_size(random, 2, 30);
      const bool inward = n > 2 && random.chance(0.5);
      const double angle = pi - 2 * pi / static_cast<double>(n);
      const double most = inward ? std::tan(0.2 * angle) : 1;
      const double factor = random.chance(0.3) ? random.power_of_ten(-13, -1) : random.unit();
      const double bulge = inward ? -most * factor : most * factor + 1e-15;
      return anywhere("bulged polygon", {bulged_polygon(n, bulge)}, false);
    }
    case 14: {
      Rings rings = {stadium({0, 0}, {random.power_of_ten(-3, 1), 0}, 1)};
      if (random.chance(0.5)) rings.push_back(circle({0, 0}, random.between(0.01, 0.99)));
      return anywhere("stadium", std::move(rings), false);
    }
    default: {
      Rings rings = {circle({0, 0}, 1, random.between(0, pi))};
      if (random.chance(0.8)) {
        const double radius = random.power_of_ten(-6, -0.3);
        const double offset = random.chance(0.3) ? 0 : random.between(0, 0.95 * (1 - radius));
        rings.push_back(circle(at_angle(random.between(0, 2 * pi), offset), radius));
      }
      return anywhere("annulus", std::move(rings), false);
    }
  }
}

namespace {

Contour closed_spline(Random& random, Vec2 center, double radius) {
  const auto degree = static_cast<std::size_t>(random.integer(2, 5));
  const auto n = static_cast<std::size_t>(random.integer(10, 30));
  std::vector<Vec2> control;
  for (std::size_t i = 0; i < n; ++i)
    control.push_back(center + at_angle(2 * pi * static_cast<double>(i) / static_cast<double>(n),
                                        radius * random.between(0.7, 1.3)));
  for (std::size_t i = 0; i < degree; ++i) control.push_back(control[i]);
  std::vector<double> knots(control.size() + degree + 1);
  for (std::size_t i = 0; i < knots.size(); ++i) knots[i] = static_cast<double>(i);
  Contour contour;
  if (!contour.spline_to(static_cast<std::uint32_t>(degree), knots, control)) return {};
  return contour;
}

}  // namespace

std::vector<Contour> random_splines(std::uint64_t seed) {
  Random random(seed * 2 + 1);
  std::vector<Contour> contours{closed_spline(random, {0, 0}, 1)};
  const auto holes = static_cast<int>(random.integer(0, 4));
  const double turn = random.between(0, pi);
  for (int i = 0; i < holes; ++i)
    contours.push_back(
        closed_spline(random, at_angle(turn + 0.5 * pi * i, 0.3), random.between(0.02, 0.1)));
  return contours;
}

}  // namespace medial::test
