// Queries on edges with arcs, which are conics of any weight, and on shapes with arcs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "axis/curve.h"
#include "medial/medial.h"
#include "support/generate_arcs.h"

namespace medial {
namespace {

using std::numbers::pi;

MedialAxis conic(const Disk& from, const Disk& control, const Disk& to, double weight) {
  MedialAxis axis;
  axis.nodes = {{from, 0, NodeKind::leaf}, {to, 0, NodeKind::leaf}};
  axis.edges = {{{0, 1}, {0, 0}, control, weight}};
  return axis;
}

/// The arc of the unit circle from -angle to angle, seen from (0, 0), stretched in x and y.
MedialAxis ellipse_arc(double angle, double stretch_x = 1, double stretch_y = 1) {
  const double c = std::cos(angle), s = std::sin(angle);
  return conic({{stretch_x * c, -stretch_y * s}, 1}, {{stretch_x / c, 0}, 1},
               {{stretch_x * c, stretch_y * s}, 1}, c);
}

/// The branch of x^2 - y^2 = 1 from -u to u.
MedialAxis hyperbola_arc(double u) {
  const double c = std::cosh(u), s = std::sinh(u);
  return conic({{c, -s}, 1}, {{1 / c, 0}, 1}, {{c, s}, 1}, c);
}

/// Chords over n steps of an even parametrisation, and over twice as many: Richardson's
/// extrapolation.
template <class Point>
double length_by_chords(const Point& point, int n = 20000) {
  double coarse = 0, fine = 0;
  for (int i = 0; i < n; ++i) {
    const Vec2 a = point(static_cast<double>(i) / n), b = point((i + 0.5) / n),
               c = point((i + 1.0) / n);
    coarse += distance(a, c);
    fine += distance(a, b) + distance(b, c);
  }
  return fine + (fine - coarse) / 3;
}

std::vector<MedialAxis> conics() {
  std::vector<MedialAxis> all;
  for (const double angle : {1e-6, 0.01, 0.3, pi / 4, 1.2, 1.5, 1.57}) {
    all.push_back(ellipse_arc(angle));
    all.push_back(ellipse_arc(angle, 3, 1));
    all.push_back(ellipse_arc(angle, 1, 20));
  }
  for (const double u : {1e-6, 0.01, 0.5, 2.0, 6.0}) all.push_back(hyperbola_arc(u));
  return all;
}

TEST(Conic, LengthOfACircle) {
  for (const double angle : {1e-5, 1e-3, 0.1, 0.5, pi / 4, 1.0, 1.3, 1.5, 1.57, pi / 2 - 1e-6}) {
    const MedialAxis axis = ellipse_arc(angle);
    EXPECT_NEAR(total_length(axis), 2 * angle, 1e-13 * angle) << angle;
  }
}

TEST(Conic, LengthOfAnEllipse) {
  for (const double a : {1.0, 1.1, 2.0, 10.0, 1000.0}) {
    // A quarter: the control point is the corner of the box.
    const MedialAxis axis = conic({{a, 0}, 1}, {{a, 1}, 1}, {{0, 1}, 1}, std::sqrt(0.5));
    const double expected = a * std::comp_ellint_2(std::sqrt((a - 1) * (a + 1)) / a);
    EXPECT_NEAR(total_length(axis), expected, 1e-12 * expected) << a;
  }
}

TEST(Conic, LengthAgainstChords) {
  for (const double angle : {0.2, 0.9, 1.4}) {
    const double expected = length_by_chords([&](double t) {
      const double u = angle * (2 * t - 1);
      return Vec2{3 * std::cos(u), 0.5 * std::sin(u)};
    });
    EXPECT_NEAR(total_length(ellipse_arc(angle, 3, 0.5)), expected, 1e-12 * expected);
  }
  for (const double angle : {0.1, 1.0, 3.0}) {
    const double expected = length_by_chords([&](double t) {
      const double u = angle * (2 * t - 1);
      return Vec2{std::cosh(u), std::sinh(u)};
    });
    EXPECT_NEAR(total_length(hyperbola_arc(angle)), expected, 1e-11 * expected);
  }
}

TEST(Conic, LengthsOfPartsAddUp) {
  for (const MedialAxis& axis : conics()) {
    const Curve curve = curve_of(axis, axis.edges[0]);
    const double whole = curve.length();
    double before = 0;
    for (int i = 1; i <= 20; ++i) {
      const double t = i / 20.0;
      const double so_far = curve.length(t);
      EXPECT_GT(so_far, before);
      before = so_far;
      EXPECT_NEAR(curve.length(curve.at_length(i / 20.0 * whole)), i / 20.0 * whole, 1e-12 * whole);
    }
    EXPECT_NEAR(before, whole, 1e-12 * whole);
  }
}

TEST(Conic, StepsHaveOneLength) {
  for (const MedialAxis& axis : conics()) {
    const double whole = total_length(axis);
    const std::vector<Disk> samples = sample_by_step(axis, axis.edges[0], whole / 500);
    ASSERT_GE(samples.size(), 501U);
    double longest = 0, shortest = whole;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
      const double step = distance(samples[i].center, samples[i + 1].center);
      longest = std::max(longest, step);
      shortest = std::min(shortest, step);
    }
    EXPECT_LE(longest, whole / 500 * (1 + 1e-9));
    // The chords in the sharpest turn are a little shorter.
    EXPECT_GE(shortest, whole / 500 * 0.9);
  }
}

TEST(Conic, ChordsStayWithinTheirBound) {
  for (const MedialAxis& axis : conics()) {
    const Edge& edge = axis.edges[0];
    const double size = total_length(axis);
    for (const double chord : {1e-1 * size, 1e-3 * size, 1e-6 * size}) {
      const std::vector<Disk> samples = sample_by_chord(axis, edge, chord);
      ASSERT_LT(samples.size(), 20000U);
      double worst = 0;
      for (int i = 0; i <= 1000; ++i) {
        const Disk disk = disk_at(axis, edge, i / 1000.0);
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j + 1 < samples.size(); ++j) {
          const Vec2 d = samples[j + 1].center - samples[j].center;
          const double t =
              std::clamp(dot(disk.center - samples[j].center, d) / squared_norm(d), 0.0, 1.0);
          nearest = std::min(nearest, distance(disk.center, samples[j].center + t * d));
        }
        worst = std::max(worst, nearest);
      }
      EXPECT_LE(worst, chord * (1 + 1e-9));
    }
  }
}

TEST(Conic, NearestPointAgainstManySamples) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const MedialAxis& axis : conics()) {
    const Curve curve = curve_of(axis, axis.edges[0]);
    const double size = curve.length();
    const Vec2 middle = curve.at(0.5).center;
    for (int k = 0; k < 30; ++k) {
      const Vec2 p = middle + (2 * size) * Vec2{unit(random), unit(random)};
      constexpr int samples = 4000;
      double best = std::numeric_limits<double>::infinity();
      for (int i = 0; i <= samples; ++i)
        best = std::min(best, distance(curve.at(static_cast<double>(i) / samples).center, p));
      const double found = distance(curve.at(curve.nearest(p)).center, p);
      EXPECT_LE(found, best * (1 + 1e-12));
      EXPECT_GE(found, best - 1e-3 * size);
    }
    for (const double t : {0.0, 0.1, 0.5, 0.9, 1.0})
      EXPECT_LE(norm(curve.at(curve.nearest(curve.at(t).center)).center - curve.at(t).center),
                1e-12 * size);
  }
}

TEST(Conic, AreaBesideTheChord) {
  for (const double angle : {1e-3, 0.05, 0.4, 1.0, 1.5}) {
    const MedialAxis axis = ellipse_arc(angle, 2, 0.7);
    // Twice (angle - sin angle cos angle) / 2 on each side of the x axis.
    const double expected = 1.4 * (2 * angle - std::sin(2 * angle)) / 2;
    EXPECT_NEAR(curve_of(axis, axis.edges[0]).area_beside_chord(), expected,
                1e-12 * expected + 1e-16);
  }
  for (const double u : {1e-3, 0.05, 0.4, 1.0, 4.0}) {
    const MedialAxis axis = hyperbola_arc(u);
    // The sector's area is u; the triangle's cosh u sinh u. The control point lies on the left.
    const double expected = 0.5 * std::sinh(2 * u) - u;
    EXPECT_NEAR(-curve_of(axis, axis.edges[0]).area_beside_chord(), expected,
                1e-12 * expected + 1e-15);
  }
}

TEST(Foot, OfAnArc) {
  const Site half{{1, 0}, {-1, 0}, 0, 0, 1};
  const auto near = [](Vec2 a, Vec2 b) { return distance(a, b) <= 4e-16; };
  EXPECT_TRUE(near(foot(half, {0, 0.5}), {0, 1}));
  EXPECT_TRUE(near(foot(half, {3, 4}), {0.6, 0.8}));
  EXPECT_EQ(foot(half, {3, -1}), (Vec2{1, 0}));
  EXPECT_EQ(foot(half, {-0.1, -1}), (Vec2{-1, 0}));
  // The other way round, and as flat as can be.
  const Site back{{-1, 0}, {1, 0}, 0, 0, -1};
  EXPECT_TRUE(near(foot(back, {3, 4}), {0.6, 0.8}));
  for (const double bulge : {1e-9, 1e-18, 1e-100, 1e-300}) {
    const Site flat{{0, 0}, {4, 0}, 0, 0, bulge};
    EXPECT_TRUE(near(foot(flat, {1, 0.5}), {1 - 0.5 * bulge, -1.5 * bulge})) << bulge;
    EXPECT_EQ(foot(flat, {-1, 0.5}), (Vec2{0, 0}));
  }
}

TEST(Clearance, InARoundShape) {
  for (const double start : {0.0, 0.7, 2.0, 3.5}) {
    const auto shape =
        build_shape(test::Rings{test::circle({3, 1}, 2, start), test::circle({3.5, 1}, 1, start)});
    ASSERT_TRUE(shape);
    for (int i = -30; i <= 30; ++i) {
      for (int j = -30; j <= 30; ++j) {
        const Vec2 p{3 + 0.1 * i, 1 + 0.1 * j};
        const double expected = std::min(2 - distance(p, {3, 1}), distance(p, {3.5, 1}) - 1);
        const double outside = std::max(distance(p, {3, 1}) - 2, 1 - distance(p, {3.5, 1}));
        if (std::abs(expected) < 1e-9) continue;
        const double found = clearance(*shape, p);
        if (expected > 0)
          EXPECT_NEAR(found, expected, 2e-15) << p.x << " " << p.y;
        else
          EXPECT_LT(found, 0) << p.x << " " << p.y;
        // Outside, the distance to the nearer of the two circles.
        if (expected < 0 && distance(p, {3, 1}) > 2) {
          EXPECT_NEAR(found, -outside, 2e-15);
        }
      }
    }
  }
}

TEST(Clearance, NextToTheChordsOfArcs) {
  // A rounded square: its chords cut through the inside, in all directions.
  const auto shape = build_shape(test::Rings{{.points = {{2, 0}, {4, 2}, {2, 4}, {0, 2}},
                                              .role = RingRole::any,
                                              .bulges = {0.3, 0.3, 0.3, 0.3}}});
  ASSERT_TRUE(shape);
  for (int i = 0; i < 4; ++i) {
    const Vec2 a = shape->points[static_cast<std::size_t>(i)],
               b = shape->points[static_cast<std::size_t>((i + 1) % 4)];
    for (int k = 1; k < 16; ++k)
      for (const double off : {0.0, 1e-16, -1e-16, 1e-9, -1e-9})
        EXPECT_GT(clearance(*shape, a + (k / 16.0) * (b - a) + off * left_of(b - a)), 0);
  }
  // Chords along both axes, one of them of an arc that turns inward.
  const auto square = build_shape(test::Rings{{.points = {{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                                               .role = RingRole::any,
                                               .bulges = {0.3, 0.3, -0.3, 0.3}}});
  ASSERT_TRUE(square);
  for (int k = 1; k < 16; ++k) {
    const double x = k / 4.0;
    EXPECT_GT(clearance(*square, {x, 0}), 0);
    EXPECT_GT(clearance(*square, {4, x}), 0);
    EXPECT_LT(clearance(*square, {x, 4}), 0);
    EXPECT_GT(clearance(*square, {0, x}), 0);
  }
}

TEST(AxisLocatorOnArcs, AgreesWithEveryEdge) {
  const auto shape = build_shape(test::Rings{test::circle({0, 0}, 2), test::circle({0.4, 0.3}, 1)});
  ASSERT_TRUE(shape);
  const auto axis = compute(*shape);
  ASSERT_TRUE(axis);
  const AxisLocator locator(*axis);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(-2, 2);
  for (int i = 0; i < 200; ++i) {
    const Vec2 p{unit(random), unit(random)};
    double best = std::numeric_limits<double>::infinity();
    for (const Edge& edge : axis->edges)
      for (int k = 0; k <= 2000; ++k)
        best = std::min(best, distance(disk_at(*axis, edge, k / 2000.0).center, p));
    const AxisPoint found = locator.nearest(p);
    EXPECT_LE(found.distance, best + 1e-15);
    EXPECT_GE(found.distance, best - 1e-3);
    EXPECT_NEAR(distance(found.disk.center, p), found.distance, 1e-14);
  }
}

}  // namespace
}  // namespace medial
