// Circles as files have them: arcs whose coordinates and bulges have few digits. Their arcs'
// centres and radii differ by anything between a rounding and a thousandth, and all of the axis
// lies between the centres.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "medial/medial.h"
#include "support/generate.h"
#include "support/property.h"
#include "support/random_shapes.h"

namespace medial::test {
namespace {

double rounded_to(double x, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(x * scale) / scale;
}

/// The vertices of a regular n-gon in the unit circle, joined by the arcs of the circle.
Ring arcs_of_circle(int n) {
  constexpr double turn = 0.1;
  Ring ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n + turn;
    ring.points.push_back({std::cos(angle), std::sin(angle)});
    ring.bulges.push_back(std::tan(std::numbers::pi / (2 * n)));
  }
  return ring;
}

Ring with_digits(Ring ring, int point_digits, int bulge_digits) {
  for (Vec2& p : ring.points) p = {rounded_to(p.x, point_digits), rounded_to(p.y, point_digits)};
  for (double& bulge : ring.bulges) bulge = rounded_to(bulge, bulge_digits);
  return ring;
}

std::string failures_of(const Ring& ring) {
  std::string text;
  for (const std::string& failure : check_axis({ring})) text += failure + "\n";
  return text;
}

class NearCircle : public testing::TestWithParam<int> {};

TEST_P(NearCircle, OfFewDigitsIsVerified) {
  for (const int point_digits : {3, 5, 8, 10, 12}) {
    for (const int bulge_digits : {3, 6, 8, 9, 11, 13})
      EXPECT_EQ(failures_of(with_digits(arcs_of_circle(GetParam()), point_digits, bulge_digits)),
                "")
          << point_digits << " digits, bulges " << bulge_digits;
  }
}

TEST_P(NearCircle, WithRandomErrorsIsVerified) {
  Random random(static_cast<std::uint64_t>(GetParam()));
  for (int e = 3; e <= 12; ++e) {
    const double size = std::pow(10.0, -e);
    Ring points = arcs_of_circle(GetParam()), bulges = points;
    for (Vec2& p : points.points)
      p = p + Vec2{random.between(-size, size), random.between(-size, size)};
    for (double& bulge : bulges.bulges) bulge *= 1 + random.between(-size, size);
    EXPECT_EQ(failures_of(points), "") << "points off by 1e-" << e;
    if (e < 10) {
      EXPECT_EQ(failures_of(bulges), "") << "bulges off by 1e-" << e;
    }
  }
}

/// To fifteen digits it is a circle: two half circles, and an axis of one node.
TEST_P(NearCircle, OfManyDigitsIsACircle) {
  const auto shape = build_shape(Rings{with_digits(arcs_of_circle(GetParam()), 15, 16)});
  ASSERT_TRUE(shape) << to_string(shape.error());
  EXPECT_EQ(shape->points.size(), 2);
  const auto axis = compute(*shape);
  ASSERT_TRUE(axis) << to_string(axis.error());
  EXPECT_EQ(axis->nodes.size(), 1);
  EXPECT_TRUE(verify(*shape, *axis).passed);
}

/// Vertices, bulges or both off by some tolerances. Nearly all are verified; the others are refused
/// by the certificate, for errors of a few tolerances.
TEST(CircleOfArcs, OffBySomeTolerancesIsNearlyAlwaysVerified) {
  const std::uint64_t count = shape_count(20, 100);
  std::uint64_t refused = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    Random random(seed);
    const auto n = static_cast<int>(random.integer(4, 100));
    Ring ring = arcs_of_circle(n);
    const double size = random.power_of_ten(-14.3, -12.7);
    const std::int64_t kind = random.integer(0, 2);
    if (kind != 1)
      for (Vec2& p : ring.points)
        p = p + Vec2{random.between(-size, size), random.between(-size, size)};
    if (kind != 0)
      for (double& bulge : ring.bulges)
        bulge *= 1 + random.between(-size, size) * (random.chance(0.5) ? n : 1);
    const auto failures = check_axis({ring});
    refused += failures.empty() ? 0 : 1;
    for (const std::string& failure : failures)
      EXPECT_EQ(failure.find("internal"), std::string::npos) << seed << ": " << failure;
  }
  EXPECT_LE(refused, count / 50);
}

/// An arc so short that its own curvature means nothing belongs to the circle around it.
TEST(CircleOfArcs, WithASliverIsACircle) {
  Ring ring;
  for (const double angle : {0.0, 1e-6, 2.0, 4.0})
    ring.points.push_back({std::cos(angle), std::sin(angle)});
  ring.bulges = {(1 + 1e-9) * std::tan(1e-6 / 4), std::tan((2.0 - 1e-6) / 4), std::tan(0.5),
                 std::tan((2 * std::numbers::pi - 4) / 4)};
  const auto shape = build_shape(Rings{ring});
  ASSERT_TRUE(shape) << to_string(shape.error());
  EXPECT_EQ(shape->points.size(), 2);
  EXPECT_EQ(failures_of(ring), "");
}

INSTANTIATE_TEST_SUITE_P(Arcs, NearCircle, testing::Values(3, 4, 5, 8, 12, 24, 64));

}  // namespace
}  // namespace medial::test
