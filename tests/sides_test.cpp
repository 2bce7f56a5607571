// The two sides of an axis, its outline and its legality, on the axes of random shapes and on
// functions made by hand.
#include "medial/sides.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "medial/compute.h"
#include "ops/half_edges.h"
#include "support/random_shapes.h"

namespace medial {
namespace {

const std::uint64_t sides_count = test::shape_count(40);

using test::RandomShape;

/// Calls `check` with random shapes, straight and curved by turns, their axis and their diagonal.
template <class Check>
void for_shapes(const Check& check) {
  for (std::uint64_t seed = 0; seed < sides_count; ++seed) {
    const RandomShape random = test::random_any(seed);
    const auto shape = build_shape(random.rings);
    ASSERT_TRUE(shape.ok()) << seed;
    const auto axis = compute(*shape);
    ASSERT_TRUE(axis.ok()) << seed;
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    check(*shape, *axis, diagonal(bounding_box(*shape)));
    if (testing::Test::HasFailure()) return;
  }
}

/// One edge between disks, the rest of the axis empty.
MedialAxis axis_of(const Disk& from, const Disk& control, const Disk& to, double weight = 1) {
  MedialAxis axis;
  axis.nodes = {{from, 0, NodeKind::leaf}, {to, 0, NodeKind::leaf}};
  axis.edges.push_back({{0, 1}, {0, 1}, control, weight});
  return axis;
}

double curvature_of(const Site& site) {
  return site.kind() == SiteKind::arc
             ? 4 * site.bulge / (distance(site.start, site.end) * (1 + site.bulge * site.bulge))
             : 0;
}

TEST(Sides, OfExactEdgesAreTheirSites) {
  std::size_t checked = 0;
  for_shapes([&](const Shape&, const MedialAxis& axis, double size) {
    for (const Edge& edge : axis.edges) {
      for (const double t : {0.25, 0.5, 0.75}) {
        const AxisJet jet = jet_at(axis, edge, t);
        // Where a foot is hardly distinct from the other, or the edge is but rounding, so is the
        // rate.
        if (length(axis, edge) < 1e-5 * size || std::abs(jet.radius_rate) > 1 - 1e-6) continue;
        for (const Side side : {Side::left, Side::right}) {
          const Site& site = axis.sites[edge.site[side == Side::left ? 0 : 1]];
          const BoundaryJet boundary = boundary_at(jet, side);
          EXPECT_LE(distance(boundary.point, foot(site, jet.disk.center)), 1e-9 * size);
          if (site.kind() == SiteKind::vertex) {
            EXPECT_NEAR(boundary.rate, 0, 1e-4);
          } else if (boundary.rate > 1e-3) {
            EXPECT_NEAR(boundary.curvature * size, curvature_of(site) * size,
                        1e-4 * (1 + size * size / std::pow(length(axis, edge), 2)) * 1e-3 +
                            1e-6 * std::abs(curvature_of(site)) * size);
            ++checked;
          }
        }
      }
    }
  });
  EXPECT_GT(checked, 100U);
}

TEST(Sides, EveryBranchOfAnExactAxisIsLegal) {
  std::size_t checked = 0;
  for_shapes([&](const Shape&, const MedialAxis& axis, double) {
    for (const Legality& one : legality(axis)) {
      if (one.jets == 0) continue;
      EXPECT_TRUE(one.legal(0)) << one.steepness << " " << one.bend;
      ++checked;
    }
  });
  EXPECT_GT(checked, 100U);
}

TEST(Sides, TheOutlineOfAnExactAxisIsTheShape) {
  for_shapes([&](const Shape& shape, const MedialAxis& axis, double size) {
    const auto rings =
        approximate_by_arcs(ops::boundary_of(axis, Options{}.corner_angle), {.tolerance = 1e-9});
    ASSERT_TRUE(rings.ok()) << to_string(rings.error());
    double sum = 0;
    for (const Ring& ring : *rings) {
      for (std::size_t i = 0; i < ring.points.size(); ++i)
        ASSERT_NEAR(clearance(shape, ring.points[i]), 0, 1e-9 * size);
      for (std::size_t i = 0; i < ring.points.size(); ++i) {
        const Vec2 a = ring.points[i], b = ring.points[(i + 1) % ring.points.size()];
        sum += cross(a - ring.points[0], b - ring.points[0]) / 2;
        if (ring.bulges.empty() || ring.bulges[i] == 0) continue;
        const double angle = 4 * std::atan(ring.bulges[i]);
        const double radius = distance(a, b) / (2 * std::sin(std::abs(angle) / 2));
        sum += std::copysign(radius * radius / 2 * (std::abs(angle) - std::sin(std::abs(angle))),
                             angle);
      }
    }
    EXPECT_NEAR(sum, area(shape), 1e-9 * size * size);
  });
}

TEST(Sides, OneNodeIsAWholeCircle) {
  MedialAxis axis;
  axis.nodes.push_back({{{3, 4}, 2}, 0, NodeKind::leaf});
  const std::vector<Contour> contours = ops::boundary_of(axis, Options{}.corner_angle);
  ASSERT_EQ(contours.size(), 1U);
  ASSERT_EQ(contours[0].pieces.size(), 2U);
  for (const Vec2 p : contours[0].points) EXPECT_DOUBLE_EQ(distance(p, {3, 4}), 2);
}

/// Equations (3) to (8) on a curved edge of changing radius, against differences.
TEST(Sides, RatesAndCurvaturesAreDerivatives) {
  const MedialAxis axis = axis_of({{0, 0}, 1}, {{2, 1}, 1.3}, {{5, 1}, 1.1}, 0.8);
  const Edge& edge = axis.edges[0];
  const double h = 1e-5;
  for (const double t : {0.2, 0.5, 0.9}) {
    const double step = length(axis, edge) > 0 ? distance(jet_at(axis, edge, t + h).disk.center,
                                                          jet_at(axis, edge, t - h).disk.center)
                                               : 0;
    for (const Side side : {Side::left, Side::right}) {
      const auto at = [&](double u) { return boundary_at(jet_at(axis, edge, u), side); };
      const BoundaryJet here = at(t), before = at(t - h), after = at(t + h);
      const double moved = distance(before.point, after.point);
      EXPECT_NEAR(here.rate, moved / step, 1e-7);
      EXPECT_NEAR(distance(here.tangent, (1 / moved) * (after.point - before.point)), 0, 1e-7);
      const double turn = cross(before.tangent, after.tangent) / moved;
      EXPECT_NEAR(here.curvature, side == Side::left ? -turn : turn, 1e-6);
      EXPECT_DOUBLE_EQ(here.radius_of_curvature(), 1 / here.curvature);
      // (8) as the paper has it, with our sign of the curvature of the axis.
      const AxisJet f = jet_at(axis, edge, t);
      const double s = std::sqrt(1 - f.radius_rate * f.radius_rate);
      const double k = side == Side::left ? f.curvature : -f.curvature;
      EXPECT_NEAR(here.radius_of_curvature(),
                  f.disk.radius + (1 - f.radius_rate * f.radius_rate) / (-k * s - f.radius_bend),
                  1e-9 * std::abs(here.radius_of_curvature()));
      const auto all = boundary_curvatures(axis, edge, t, side, 2);
      ASSERT_EQ(all.size(), 3U);
      EXPECT_NEAR(all[0], here.curvature, 1e-12);
      const double slope = (after.curvature - before.curvature) / moved;
      EXPECT_NEAR(all[1], slope, 1e-6);
      const auto ahead = boundary_curvatures(axis, edge, t + h, side, 1);
      const auto behind = boundary_curvatures(axis, edge, t - h, side, 1);
      EXPECT_NEAR(all[2], (ahead[1] - behind[1]) / moved, 1e-6);
    }
  }
}

TEST(Sides, WhatIsTooSteepOrTooSharpIsIllegal) {
  const auto verdict = [](const MedialAxis& axis) { return legality(axis).at(0); };
  const Legality worm = verdict(axis_of({{0, 0}, 1}, {{1, 0}, 1}, {{2, 0}, 1}));
  EXPECT_TRUE(worm.legal(1e-12));
  EXPECT_TRUE(worm.strictly_legal(1e-12));
  // The radius grows faster than the length: 1.2 over 1.
  const Legality steep = verdict(axis_of({{0, 0}, 1}, {{1, 0}, 2.2}, {{2, 0}, 3.4}));
  EXPECT_FALSE(steep.legal(1e-12));
  EXPECT_NEAR(steep.steepness, 0.2, 1e-12);
  // A quarter of a circle of radius 1, with disks of radius 1.5.
  const Legality sharp =
      verdict(axis_of({{1, 0}, 1.5}, {{1, 1}, 1.5}, {{0, 1}, 1.5}, std::numbers::sqrt2 / 2));
  EXPECT_FALSE(sharp.legal(1e-12));
  EXPECT_NEAR(sharp.bend, 0.5, 1e-12);
  EXPECT_NEAR(sharp.steepness, -1, 1e-12);
  // With disks of radius 1 the inner boundary is the centre: legal, but not strictly.
  const Legality edge =
      verdict(axis_of({{1, 0}, 1}, {{1, 1}, 1}, {{0, 1}, 1}, std::numbers::sqrt2 / 2));
  EXPECT_TRUE(edge.legal(1e-12));
  EXPECT_FALSE(edge.strictly_legal(1e-12));
}

/// A pack's disks have its error: a violation that it explains is not reported, a larger one is.
TEST(Sides, WhatAPacksErrorExplainsIsNotIllegal) {
  MedialAxis axis;
  axis.method = "pack";
  for (std::uint32_t i = 0; i < 5; ++i) {
    const double x = i;
    axis.nodes.push_back({{{x, 0.0}, 1}, 0, NodeKind::site_change});
    if (i > 0) axis.edges.push_back({{i - 1, i}, {no_site, no_site}, {{x - 0.5, 0.0}, 1}, 1});
  }
  const auto judge = [&](double kink, double error) {
    axis.nodes[2].disk.center.y = kink;
    axis.resolution = error;
    const auto found = legality(axis);
    EXPECT_EQ(found.size(), 1U);
    return found.front();
  };
  EXPECT_GT(judge(0.6, 1e-6).bend, 0.1);  // K R = 1.2: no axis
  EXPECT_EQ(judge(0.6, 0.3).jets, 0U);
  EXPECT_EQ(judge(0.02, 1e-6).jets, 3U);
  EXPECT_TRUE(judge(0.02, 1e-6).legal(1e-9));
}

/// A branch of points has the jets of the curve that they lie on, to the second order.
TEST(Sides, SampledBranchesHaveJetsToo) {
  const MedialAxis exact = axis_of({{0, 0}, 1}, {{2, 1}, 1.3}, {{5, 1}, 1.1}, 0.8);
  MedialAxis sampled;
  sampled.resolution = 0.01;
  for (const Disk& disk : sample_by_step(exact, exact.edges[0], 0.01))
    sampled.nodes.push_back({disk, 0, NodeKind::site_change});
  for (std::uint32_t i = 0; i + 1 < sampled.nodes.size(); ++i) {
    const Disk &a = sampled.nodes[i].disk, &b = sampled.nodes[i + 1].disk;
    const Disk middle{midpoint(a.center, b.center), (a.radius + b.radius) / 2};
    sampled.edges.push_back({{i, i + 1}, {no_site, no_site}, middle, 1});
  }
  const auto found = legality(sampled), wanted = legality(exact, 500);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].jets, sampled.nodes.size() - 2);
  EXPECT_NEAR(found[0].steepness, wanted[0].steepness, 0.002);
  EXPECT_NEAR(found[0].bend, wanted[0].bend, 0.002);
  const std::vector<Contour> outline = ops::boundary_of(sampled, Options{}.corner_angle);
  ASSERT_EQ(outline.size(), 1U);
  for (const Vec2 p : outline[0].points) {
    double nearest = 1e9;
    for (const Node& node : sampled.nodes)
      nearest = std::min(nearest, distance(p, node.disk.center) - node.disk.radius);
    EXPECT_NEAR(nearest, 0, 1e-3);
  }
}

}  // namespace
}  // namespace medial
