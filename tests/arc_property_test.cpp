// The invariants of the medial axis over random shapes with arcs: see property_test.cpp, whose
// variables hold here too (4,000 shapes without them).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "medial/medial.h"
#include "methods/disks/boundary.h"
#include "support/curve_check.h"
#include "support/generate_arcs.h"
#include "support/property.h"
#include "support/random_shapes.h"

namespace medial::test {
namespace {

/// Dealt out to several tests, which can run side by side.
constexpr std::uint64_t arc_shares = 4;

class ArcShapes : public testing::TestWithParam<std::uint64_t> {
 protected:
  static void for_all(std::uint64_t count,
                      const std::function<std::vector<std::string>(const RandomShape&)>& check) {
    const std::uint64_t base = first_seed();
    int failed = 0;
    for (std::uint64_t i = GetParam(); i < count && failed < 3; i += arc_shares) {
      const RandomShape shape = random_arc_shape(base + i);
      const std::vector<std::string> failures = check(shape);
      if (failures.empty()) continue;
      ++failed;
      std::string text;
      for (const std::string& failure : failures) text.append("  ").append(failure).append("\n");
      ADD_FAILURE() << "random_arc_shape(" << base + i << "), " << shape.kind << ":\n" << text;
    }
  }
};

TEST_P(ArcShapes, AreVerified) {
  for_all(shape_count(5), [](const RandomShape& shape) { return check_axis(shape.rings); });
}

TEST_P(ArcShapes, KeepTheirAxisUnderSymmetries) {
  for_all(shape_count(50, arc_shares), check_symmetries);
}

TEST_P(ArcShapes, HaveOneAxisForAnyNumberOfThreads) {
  for_all(shape_count(100, arc_shares),
          [](const RandomShape& shape) { return check_threads(shape.rings); });
}

/// The shape's edges as chords, each within `height` of its arc.
Rings flattened(const Shape& shape, double height) {
  Rings rings;
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
    Ring ring;
    const auto points = shape.loop(loop);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 a = points[i], b = points[(i + 1) % points.size()];
      const double bulge = shape.bulge(shape.loop_begin[loop] + i);
      ring.points.push_back(a);
      if (bulge == 0) continue;
      const double angle = 4 * std::atan(bulge);
      const double radius = distance(a, b) / (2 * std::sin(0.5 * std::abs(angle)));
      const double step = 2 * std::acos(std::max(0.0, 1 - height / radius));
      const int pieces =
          step > 0 ? static_cast<int>(std::clamp(std::ceil(std::abs(angle) / step), 1.0, 1e5)) : 1;
      // From the chord's start, turned by half of the angle so far.
      const Vec2 chord = (1 / distance(a, b)) * (b - a);
      for (int k = 1; k < pieces; ++k) {
        const double part = angle * k / pieces;
        const double length = 2 * radius * std::sin(0.5 * std::abs(part));
        const double turn = 0.5 * (part - angle);
        const Vec2 d{chord.x * std::cos(turn) - chord.y * std::sin(turn),
                     chord.x * std::sin(turn) + chord.y * std::cos(turn)};
        ring.points.push_back(a + length * d);
      }
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

/// The axis of the flattened shape has more branches, but passes by wherever the exact one has two
/// feet in clearly different directions: within 4 height / (1 - cos(xi / 2)), where xi is the angle
/// between them (Aichholzer et al., Section 2.2).
std::vector<std::string> check_against_flattened(const RandomShape& random) {
  const auto shape = build_shape(random.rings);
  if (!shape) return {to_string(shape.error())};
  const double height = 1e-5 * diagonal(bounding_box(*shape));
  const auto polygon = build_shape(flattened(*shape, height));
  // Chords may cross where arcs nearly touch.
  if (!polygon || polygon->component_count() != shape->component_count() ||
      polygon->hole_count() != shape->hole_count())
    return {};
  const auto axis = compute(*shape, {.threads = 1});
  const auto flat = compute(*polygon, {.threads = 1});
  if (!axis || !flat) return {"not computed"};
  if (flat->edges.empty()) return {};
  const AxisLocator locator(*flat);
  std::vector<std::string> failures;
  for (const Edge& edge : axis->edges) {
    for (const double t : {0.0, 0.3, 0.6}) {
      const Disk disk = disk_at(*axis, edge, t);
      const Vec2 left = foot(axis->sites[edge.site[0]], disk.center) - disk.center;
      const Vec2 right = foot(axis->sites[edge.site[1]], disk.center) - disk.center;
      const double xi = std::abs(std::atan2(cross(left, right), dot(left, right)));
      if (!(xi > 0.5) || disk.radius <= 10 * height) continue;
      const double bound = 4 * height / (1 - std::cos(xi / 2));
      const double away = locator.nearest(disk.center).distance;
      if (away > bound && failures.size() < 3) {
        std::ostringstream text;
        text << "(" << disk.center.x << ", " << disk.center.y << ") is " << away
             << " from the flattened axis";
        failures.push_back(text.str());
      }
    }
  }
  return failures;
}

TEST_P(ArcShapes, AgreeWithTheirFlattening) {
  for_all(shape_count(100, arc_shares), check_against_flattened);
}

/// Steps of one tolerance from disk to disk led to a node that missed a vertex by three.
TEST(ArcTies, NodesTouchAllThatTheyJoin) {
  const std::vector<Ring> rings{
      {{{11.662909299698775, 2.8242780789079278},
        {-8.2773512135351623, 8.688236696118949},
        {-3.3855580861636181, -11.512514775026876}},
       RingRole::any,
       {0, 0, 0}},
      {{{0.20425556699447633, 0.051746859288231362},
        {-0.043084527476028256, -0.19426225819874804},
        {0.20292459001095106, -0.44160235266925257},
        {0.45026468448145579, -0.19559323518227334}},
       RingRole::any,
       {0.41421356237309503, 0.41421356237309503, 0.41421356237309503, 0.41421356237309503}},
      {{{-0.93457397201065129, -0.081023906461443695},
        {-0.96911981909346623, -0.023020858390986401},
        {-1.0851259152343806, -0.092112552556616226},
        {-1.050580068151566, -0.15011560062707355}},
       RingRole::any,
       {0, 0, 0, 0}},
      {{{-1.3376913695753256, -0.59368617610637031},
        {-1.437930053428675, -0.65773596007265434},
        {-1.40174115354161, -0.49344749225302126}},
       RingRole::any,
       {0, 0, 0}},
      {{{-1.2254065264332239, -1.1725569231224973},
        {-1.246773666335478, -1.2864834196207033},
        {-1.3393330229314302, -1.1511897832202431}},
       RingRole::any,
       {0, 0, 0}},
      {{{-0.72656364811388563, -1.4869690897136363},
        {-0.67666644172634871, -1.5552012622735096},
        {-0.79479582067375865, -1.536866296101173}},
       RingRole::any,
       {0, 0, 0}},
      {{{-0.20199447154132391, -1.3745532310656496},
        {-0.083895572021362386, -1.430775975352202},
        {-0.10977671630409694, -1.3025632091643013}},
       RingRole::any,
       {0, 0, 0}}};
  const auto shape = build_shape(rings);
  ASSERT_TRUE(shape) << to_string(shape.error());
  const auto axis = compute(*shape);
  ASSERT_TRUE(axis) << to_string(axis.error());
  EXPECT_TRUE(verify(*shape, *axis).passed);
}

/// Holes are connected where they lie furthest in one direction; here a joint lies there up to
/// rounding.
TEST(ArcHoles, MayBeginAtSmoothJoints) {
  const double outreach = std::atan2(disks::outreach.y, disks::outreach.x);
  const Ring square{{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}};
  for (const int arcs : {2, 3, 4})
    for (int digits = 4; digits < 18; ++digits)
      for (const double sign : {-1.0, 1.0}) {
        Ring hole;
        for (int i = 0; i < arcs; ++i) {
          const double angle =
              outreach + sign * std::pow(10.0, -digits) + 2 * std::numbers::pi * i / arcs;
          hole.points.push_back({0.3 + 0.5 * std::cos(angle), 0.1 + 0.5 * std::sin(angle)});
          hole.bulges.push_back(std::tan(std::numbers::pi / (2 * arcs)));
        }
        EXPECT_EQ(check_axis({square, hole}), std::vector<std::string>{})
            << arcs << " arcs, " << sign << "e-" << digits;
      }
}

/// Splines with holes, at tolerances from 1e-2 to 1e-8 of the size: every axis is verified, there
/// are as many arcs of largest curvature at each, the curves' own, and no corners.
TEST(RandomSplines, AreVerifiedAndKeepTheirApices) {
  const std::uint64_t count = shape_count(2000), base = first_seed();
  for (std::uint64_t i = 0; i < count; ++i) {
    SCOPED_TRACE(base + i);
    const std::vector<Contour> contours = random_splines(base + i);
    std::optional<int> apices;
    double deepest = 0, fine_error = 0;
    for (const double tolerance : {1e-8, 1e-6, 1e-4, 1e-2}) {
      SCOPED_TRACE(tolerance);
      ArcReport report;
      const auto rings =
          approximate_by_arcs(contours, {.tolerance = tolerance, .threads = 1}, &report);
      ASSERT_TRUE(rings) << to_string(rings.error());
      EXPECT_LE(report.largest_error, report.tolerance);
      const auto shape = build_shape(*rings);
      ASSERT_TRUE(shape) << to_string(shape.error());
      EXPECT_EQ(shape->hole_count(), contours.size() - 1);
      const auto axis = compute(*shape, {.threads = 1});
      ASSERT_TRUE(axis) << to_string(axis.error());
      EXPECT_EQ(joined(verify(*shape, *axis, {.threads = 1})), "");
      EXPECT_EQ(axis->edges.size() + 1, axis->nodes.size() + shape->hole_count());
      EXPECT_EQ(std::ranges::count(axis->nodes, 0.0, [](const Node& n) { return n.disk.radius; }),
                0);
      int now = 0;
      for (const Ring& ring : *rings) now += locally_most_curved(ring);
      const double radius = deepest_disk(*axis).radius;
      if (!apices) {
        apices = now;
        deepest = radius;
        fine_error = report.largest_error;
      }
      EXPECT_EQ(now, *apices);
      // Points within this distance of the curve change no distance to it by more.
      EXPECT_NEAR(radius, deepest, report.largest_error + fine_error + 1e-14);
    }
  }
}

/// The leaves of curves at one tolerance.
struct Leaves {
  std::vector<Disk> disks;
  std::vector<ArcEdge> boundary;
  double error = 0;
};

Leaves leaves_of(std::span<const Contour> contours, double tolerance) {
  Leaves leaves;
  ArcReport report;
  const auto rings = approximate_by_arcs(contours, {.tolerance = tolerance, .threads = 1}, &report);
  const auto shape = build_shape(*rings);
  const auto axis = compute(*shape, {.threads = 1});
  for (const Node& node : axis->nodes)
    if (node.kind == NodeKind::leaf) leaves.disks.push_back(node.disk);
  for (const Ring& ring : *rings)
    std::ranges::copy(edges_of(ring), std::back_inserter(leaves.boundary));
  leaves.error = report.largest_error;
  return leaves;
}

/// How many leaves `other` has not. The boundary comes into the disk of each, by less than both
/// errors: whether such a leaf is one of the curves' own is open at these tolerances.
int expect_undecided(const Leaves& leaves, const Leaves& other) {
  int missing = 0;
  for (const Disk& leaf : leaves.disks) {
    // Osculating circles at apices are the same at every tolerance, but for how far joints slide.
    constexpr double same = 1e-5, rounding = 1e-8;
    const bool shared = std::ranges::any_of(other.disks, [&](const Disk& disk) {
      return distance(disk.center, leaf.center) + std::abs(disk.radius - leaf.radius) < same;
    });
    if (shared) continue;
    ++missing;
    double clearance = std::numeric_limits<double>::infinity();
    for (const ArcEdge& edge : other.boundary)
      clearance = std::min(clearance, edge.distance_to(leaf.center));
    EXPECT_GT(leaf.radius - clearance, rounding);
    EXPECT_LE(leaf.radius - clearance, leaves.error + other.error);
  }
  return missing;
}

/// Of 500 random splines, nine do not have the same leaves at all tolerances: all of them here.
TEST(RandomSplines, LeavesThatToleranceDecidesAreWithinTheError) {
  for (const std::uint64_t seed : {29U, 194U, 252U, 282U, 318U, 333U, 397U, 408U, 458U}) {
    SCOPED_TRACE(seed);
    const std::vector<Contour> contours = random_splines(seed);
    const Leaves fine = leaves_of(contours, 1e-8);
    int differ = 0;
    for (const double tolerance : {1e-6, 1e-4, 1e-3, 1e-2}) {
      const Leaves coarse = leaves_of(contours, tolerance);
      differ += expect_undecided(fine, coarse) + expect_undecided(coarse, fine);
    }
    EXPECT_GT(differ, 0);
  }
}

TEST(RandomSplines, KeepTheirAxisUnderSymmetries) {
  const std::uint64_t count = shape_count(2000), base = first_seed();
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto rings = approximate_by_arcs(random_splines(base + i), {.threads = 1});
    ASSERT_TRUE(rings) << to_string(rings.error());
    EXPECT_EQ(check_symmetries({"splines", *rings, true}), std::vector<std::string>{}) << base + i;
    EXPECT_EQ(check_threads(*rings), std::vector<std::string>{}) << base + i;
  }
}

INSTANTIATE_TEST_SUITE_P(Random, ArcShapes, testing::Range<std::uint64_t>(0, arc_shares));

}  // namespace
}  // namespace medial::test
