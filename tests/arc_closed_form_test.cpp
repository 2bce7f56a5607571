// Shapes with arcs whose medial axis is known in closed form, to 1e-12 of the diagonal, again under
// every symmetry: all leaves and branching nodes, the length, and where disks of every edge lie.
//
// Inside a circle of radius R around m, a disk has r = R - |c - m|; outside of one, r = |c - m| -
// R. So two circles make ellipses and hyperbolas with their centres as foci, a line and a circle a
// parabola.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "axis/steps.h"
#include "medial/medial.h"
#include "support/generate_arcs.h"

namespace medial::test {
namespace {

const double root2 = std::sqrt(2.0);
const double root3 = std::sqrt(3.0);
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Length of the parabola with distance p between focus and directrix, from its apex to u.
double parabola_length(double p, double u) {
  const double s = u / p;
  return p / 2 * (s * std::sqrt(1 + s * s) + std::asinh(s));
}

/// Perimeter of the ellipse with half axis a and eccentricity e.
double ellipse_length(double a, double e) { return 4 * a * std::comp_ellint_2(e); }

struct ExpectedNode {
  Vec2 center;
  double radius;
  std::size_t degree;  ///< 1 or above 2, or 0 for a circle's only node
};

struct ArcCase {
  std::string name;
  Rings rings;
  std::vector<ExpectedNode> nodes;  ///< all but changes of sites
  double length = unknown;
  /// 0 on the axis; grows like the distance from it.
  std::function<double(const Disk&)> locus = {};
  /// The joints' angles do not survive rounding to the spacing of distant coordinates.
  bool delicate = false;
};

void check(const ArcCase& expected, const Symmetry& symmetry) {
  SCOPED_TRACE(expected.name + ", " + symmetry.name);
  const auto shape = build_shape(transformed(expected.rings, symmetry));
  ASSERT_TRUE(shape) << to_string(shape.error());
  const auto axis = compute(*shape, {.threads = 1});
  ASSERT_TRUE(axis) << to_string(axis.error());
  const Certificate certificate = verify(*shape, *axis, {.threads = 1});
  EXPECT_TRUE(certificate.passed) << certificate.failures.front();

  const Box box = bounding_box(*shape);
  const double far = std::max(
      {std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
  const double spacing = std::nextafter(far, INFINITY) - far;
  const double tolerance = 1e-12 * diagonal(box) + 8 * spacing;
  const double scale = symmetry.scale();
  const Incidence incidence(*axis);
  std::vector<bool> used(axis->nodes.size(), false);
  for (const ExpectedNode& node : expected.nodes) {
    const Vec2 center = symmetry(node.center);
    bool found = false;
    for (std::uint32_t i = 0; i < axis->nodes.size() && !found; ++i) {
      const Disk& disk = axis->nodes[i].disk;
      found = !used[i] && incidence.degree(i) == node.degree &&
              distance(disk.center, center) <= tolerance &&
              std::abs(disk.radius - scale * node.radius) <= tolerance;
      if (found) used[i] = true;
    }
    EXPECT_TRUE(found) << "no node of degree " << node.degree << ", radius " << scale * node.radius
                       << " at (" << center.x << ", " << center.y << ")";
  }
  for (std::uint32_t i = 0; i < axis->nodes.size(); ++i) {
    const Disk& disk = axis->nodes[i].disk;
    EXPECT_TRUE(used[i] || incidence.degree(i) == 2)
        << "unexpected node of degree " << incidence.degree(i) << ", radius " << disk.radius
        << " at (" << disk.center.x << ", " << disk.center.y << ")";
  }
  if (!std::isnan(expected.length)) {
    const double edges = static_cast<double>(axis->edges.size());
    EXPECT_NEAR(total_length(*axis), scale * expected.length, (edges + 1) * tolerance);
  }
  if (!expected.locus) return;
  double worst = 0;
  for (const Edge& edge : axis->edges) {
    for (int i = 0; i <= 8; ++i) {
      const Disk disk = disk_at(*axis, edge, i / 8.0);
      const Vec2 d = disk.center - Vec2{symmetry.dx, symmetry.dy};
      const double inverse = 1 / (scale * scale);
      const Disk back{{inverse * (symmetry.xx * d.x + symmetry.yx * d.y),
                       inverse * (symmetry.xy * d.x + symmetry.yy * d.y)},
                      disk.radius / scale};
      worst = std::max(worst, scale * std::abs(expected.locus(back)));
    }
  }
  EXPECT_LE(worst, 2 * tolerance);
}

void check_everywhere(const ArcCase& expected) {
  for (const Symmetry& symmetry : symmetries())
    if (!expected.delicate || symmetry.dx != 1e7) check(expected, symmetry);
}

/// Points that follow each other, with the bulge of the edge after each.
Ring arcs(std::vector<Vec2> points, std::vector<double> bulges) {
  return {.points = std::move(points), .role = RingRole::any, .bulges = std::move(bulges)};
}

TEST(ArcClosedForm, CircleIsOneNode) {
  check_everywhere({"circle", {circle({1, 2}, 1.5)}, {{{1, 2}, 1.5, 0}}, 0});
  for (const std::size_t n : {3U, 5U, 8U}) {
    const double bulge = std::tan(std::numbers::pi / (2 * static_cast<double>(n)));
    check_everywhere({"circle of " + std::to_string(n) + " arcs",
                      {bulged_polygon(n, bulge)},
                      {{{0, 0}, 1, 0}},
                      0,
                      {},
                      true});
  }
}

TEST(ArcClosedForm, Annulus) {
  check_everywhere(
      {"annulus",
       {circle({0, 0}, 2), circle({0, 0}, 1)},
       {},
       3 * std::numbers::pi,
       [](const Disk& d) { return std::abs(norm(d.center) - 1.5) + std::abs(d.radius - 0.5); }});
}

TEST(ArcClosedForm, HoleOffCentreIsAnEllipse) {
  const Vec2 hole{0.4, 0.3};
  check_everywhere({"hole off centre",
                    {circle({0, 0}, 2), circle(hole, 1)},
                    {},
                    ellipse_length(1.5, 0.25 / 1.5),
                    [=](const Disk& d) {
                      return std::abs(norm(d.center) + distance(d.center, hole) - 3) +
                             std::abs(2 - norm(d.center) - d.radius);
                    }});
}

TEST(ArcClosedForm, TangentHoleIsAnOpenEllipse) {
  const Vec2 hole{1.25, 0};
  check_everywhere({"tangent hole",
                    {circle({0, 0}, 2), circle(hole, 0.75)},
                    {{{2, 0}, 0, 1}, {{2, 0}, 0, 1}},
                    ellipse_length(1.375, 0.625 / 1.375),
                    [=](const Disk& d) {
                      return std::abs(norm(d.center) + distance(d.center, hole) - 2.75) +
                             std::abs(2 - norm(d.center) - d.radius);
                    },
                    true});
}

TEST(ArcClosedForm, TangentCirclesAreTwoNodes) {
  check_everywhere({"tangent circles",
                    {circle({0, 0}, 2), circle({3, 0}, 1)},
                    {{{0, 0}, 2, 0}, {{3, 0}, 1, 0}},
                    0});
}

TEST(ArcClosedForm, Stadium) {
  check_everywhere(
      {"stadium",
       {stadium({1, 1}, {4, 1}, 0.75)},
       {{{1, 1}, 0.75, 1}, {{4, 1}, 0.75, 1}},
       3,
       [](const Disk& d) { return std::abs(d.center.y - 1) + std::abs(d.radius - 0.75); }});
  check_everywhere({"stadium along a diagonal",
                    {stadium({0, 0}, {3, 4}, 2)},
                    {{{0, 0}, 2, 1}, {{3, 4}, 2, 1}},
                    5,
                    {},
                    true});
}

TEST(ArcClosedForm, Lens) {
  for (const double bulge : {0.9, 0.3, 0.01, 1e-6}) {
    const double radius = (1 + bulge * bulge) / (2 * bulge), off = radius - bulge;
    check_everywhere({"lens " + std::to_string(bulge),
                      {arcs({{0, 0}, {2, 0}}, {bulge, bulge})},
                      {{{0, 0}, 0, 1}, {{2, 0}, 0, 1}},
                      2,
                      [=](const Disk& d) {
                        // R - sqrt(x^2 + off^2), without cancellation.
                        const double x = d.center.x - 1;
                        const double r = (1 - x * x) / (radius + std::hypot(x, off));
                        return std::abs(d.center.y) + std::abs(d.radius - r);
                      }});
  }
}

TEST(ArcClosedForm, CrookedLensIsAHyperbola) {
  const double a = 0.5, b = 0.2;
  const double radius_a = (1 + a * a) / (2 * a), radius_b = (1 + b * b) / (2 * b);
  const Vec2 center_a{1, radius_a - a}, center_b{1, b - radius_b};
  check_everywhere({"crooked lens",
                    {arcs({{0, 0}, {2, 0}}, {a, b})},
                    {{{0, 0}, 0, 1}, {{2, 0}, 0, 1}},
                    unknown,
                    [=](const Disk& d) {
                      return std::abs(radius_a - distance(d.center, center_a) - d.radius) +
                             std::abs(radius_b - distance(d.center, center_b) - d.radius);
                    }});
}

TEST(ArcClosedForm, Reuleaux) {
  const Ring ring = bulged_polygon(3, std::tan(std::numbers::pi / 12));
  ArcCase reuleaux{"Reuleaux", {ring}, {{{0, 0}, root3 - 1, 3}}, 3};
  for (const Vec2 corner : ring.points) reuleaux.nodes.push_back({corner, 0, 1});
  check_everywhere(reuleaux);
}

TEST(ArcClosedForm, HalfCircleIsAParabola) {
  check_everywhere({"half circle",
                    {arcs({{-1, 0}, {1, 0}}, {0, 1})},
                    {{{-1, 0}, 0, 1}, {{1, 0}, 0, 1}},
                    2 * parabola_length(1, 1),
                    [](const Disk& d) {
                      return std::abs(d.center.y - d.radius) +
                             std::abs(1 - norm(d.center) - d.radius);
                    }});
}

TEST(ArcClosedForm, ArcsOverAHalfCircleAreSplit) {
  // A chord, and the arc of 300 degrees over it.
  const double h = root3 / 2, p = 1 - h;
  check_everywhere({"arc of 300 degrees",
                    {arcs({{-0.5, -h}, {0.5, -h}}, {0, std::tan(75 * std::numbers::pi / 180)})},
                    {{{-0.5, -h}, 0, 1}, {{0.5, -h}, 0, 1}},
                    2 * parabola_length(p, 0.5),
                    [=](const Disk& d) {
                      return std::abs(d.center.y + h - d.radius) +
                             std::abs(1 - norm(d.center) - d.radius);
                    }});
  // A corridor that opens into a round room, whose disk touches all of the arc: a leaf.
  const double y = 0.6, x = 0.8;  // on the unit circle
  const double half_angle = std::numbers::pi - std::asin(y);
  check_everywhere({"keyhole",
                    {arcs({{x, -y}, {3, -y}, {3, y}, {x, y}}, {0, 0, 0, std::tan(half_angle / 2)})},
                    {{{0, 0}, 1, 1}, {{3 - y, 0}, y, 3}, {{3, -y}, 0, 1}, {{3, y}, 0, 1}},
                    3 - y + 2 * y * root2,
                    {}});
}

TEST(ArcClosedForm, RectangleAroundACircularHole) {
  // By symmetry the corner branches run on the diagonals of the corners' squares.
  const double r = (3 * root2 - 1) / (1 + root2);  // r root2 + r + 1 = 3 root2
  ArcCase square{"square around a circle",
                 {rectangle(6, 6).front(), circle({3, 3}, 1)},
                 {},
                 4 * (r * root2) + 8 * parabola_length(4, 3 - r)};
  for (const double x : {0.0, 6.0}) {
    for (const double y : {0.0, 6.0}) {
      square.nodes.push_back({{x, y}, 0, 1});
      square.nodes.push_back({{x == 0 ? r : 6 - r, y == 0 ? r : 6 - r}, r, 3});
    }
  }
  check_everywhere(square);
}

// Arcs at convex corners cut the axis off at their radius; nothing else changes.

TEST(ArcClosedForm, RoundedRectangles) {
  for (const double radius : {1.0, 0.25, 1e-3, 1e-6, 1e-9}) {
    ArcCase rounded_one{"corners of radius " + std::to_string(radius),
                        {rounded(rectangle(5, 3).front(), radius)},
                        {{{1.5, 1.5}, 1.5, 3}, {{3.5, 1.5}, 1.5, 3}},
                        2 + 4 * (1.5 - radius) * root2,
                        {},
                        true};
    for (const double x : {radius, 5 - radius})
      for (const double y : {radius, 3 - radius}) rounded_one.nodes.push_back({{x, y}, radius, 1});
    check_everywhere(rounded_one);
  }
}

TEST(ArcClosedForm, RoundedStarsAreTruncated) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    // Convex: a regular polygon, each of whose vertices is moved a little.
    const std::size_t n = 3 + seed % 9;
    Ring polygon;
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * (static_cast<double>(i) + 0.3 * random.unit()) /
                           static_cast<double>(n);
      polygon.points.push_back({std::cos(angle), std::sin(angle)});
    }
    const double radius = 0.02 + 0.05 * random.unit();
    const auto sharp_shape = build_shape(Rings{polygon});
    const auto round_shape = build_shape(Rings{rounded(polygon, radius)});
    ASSERT_TRUE(sharp_shape && round_shape);
    const auto sharp = compute(*sharp_shape, {.threads = 1});
    const auto round = compute(*round_shape, {.threads = 1});
    ASSERT_TRUE(sharp && round);
    const Certificate certificate = verify(*round_shape, *round, {.threads = 1});
    EXPECT_TRUE(certificate.passed) << certificate.failures.front();
    bool branches_early = false;
    for (const Node& node : sharp->nodes)
      branches_early |= node.kind != NodeKind::leaf && node.disk.radius < 1.01 * radius;
    if (branches_early) continue;
    EXPECT_EQ(certificate.curvature_leaves, n);
    // The length cut off at a corner of the angle a is radius / sin(a / 2).
    double length = total_length(*sharp);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 d = polygon.points[(i + 1) % n] - polygon.points[i];
      const Vec2 e = polygon.points[(i + n - 1) % n] - polygon.points[i];
      length -= radius / std::sin(0.5 * std::atan2(cross(d, e), dot(d, e)));
    }
    EXPECT_NEAR(total_length(*round), length, 1e-11);
    const AxisLocator locator(*sharp);
    for (const Edge& edge : round->edges) {
      for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const Disk disk = disk_at(*round, edge, t);
        const AxisPoint point = locator.nearest(disk.center);
        EXPECT_LE(point.distance, 1e-12);
        EXPECT_NEAR(point.disk.radius, disk.radius, 1e-12);
      }
    }
  }
}

/// One disk touches every tooth or side, and the rest of the axis consists of as many branches:
/// where two contacts enclose a small angle, the rounding of their coordinates must not move it.
TEST(ArcClosedForm, ManyArcsAroundOneNode) {
  for (const std::size_t n : {3U, 30U, 300U, 2000U}) {
    std::vector<ArcCase> cases;
    cases.push_back({"gear of " + std::to_string(n), {gear(n, 0.8)}, {}});
    cases.push_back({"lobes, " + std::to_string(n), {bulged_polygon(n, 0.5)}, {}});
    for (const double bulge : {1e-12, 1e-3})
      cases.push_back({"sides, " + std::to_string(n), {bulged_polygon(n, bulge)}, {}});
    for (const ArcCase& one : cases) {
      for (const double offset : {0.0, 17.3}) {
        Symmetry symmetry;
        symmetry.xx = symmetry.yy = 0.8;
        symmetry.yx = 0.6;
        symmetry.xy = -0.6;
        symmetry.dx = offset;
        SCOPED_TRACE(one.name + ", moved by " + std::to_string(offset));
        const auto shape = build_shape(transformed(one.rings, symmetry));
        ASSERT_TRUE(shape) << to_string(shape.error());
        const auto axis = compute(*shape, {.threads = 1});
        ASSERT_TRUE(axis) << to_string(axis.error());
        const Certificate certificate = verify(*shape, *axis, {.threads = 1});
        EXPECT_TRUE(certificate.passed) << certificate.failures[0];
      }
    }
  }
}

// Arcs of huge radius are as good as straight.

/// The two corners of a pocket's mouth and the nearly straight wall opposite: the disk that touches
/// all three is where it would be beside a straight wall, but for the wall's sag, at every radius
/// of the wall.
TEST(ArcClosedForm, TwoVerticesOppositeToAnArcOfHugeRadius) {
  for (const double bulge : {1e-5, 1e-7, 3e-8, 1e-8, 1e-9, 1e-10, 1e-12}) {
    SCOPED_TRACE(bulge);
    Ring ring{
        {{0, -3}, {3, -3}, {3, 1}, {5, 1}, {5, 2}, {3, 2}, {3, 6}, {0, 6}}, RingRole::any, {}};
    ring.bulges.assign(ring.points.size(), 0);
    ring.bulges[7] = bulge;  // the side at x = 0
    const auto shape = build_shape(Rings{ring});
    ASSERT_TRUE(shape);
    const auto axis = compute(*shape, {.threads = 1});
    ASSERT_TRUE(axis) << to_string(axis.error());
    const Certificate certificate = verify(*shape, *axis, {.threads = 1});
    EXPECT_TRUE(certificate.passed) << certificate.failures.front();
    // x = r, and (3 - r)^2 + 1/4 = r^2.
    EXPECT_NEAR(AxisLocator(*axis).nearest({9.25 / 6, 1.5}).distance, 0, 8 * bulge + 1e-14);
    EXPECT_EQ(axis->statistics.brackets, 0);
  }
}

TEST(ArcClosedForm, NearlyStraightEdges) {
  const auto straight_shape = build_shape(rectangle(5, 3));
  ASSERT_TRUE(straight_shape);
  const auto straight = compute(*straight_shape, {.threads = 1});
  ASSERT_TRUE(straight);
  for (const double times : {1e6, 1e9, 1e12, 1e15, 1e30}) {
    for (const double sign : {1.0, -1.0}) {
      SCOPED_TRACE(sign * times);
      Ring ring = rectangle(5, 3).front();
      for (std::size_t i = 0; i < 4; ++i) {
        const double chord = i % 2 == 0 ? 5 : 3;
        ring.bulges.push_back(sign * chord / (4 * 5 * times));
      }
      const auto shape = build_shape(Rings{ring});
      ASSERT_TRUE(shape);
      const auto axis = compute(*shape, {.threads = 1});
      ASSERT_TRUE(axis);
      const Certificate certificate = verify(*shape, *axis, {.threads = 1});
      EXPECT_TRUE(certificate.passed) << certificate.failures.front();
      ASSERT_EQ(axis->nodes.size(), straight->nodes.size());
      EXPECT_EQ(axis->edges.size(), straight->edges.size());
      const double moved = 5 / times + 1e-13;  // the height of an arc is below its chord^2 / (8 R)
      EXPECT_NEAR(total_length(*axis), total_length(*straight), 10 * moved);
      for (const Node& node : straight->nodes) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Node& other : axis->nodes)
          nearest = std::min(nearest, distance(node.disk.center, other.disk.center) +
                                          std::abs(node.disk.radius - other.disk.radius));
        EXPECT_LE(nearest, moved);
      }
    }
  }
}

// An ellipse's leaves are at the centres of its largest curvature, (a^2 - b^2) / a from its centre.

TEST(ArcClosedForm, EllipseOfBiarcs) {
  const double a = 2, b = 1;
  double before = std::numeric_limits<double>::infinity();
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    SCOPED_TRACE(tolerance);
    Contour contour;
    contour.ellipse_to({0, 0}, {a, 0}, {0, b}, 0, 2 * std::numbers::pi);
    const auto rings =
        approximate_by_arcs(std::span(&contour, 1), {.tolerance = tolerance, .relative = false});
    ASSERT_TRUE(rings) << to_string(rings.error());
    const auto shape = build_shape(*rings);
    ASSERT_TRUE(shape) << to_string(shape.error());
    const auto axis = compute(*shape, {.threads = 1});
    ASSERT_TRUE(axis) << to_string(axis.error());
    const Certificate certificate = verify(*shape, *axis, {.threads = 1});
    EXPECT_TRUE(certificate.passed) << certificate.failures.front();
    EXPECT_EQ(certificate.curvature_leaves, 2U);
    double worst = 0;
    for (const Node& node : axis->nodes) {
      EXPECT_NEAR(node.disk.center.y, 0, 2 * tolerance);
      if (node.kind != NodeKind::leaf) continue;
      worst = std::max(worst, std::abs(std::abs(node.disk.center.x) - (a * a - b * b) / a) +
                                  std::abs(node.disk.radius - b * b / a));
    }
    // The arc at the apex is its osculating circle, or comes nearer to it as fast as the arcs grow
    // shorter: by the cube root of the tolerance, at least.
    EXPECT_LE(worst, 4 * std::cbrt(tolerance));
    EXPECT_LE(worst, before + 1e-12);
    before = worst;
    // Between the leaves the disks stay those of the ellipse: r^2 = b^2 (1 - x^2 / (a^2 - b^2)).
    for (const Edge& edge : axis->edges) {
      const Disk disk = disk_at(*axis, edge, 0.5);
      const double x = disk.center.x;
      const double squared = b * b * (1 - x * x / (a * a - b * b));
      if (std::abs(x) < 1.4) {
        EXPECT_NEAR(disk.radius, std::sqrt(squared), 4 * tolerance);
      }
    }
  }
}

}  // namespace
}  // namespace medial::test
