// verify() on shapes with arcs: right axes written by hand pass, and every kind of damage is found.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "medial/medial.h"
#include "support/distance_check.h"
#include "support/generate_arcs.h"
#include "support/property.h"
#include "verify/boundary_edge.h"
#include "verify/distance_tree.h"
#include "verify/whole_edge.h"

namespace medial {
namespace {

using test::joined;
using verify_detail::BoundaryEdge;

/// One loop and its axis, by hand: a site for each edge, in their order.
struct HandMadeArcs {
  Shape shape;
  MedialAxis axis;

  HandMadeArcs(std::vector<Vec2> points, std::vector<double> bulges) {
    const auto n = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      shape.sources.push_back({0, i});
      axis.sites.push_back({points[i], points[(i + 1) % n], 0, i, bulges[i]});
    }
    shape.points = std::move(points);
    shape.bulges = std::move(bulges);
    shape.loop_begin = {0, n};
    shape.component = {0};
    shape.hole = {false};
  }
  void node(Vec2 center, double radius, NodeKind kind) {
    axis.nodes.push_back({{center, radius}, 0, kind});
  }
  void edge(std::array<std::uint32_t, 2> nodes, std::array<std::uint32_t, 2> sites,
            const Disk& control, double weight = 1) {
    axis.edges.push_back({nodes, sites, control, weight});
  }
};

HandMadeArcs round_disk() {
  HandMadeArcs m({{1, 0}, {-1, 0}}, {1, 1});
  m.node({0, 0}, 1, NodeKind::leaf);
  return m;
}

HandMadeArcs hand_made_stadium() {
  HandMadeArcs m({{0, 0}, {3, 0}, {3, 2}, {0, 2}}, {0, 1, 0, 1});
  m.node({0, 1}, 1, NodeKind::leaf);
  m.node({3, 1}, 1, NodeKind::leaf);
  m.edge({0, 1}, {2, 0}, {{1.5, 1}, 1});
  return m;
}

/// Above its diameter: the parabola y = (1 - x^2) / 2.
HandMadeArcs half_circle() {
  HandMadeArcs m({{-1, 0}, {1, 0}}, {0, 1});
  m.node({-1, 0}, 0, NodeKind::leaf);
  m.node({1, 0}, 0, NodeKind::leaf);
  m.edge({0, 1}, {1, 0}, {{0, 1}, 1});
  return m;
}

/// A symmetrical lens: along the chord r is one branch of a hyperbola.
HandMadeArcs lens() {
  // Circles of radius 5 around (0, 3) and (0, -3).
  HandMadeArcs m({{-4, 0}, {4, 0}}, {0.5, 0.5});
  m.node({-4, 0}, 0, NodeKind::leaf);
  m.node({4, 0}, 0, NodeKind::leaf);
  // (5 - r)^2 = x^2 + 9: at the ends dr / dx = 4 / 5, so the tangents meet at r = 16 / 5; and at
  // the shoulder r = 2 = w (16 / 5) / (1 + w).
  m.edge({0, 1}, {1, 0}, {{0, 0}, 3.2}, 5.0 / 3);
  return m;
}

std::vector<HandMadeArcs> all_hand_made_arcs() {
  return {round_disk(), hand_made_stadium(), half_circle(), lens()};
}

TEST(VerifyArcs, PassesAxesInClosedForm) {
  for (const HandMadeArcs& m : all_hand_made_arcs()) {
    const Certificate certificate = verify(m.shape, m.axis);
    EXPECT_TRUE(certificate.passed) << joined(certificate);
    // A bound that includes the uncertainty next to an arc's centre.
    EXPECT_LE(certificate.largest_residual, 1e-13);
    EXPECT_LE(certificate.largest_uncovered, 2e-15);
    EXPECT_NEAR(certificate.disks_area, certificate.shape_area, 1e-14);
    EXPECT_EQ(certificate.worst_legality, 0);
  }
  EXPECT_NEAR(verify(round_disk().shape, round_disk().axis).disks_area, std::numbers::pi, 1e-15);
  EXPECT_EQ(verify(lens().shape, lens().axis).convex_corners, 2U);
  const HandMadeArcs m = hand_made_stadium();
  EXPECT_EQ(verify(m.shape, m.axis).curvature_leaves, 2U);
  EXPECT_EQ(verify(m.shape, m.axis).convex_corners, 0U);
  EXPECT_NEAR(verify(m.shape, m.axis).shape_area, 6 + std::numbers::pi, 1e-14);
}

/// A bar whose half circle ends 4e-13 beyond one of its sides: of three disks that touch the side
/// in its end, or all but do, the outermost fills the half circle.
TEST(VerifyArcs, OfDisksAtTheEndOfASideTheOutermostGoesOn) {
  const double eighth = std::tan(std::numbers::pi / 16), quarter = std::tan(std::numbers::pi / 8);
  const Ring bar{{{0.31689702389709007, 0.94906854133144192},
                  {-0.96906634307001815, 0.36059745553488481},
                  {-0.38059525727346599, -0.92536591143223401},
                  {-0.31689702389713531, -0.94906854133147511},
                  {0.44796101198710564, -0.92116473208956973},
                  {0.96906634307004547, -0.36059745553488393},
                  {0.94116253382807891, 0.40426058034937079},
                  {0.3805952572734807, 0.92536591143226099}},
                 RingRole::any,
                 {quarter, quarter, 0, eighth, eighth, eighth, eighth, 0}};
  const auto shape = build_shape({&bar, 1});
  const auto axis = compute(*shape);
  const Certificate certificate = verify(*shape, *axis);
  EXPECT_EQ(certificate.failures, std::vector<std::string>{});
  EXPECT_LT(certificate.largest_uncovered, 2e-14);
}

/// Three arcs of nearly one circle, between tiny ones. Next to a gap of a third of it, where no
/// edge has its arc, four disks touch a tiny arc equally far along it; but only the leaf's fills
/// the gap.
TEST(VerifyArcs, OfDisksThatReachEquallyFarAnyMayFillAGap) {
  const Ring circle{{{-0.38976796633937089, 117.63048835315533},
                     {-0.38976848295622102, 117.63048771019434},
                     {-0.23197048431874298, 116.8743765398177},
                     {-0.2319701899622045, 116.87437638565878},
                     {0.49694355617170277, 117.37251015983165},
                     {0.49694351948719695, 117.37251049008124}},
                    RingRole::any,
                    {-4.123990169788661e-07, 0.47237808526606323, -1.661405625437658e-07,
                     0.6007433855674732, -1.6614041160547737e-07, 0.66741919249933879}};
  const auto shape = build_shape({&circle, 1});
  const auto axis = compute(*shape);
  EXPECT_EQ(verify(*shape, *axis).failures, std::vector<std::string>{});
  // Each of its four edges ends in a leaf, or joins those that do.
  for (std::size_t i = 0; i < axis->edges.size(); ++i) {
    MedialAxis damaged = *axis;
    damaged.edges.erase(damaged.edges.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_FALSE(verify(*shape, damaged).passed) << i;
    for (const std::uint32_t node : axis->edges[i].node) {
      damaged = *axis;
      damaged.nodes[node].disk.radius -= 1e-12;
      EXPECT_FALSE(verify(*shape, damaged).passed) << node;
    }
  }
}

/// The circle's last point, where its arcs join smoothly, is the reflex vertex of the other shape.
TEST(VerifyArcs, AVertexThatAnotherComponentTouches) {
  const Ring circle{{{-2, 0}, {0, 0}}, RingRole::any, {1, 1}};
  const Ring other{{{0, 0}, {-1e-8, -1}, {2, -1}, {2, 1}, {-1e-8, 1}}};
  for (const auto& rings : {std::vector{circle, other}, std::vector{other, circle}}) {
    const auto shape = build_shape(rings);
    ASSERT_TRUE(shape) << to_string(shape.error());
    ASSERT_EQ(shape->component_count(), 2U);
    const auto axis = compute(*shape);
    ASSERT_TRUE(axis) << to_string(axis.error());
    const Certificate certificate = verify(*shape, *axis);
    EXPECT_TRUE(certificate.passed) << certificate.failures.front();
  }
}

TEST(VerifyArcsFinds, MovedNodes) {
  for (const HandMadeArcs& m : all_hand_made_arcs()) {
    for (std::size_t i = 0; i < m.axis.nodes.size(); ++i) {
      for (const double change : {1e-9, -1e-9, 1e-12, -1e-12}) {
        HandMadeArcs damaged = m;
        damaged.axis.nodes[i].disk.center.x += change;
        EXPECT_FALSE(verify(damaged.shape, damaged.axis).passed) << i << " x " << change;
        damaged = m;
        damaged.axis.nodes[i].disk.radius += change;
        EXPECT_FALSE(verify(damaged.shape, damaged.axis).passed) << i << " r " << change;
      }
    }
  }
}

TEST(VerifyArcsFinds, WrongCurves) {
  for (HandMadeArcs m : {half_circle(), lens()}) {
    m.axis.edges[0].control.center.y += 1e-12;
    EXPECT_FALSE(verify(m.shape, m.axis).passed);
    m.axis.edges[0].control.center.y -= 1e-12;
    m.axis.edges[0].control.radius += 1e-12;
    EXPECT_FALSE(verify(m.shape, m.axis).passed);
  }
  for (HandMadeArcs m : {half_circle(), lens()}) {
    m.axis.edges[0].weight *= 1 + 1e-12;
    EXPECT_FALSE(verify(m.shape, m.axis).passed);
  }
}

TEST(VerifyArcsFinds, AStadiumThatEndsEarly) {
  HandMadeArcs m = hand_made_stadium();
  m.axis.nodes[1].disk.center.x = 2;
  const std::string failures = joined(verify(m.shape, m.axis));
  EXPECT_NE(failures.find("1 leaves have a radius above 0 and are at no arc of largest curvature"),
            std::string::npos)
      << failures;
  EXPECT_NE(failures.find("A stretch of the boundary is touched by no disk"), std::string::npos);
  EXPECT_NE(failures.find("The disks cover an area"), std::string::npos);
}

TEST(VerifyArcsFinds, AStadiumThatGoesOn) {
  // Beyond the arc's centre no disk touches both sides.
  HandMadeArcs m = hand_made_stadium();
  m.axis.nodes[1].disk.center.x = 3 + 1e-9;
  EXPECT_FALSE(verify(m.shape, m.axis).passed);
  m.axis.nodes[1].disk = {{3.5, 1}, 0.5};
  EXPECT_FALSE(verify(m.shape, m.axis).passed);
}

TEST(VerifyArcsFinds, ACircleInsideOfTheCircle) {
  HandMadeArcs m = round_disk();
  m.axis.nodes[0].disk = {{0.5, 0}, 0.5};
  const std::string failures = joined(verify(m.shape, m.axis));
  EXPECT_NE(failures.find("touched by no disk"), std::string::npos) << failures;
  EXPECT_NE(failures.find("which differs from the shape's area"), std::string::npos);
  // The one node of another shape.
  m = half_circle();
  m.axis.edges.clear();
  m.axis.nodes = {{{{0, 0.5}, 0.5}, 0, NodeKind::leaf}};
  EXPECT_NE(joined(verify(m.shape, m.axis)).find("touched by no disk"), std::string::npos);
}

/// A circle's one disk touches all reflex joints of a circle of lobes, so that those count as
/// touched; what it leaves of the lobes is found however little that is.
TEST(VerifyArcsFinds, LobesThatOneDiskLeavesOut) {
  for (const int count : {3, 5, 12})
    for (const double excess : {1e-2, 1e-5, 1e-8, 1e-10}) {
      std::vector<Vec2> points;
      const double turn = 2 * std::numbers::pi / count;
      for (int i = 0; i < count; ++i) points.push_back({std::cos(i * turn), std::sin(i * turn)});
      const std::vector<double> bulges(points.size(), std::tan(turn / 4) * (1 + excess));
      HandMadeArcs lobes(points, bulges);
      lobes.node({0, 0}, 1, NodeKind::leaf);
      const Certificate certificate = verify(lobes.shape, lobes.axis);
      EXPECT_EQ(certificate.reflex_vertices, points.size());
      EXPECT_EQ(certificate.reflex_without_contact, 0U);
      EXPECT_FALSE(certificate.passed) << count << " lobes, " << excess;
      const auto axis = compute(lobes.shape);
      ASSERT_TRUE(axis.ok());
      EXPECT_TRUE(verify(lobes.shape, *axis).passed) << count << " lobes, " << excess;
    }
}

TEST(VerifyArcsFinds, TwoNodesOfACircle) {
  HandMadeArcs m = round_disk();
  m.node({0, 0}, 1, NodeKind::leaf);
  EXPECT_NE(joined(verify(m.shape, m.axis)).find("2 connected parts"), std::string::npos);
}

TEST(VerifyArcsFinds, WrongSites) {
  HandMadeArcs m = hand_made_stadium();
  m.axis.edges[0].site = {1, 0};
  EXPECT_FALSE(verify(m.shape, m.axis).passed);
  m = half_circle();
  std::swap(m.axis.edges[0].site[0], m.axis.edges[0].site[1]);
  EXPECT_NE(joined(verify(m.shape, m.axis)).find("wrong sides"), std::string::npos);
  // An arc that is not the shape's, or none.
  m = lens();
  m.axis.sites[0].bulge *= 1 + 1e-15;
  EXPECT_NE(joined(verify(m.shape, m.axis)).find("1 sites are neither an edge"), std::string::npos);
  m = lens();
  m.axis.sites[0].bulge = 0;
  EXPECT_NE(joined(verify(m.shape, m.axis)).find("1 sites are neither an edge"), std::string::npos);
}

TEST(VerifyArcsFinds, MalformedBulges) {
  for (const double bulge : {1.5, -2.0, std::numeric_limits<double>::quiet_NaN()}) {
    HandMadeArcs m = lens();
    m.shape.bulges[0] = bulge;
    EXPECT_NE(joined(verify(m.shape, m.axis)).find("malformed"), std::string::npos);
    m = lens();
    m.axis.sites[1].bulge = bulge;
    EXPECT_NE(joined(verify(m.shape, m.axis)).find("1 sites have"), std::string::npos);
  }
  HandMadeArcs m = lens();
  m.shape.bulges.pop_back();
  EXPECT_NE(joined(verify(m.shape, m.axis)).find("malformed"), std::string::npos);
}

TEST(VerifyArcs, BluntJointsHaveNoLeaf) {
  // A stadium whose caps are a little more than half circles would be: convex joints of 0.005
  // degrees, without leaves at a corner angle of 0.01.
  const double bulge = std::tan(std::numbers::pi / 4 - 0.005 * std::numbers::pi / 180 / 2);
  const auto shape = build_shape(test::Rings{{.points = {{0, 0}, {3, 0}, {3, 2}, {0, 2}},
                                              .role = RingRole::any,
                                              .bulges = {0, bulge, 0, bulge}}});
  ASSERT_TRUE(shape);
  const auto blunt = compute(*shape);
  ASSERT_TRUE(blunt);
  const Certificate certificate = verify(*shape, *blunt);
  EXPECT_TRUE(certificate.passed) << joined(certificate);
  EXPECT_EQ(certificate.blunt_joints, 4U);
  EXPECT_NEAR(certificate.largest_blunt_angle, 0.005, 1e-9);
  EXPECT_EQ(certificate.convex_corners, 0U);
  // The same axis is wrong where these are corners, and the other way round.
  EXPECT_FALSE(verify(*shape, *blunt, {.corner_angle = 0.001}).passed);
  const auto sharp = compute(*shape, {.corner_angle = 0.001});
  ASSERT_TRUE(sharp);
  EXPECT_TRUE(verify(*shape, *sharp, {.corner_angle = 0.001}).passed)
      << joined(verify(*shape, *sharp, {.corner_angle = 0.001}));
  EXPECT_EQ(verify(*shape, *sharp, {.corner_angle = 0.001}).convex_corners, 4U);
}

/// A branch into a blunt joint, all the way or as far as anywhere on it.
TEST(VerifyArcsFinds, BranchesIntoBluntJoints) {
  const double fillet = 1e-3, bulge = 0.4142135;  // convex by 2e-7 at both ends
  const Ring square{{{-2, -2}, {2, -2}, {2, 2 - fillet}, {2 - fillet, 2}, {-2, 2}},
                    RingRole::any,
                    {0, 0, bulge, 0, 0}};
  const auto shape = build_shape({&square, 1});
  const auto axis = compute(*shape);
  const Certificate certificate = verify(*shape, *axis);
  EXPECT_TRUE(certificate.passed) << joined(certificate);
  EXPECT_EQ(certificate.blunt_joints, 2U);
  EXPECT_EQ(certificate.curvature_leaves, 1U);
  const auto site_of = [&](Vec2 start) {
    std::uint32_t i = 0;
    while (!(axis->sites[i].start == start)) ++i;
    return i;
  };
  const std::uint32_t before = site_of({2, -2}), arc = site_of({2, 2 - fillet});
  for (std::uint32_t node = 0; node < axis->nodes.size(); ++node) {
    const Disk& from = axis->nodes[node].disk;
    const Vec2 joint{2, 2 - fillet};
    if (std::abs(from.radius - fillet) > 1e-6) continue;  // the leaf
    for (const double part : {0.01, 0.5, 1.0}) {
      MedialAxis spoilt = *axis;
      const Disk to{part < 1 ? from.center + part * (joint - from.center) : joint,
                    part < 1 ? (1 - part) * from.radius : 0};
      spoilt.nodes.push_back({to, 0, NodeKind::leaf});
      spoilt.nodes[node].kind = NodeKind::site_change;
      spoilt.edges.push_back({{node, static_cast<std::uint32_t>(axis->nodes.size())},
                              {arc, before},
                              {midpoint(from.center, to.center), 0.5 * (from.radius + to.radius)},
                              1});
      const std::string failures = joined(verify(*shape, spoilt));
      EXPECT_NE(failures.find(part < 1 ? "at no arc of largest curvature" : "not convex corners"),
                std::string::npos)
          << failures;
    }
  }
}

/// A branch of half the size leads to the reflex vertex at the end of a tiny arc, whose other joint
/// is blunt. Without it the disks leave hardly anything uncovered, but touch the vertex from only
/// some of the directions between its normals.
TEST(VerifyArcsFinds, ADroppedBranchBesideATinyArc) {
  const Ring square{{{2.7800772983034605, -0.52074006515509419},
                     {0.52074006515509419, 2.7800772983034605},
                     {-1.1296686165741832, 1.6504086817292773},
                     {-1.1296702853501939, 1.6504075393593858},
                     {-2.7235938674747513, 0.43821963106863016},
                     {-0.52074006515509419, -2.7800772983034605}},
                    RingRole::any,
                    {0, 0, -4.8569378998392425e-07, 0.42943684375407942, 0, 0}};
  const auto shape = build_shape({&square, 1});
  const auto axis = compute(*shape);
  EXPECT_EQ(verify(*shape, *axis).failures, std::vector<std::string>{});
  const std::vector<Edge>& edges = axis->edges;
  const auto degree = [&](std::uint32_t node) {
    return std::count_if(edges.begin(), edges.end(), [&](const Edge& edge) {
      return edge.node[0] == node || edge.node[1] == node;
    });
  };
  unsigned dropped = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (const std::uint32_t leaf : edges[i].node) {
      if (degree(leaf) != 1 || axis->nodes[leaf].disk.radius == 0) continue;
      MedialAxis damaged = *axis;
      damaged.edges.erase(damaged.edges.begin() + static_cast<std::ptrdiff_t>(i));
      damaged.nodes.erase(damaged.nodes.begin() + leaf);
      for (Edge& edge : damaged.edges)
        for (std::uint32_t& node : edge.node) node -= node > leaf ? 1 : 0;
      const std::string failures = joined(verify(*shape, damaged));
      EXPECT_NE(failures.find("touched from some directions only"), std::string::npos) << failures;
      ++dropped;
    }
  EXPECT_EQ(dropped, 1U);
}

/// Disks that touch an arc's end, and no more of it, have the vertex there as their site.
TEST(VerifyArcsFinds, ArcsInPlaceOfTheVertexAtTheirEnd) {
  const Ring notched{
      {{0, 0}, {6, 0}, {6, 4}, {3.5, 4}, {2.5, 4}, {0, 4}}, RingRole::any, {0, 0, 0, 0.8, 0, 0}};
  const auto shape = build_shape({&notched, 1});
  const auto axis = compute(*shape);
  EXPECT_TRUE(verify(*shape, *axis).passed);
  unsigned vertices = 0;
  for (std::uint32_t vertex = 0; vertex < axis->sites.size(); ++vertex)
    for (std::uint32_t arc = 0; arc < axis->sites.size(); ++arc) {
      const Site &at = axis->sites[vertex], &other = axis->sites[arc];
      if (at.kind() != SiteKind::vertex || other.kind() != SiteKind::arc) continue;
      if (!(other.start == at.start || other.end == at.start)) continue;
      ++vertices;
      MedialAxis spoilt = *axis;
      for (Edge& edge : spoilt.edges)
        for (std::uint32_t& site : edge.site)
          if (site == vertex) site = arc;
      EXPECT_NE(joined(verify(*shape, spoilt)).find("touched from some directions only"),
                std::string::npos);
    }
  EXPECT_EQ(vertices, 2U);
}

TEST(VerifyArcsFinds, DamageInComputedAxes) {
  // The engine may be wrong here, so damage only axes that pass; but most must pass.
  unsigned passed = 0, tried = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    const auto shape = build_shape(test::random_arc_shape(seed).rings);
    if (!shape.ok()) continue;
    const auto computed = compute(*shape);
    if (!computed.ok()) continue;
    ++tried;
    const MedialAxis& axis = *computed;
    const Certificate certificate = verify(*shape, axis);
    if (!certificate.passed) continue;
    ++passed;
    std::mt19937 random(seed);
    const std::size_t any_node = random() % axis.nodes.size();
    MedialAxis damaged = axis;
    damaged.nodes[any_node].disk.radius += 3 * certificate.tolerance;
    EXPECT_FALSE(verify(*shape, damaged).passed) << seed << " node " << any_node;
    damaged = axis;
    damaged.nodes[any_node].disk.center.x +=
        1e-6 * axis.nodes[any_node].disk.radius + 100 * certificate.tolerance;
    EXPECT_FALSE(verify(*shape, damaged).passed) << seed << " node " << any_node;
    if (axis.edges.empty()) continue;
    const std::size_t any_edge = random() % axis.edges.size();
    damaged = axis;
    damaged.edges.erase(damaged.edges.begin() + static_cast<std::ptrdiff_t>(any_edge));
    EXPECT_FALSE(verify(*shape, damaged).passed) << seed << " edge " << any_edge;
    damaged = axis;
    damaged.edges.push_back(axis.edges[any_edge]);
    EXPECT_FALSE(verify(*shape, damaged).passed) << seed << " edge " << any_edge;
    damaged = axis;
    std::swap(damaged.edges[any_edge].node[0], damaged.edges[any_edge].node[1]);
    if (distance(axis.nodes[axis.edges[any_edge].node[0]].disk.center,
                 axis.nodes[axis.edges[any_edge].node[1]].disk.center) >
        1000 * certificate.tolerance) {
      EXPECT_FALSE(verify(*shape, damaged).passed) << seed << " edge " << any_edge;
    }
  }
  EXPECT_GE(passed, tried * 3 / 4);
}

TEST(VerifyArcs, NeverCrashesOnRandomDamage) {
  std::mt19937 random(11);
  const auto below = [&](std::size_t n) { return random() % n; };
  const double numbers[] = {0,      1,   -1, 1e300, -1e300,
                            1e-300, 0.5, 3,  1e16,  std::numeric_limits<double>::denorm_min()};
  for (int round = 0; round < 3000; ++round) {
    auto all = all_hand_made_arcs();
    HandMadeArcs& m = all[1 + below(all.size() - 1)];
    for (std::size_t k = 0; k <= below(3); ++k) {
      Node& node = m.axis.nodes[below(m.axis.nodes.size())];
      Edge& edge = m.axis.edges[0];
      Site& site = m.axis.sites[below(m.axis.sites.size())];
      const double number = numbers[below(std::size(numbers))];
      switch (below(9)) {
        case 0:
          node.disk.center.x = number;
          break;
        case 1:
          node.disk.radius = number;
          break;
        case 2:
          edge.control.center.y = number;
          break;
        case 3:
          edge.weight = number;
          break;
        case 4:
          edge.site[below(2)] = static_cast<std::uint32_t>(below(m.axis.sites.size() + 1));
          break;
        case 5:
          site.bulge = number;
          break;
        case 6:
          site.bulge = 0;
          break;
        case 7:
          m.shape.bulges[below(m.shape.bulges.size())] = number;
          break;
        default:
          site.end = site.start;
          break;
      }
    }
    const Certificate certificate = verify(m.shape, m.axis);
    EXPECT_EQ(certificate.passed, certificate.failures.empty());
  }
}

/// The distance to an arc by its centre and radius, in long double.
double distance_by_center(Vec2 p, const BoundaryEdge& edge) {
  using Real = long double;
  const Real half = 2 * std::atan(static_cast<Real>(edge.bulge));
  const Real dx = static_cast<Real>(edge.end.x) - edge.start.x,
             dy = static_cast<Real>(edge.end.y) - edge.start.y, chord = std::hypot(dx, dy);
  const Real radius = chord / (2 * std::sin(half));
  const Real x = edge.start.x + dx / 2 - dy / chord * radius * std::cos(half),
             y = edge.start.y + dy / 2 + dx / chord * radius * std::cos(half);
  const Real from = std::atan2(edge.start.y - y, edge.start.x - x),
             to = std::atan2(p.y - y, p.x - x);
  const Real turn = 2 * std::numbers::pi_v<Real>;
  Real angle = std::fmod(half > 0 ? to - from : from - to, turn);
  if (angle < 0) angle += turn;
  if (angle <= 2 * std::abs(half))
    return static_cast<double>(std::abs(std::hypot(p.x - x, p.y - y) - std::abs(radius)));
  return std::min(distance(p, edge.start), distance(p, edge.end));
}

TEST(BoundaryEdge, DistanceAgreesWithTheCircle) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 20000; ++i) {
    const double bulge = std::copysign(std::pow(10, 4 * std::min(0.0, unit(random))), unit(random));
    const BoundaryEdge edge{{unit(random), unit(random)}, {unit(random), unit(random)}, bulge};
    const Vec2 p = (i % 2 == 0 ? 1 : 10) * Vec2{unit(random), unit(random)};
    const double expected = distance_by_center(p, edge);
    EXPECT_NEAR(verify_detail::distance_to_edge(p, edge), expected, 4e-15 * (1 + expected)) << i;
    const Vec2 foot = verify_detail::point_at(edge, verify_detail::foot_at(edge, p));
    EXPECT_NEAR(distance(foot, p), expected, 1e-14 * (1 + expected)) << i;
  }
}

/// Their distances differ in the last digit only.
TEST(BoundaryEdge, IsTouchedInTheNearerEndNextToItsCentre) {
  constexpr double turn = 3e-4, beyond = 1e-3, away = 5e-10;
  for (int i = 0; i < 100; ++i) {
    const auto at = [&](double angle) { return Vec2{std::cos(angle + i), std::sin(angle + i)}; };
    const BoundaryEdge edge{at(0), at(turn), std::tan(turn / 4)};
    EXPECT_EQ(verify_detail::foot_at(edge, away * at(-beyond)), 0);
    EXPECT_NEAR(verify_detail::foot_at(edge, away * at(turn + beyond)), turn, 1e-12);
  }
}

/// A disk that touches an arc's end may be larger than its circle: it is on the left of the tangent
/// there, whichever side of the far half of the circle its centre is on.
TEST(BoundaryEdge, IsTouchedFromTheLeftBeyondItsCircle) {
  for (const double bulge : {0.05, -0.05})
    for (const double side : {1, -1}) {
      const verify_detail::Arc arc(BoundaryEdge{{0, 0}, {0.1, 0}, bulge});
      const Vec2 place = 3 * turned(arc.start_tangent(), -0.1, side);
      EXPECT_DOUBLE_EQ(arc.signed_distance(place), side * norm(place)) << bulge;
    }
}

TEST(BoundaryEdge, IsAsFarFromTwoPlacesAsFromEach) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 5000; ++i) {
    const BoundaryEdge edge{
        {unit(random), unit(random)}, {unit(random), unit(random)}, unit(random)};
    const verify_detail::Arc arc(edge);
    const verify_detail::Segment segment(edge.start, edge.end);
    const Pair x{2 * unit(random), 2 * unit(random)}, y{2 * unit(random), 2 * unit(random)};
    const Pair from_arc = arc.signed_distances(x, y), from_segment = segment.signed_distances(x, y);
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(from_arc[k], arc.signed_distance({x[k], y[k]})) << i;
      EXPECT_EQ(from_segment[k], segment.signed_distance({x[k], y[k]})) << i;
    }
  }
}

/// Bounds of all disks of an edge against its disks one by one, of edges that touch nothing.
TEST(WholeEdge, BoundsItsDisks) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(-1, 1);
  int contacts = 0, intrusions = 0, ends = 0;
  for (int i = 0; i < 20000; ++i) {
    const double bulge =
        i % 3 == 0 ? 0 : std::copysign(std::pow(10, 2 * unit(random) - 2), unit(random));
    const BoundaryEdge edge{{-1, 0}, {1, 0}, bulge};
    verify_detail::DiskHull hull;
    const double spread = std::pow(10, 2 * unit(random) - 2);
    const Vec2 near{2 * unit(random), 3 * unit(random)};
    for (Disk& disk : hull) {
      disk.center = near + spread * Vec2{unit(random), unit(random)};
      disk.radius =
          std::abs(verify_detail::distance_to_edge(disk.center, edge) + spread * unit(random));
    }
    const double weight = 0.2 + std::abs(unit(random));
    const verify_detail::WholeEdge whole(hull, weight);
    const verify_detail::Arc arc_there(edge.bulge != 0 ? edge : BoundaryEdge{{-1, 0}, {1, 0}, 1});
    const verify_detail::Arc* const arc = edge.bulge != 0 ? &arc_there : nullptr;
    const Site site{edge.start, edge.end, 0, 0, edge.bulge}, vertex{edge.start, edge.start, 0, 0};
    const double gap = whole.contact_gap(site, arc),
                 gap_of_vertex = whole.contact_gap(vertex, nullptr);
    const double intrusion = whole.intrusion(edge, arc), of_point = whole.intrusion(edge.start);
    const double nearer = whole.nearer_than_end(edge, arc, true);
    contacts += std::isfinite(gap) ? 1 : 0;
    intrusions += std::isfinite(intrusion) ? 1 : 0;
    ends += std::isfinite(nearer) ? 1 : 0;
    const Curve curve(hull[0], hull[1], hull[2], weight);
    for (int k = 0; k <= 32; ++k) {
      const auto [p, r] = curve.at(k / 32.0);
      const double d = verify_detail::distance_to_edge(p, edge), to_start = distance(p, edge.start);
      const double side = verify_detail::distance_to_carrier(p, edge) < 0 ? -1 : 1;
      constexpr double slack = 1e-13;
      EXPECT_LE(std::abs(side * d - r), gap + slack) << i;
      EXPECT_LE(std::abs(to_start - r), gap_of_vertex + slack) << i;
      EXPECT_LE(r - d, intrusion + slack) << i;
      EXPECT_LE(r - to_start, of_point + slack) << i;
      EXPECT_LE(to_start - d, nearer + slack) << i;
    }
  }
  EXPECT_GT(contacts, 4000);
  EXPECT_GT(intrusions, 4000);
  EXPECT_GT(ends, 4000);
}

/// Of weights and control points whose products are infinite nothing is known.
TEST(WholeEdge, IsNotBoundedByInfiniteProducts) {
  const verify_detail::DiskHull hull{Disk{{0, 1}, 1}, Disk{{0.5, 1}, 1}, Disk{{1, 1}, 1}};
  EXPECT_FALSE(std::isfinite(verify_detail::WholeEdge(hull, 1e160).intrusion(Vec2{0.5, 0.5})));
  const verify_detail::DiskHull far{Disk{{0, 1}, 1}, Disk{{1e200, 1}, 1e200}, Disk{{1, 1}, 1}};
  EXPECT_FALSE(std::isfinite(verify_detail::WholeEdge(far, 1).intrusion(Vec2{0.5, 0.5})));
}

TEST(BoundaryEdge, IsFarthestOppositeToTheFoot) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const BoundaryEdge edge{{0, 0}, {1 + unit(random) / 2, unit(random)}, unit(random)};
    const Vec2 p{2 * unit(random), 2 * unit(random)};
    const double length = verify_detail::length_of(edge);
    const double opposite = verify_detail::opposite_at(edge, p);
    double farthest = 0;
    for (int k = 0; k <= 1000; ++k)
      farthest =
          std::max(farthest, distance(p, verify_detail::point_at(edge, k / 1000.0 * length)));
    double expected = std::max(distance(p, edge.start), distance(p, edge.end));
    if (opposite > 0 && opposite < length)
      expected = std::max(expected, distance(p, verify_detail::point_at(edge, opposite)));
    EXPECT_NEAR(farthest, expected, 1e-5);
    EXPECT_LE(farthest, expected + 1e-14);
  }
}

TEST(DistanceTreeOfArcs, AgreesWithBruteForce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const std::size_t count : {2U, 17U, 65U, 1000U}) {
    Shape shape;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 6.28 * static_cast<double>(i) / static_cast<double>(count);
      const double r = 1 + (i % 7 == 0 ? 3 * unit(random) : 0.01 * unit(random));
      shape.points.push_back({r * std::cos(angle), r * std::sin(angle)});
      shape.bulges.push_back(i % 3 == 0 ? 0 : 2 * unit(random) - 1);
    }
    shape.loop_begin = {0, static_cast<std::uint32_t>(count)};
    shape.component = {0};
    shape.hole = {false};
    const verify_detail::DistanceTree tree(shape);
    for (int i = 0; i < 300; ++i) {
      const Vec2 p{10 * unit(random) - 5, 10 * unit(random) - 5};
      double expected = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < count; ++j)
        expected = std::min(
            expected, verify_detail::distance_to_edge(
                          p, {shape.points[j], shape.points[(j + 1) % count], shape.bulges[j]}));
      for (const double guess : {0.0, 0.5 * expected, expected, 2 * expected, 1e300})
        EXPECT_EQ(tree.distance(p, guess), expected);
    }
    test::expect_distances_on_curves(shape, 8, {0, 0});
  }
}

/// At a leaf the feet on both arcs nearly coincide, beside an edge of 1e-6; the arcs join
/// elsewhere.
TEST(VerifyArcs, FeetThatNearlyCoincideLieWhereTheBoundaryPassesOn) {
  Ring ring;
  ring.points = {{-4.5, 0}, {-6, 0}, {-4.5, -1e-6}};
  ring.bulges = {0.999999, 1, 0};
  const auto shape = build_shape(std::vector<Ring>{ring});
  ASSERT_TRUE(shape) << to_string(shape.error());
  const auto axis = compute(*shape, {.threads = 1});
  ASSERT_TRUE(axis) << to_string(axis.error());
  const Certificate certificate = verify(*shape, *axis, {.threads = 1});
  EXPECT_TRUE(certificate.passed) << certificate.failures.front();
  EXPECT_NEAR(certificate.disks_area, certificate.shape_area, 1e-6);  // a joint is blunt
}

/// Next to the centre of one circle, every edge is nearly as near as the nearest one.
TEST(DistanceTreeOfArcs, AgreesWithBruteForceNextToACentre) {
  constexpr std::size_t count = 3000;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const double noise : {0.0, 1e-14, 1e-12, 1e-9, 1e-6}) {
    for (const bool arcs : {false, true}) {
      std::vector<verify_detail::BoundaryEdge> edges;
      Box box = Box::nothing();
      const auto point = [&](std::size_t i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / count;
        const double r = 1 + noise * unit(random);
        return Vec2{3 + r * std::cos(angle), r * std::sin(angle) - 5};
      };
      for (std::size_t i = 0; i < count; ++i) {
        const double bulge = arcs ? std::tan(0.5 * std::numbers::pi / count) : 0;
        edges.push_back({point(i), point(i + 1), bulge * (1 + noise * unit(random))});
        box.add(edges.back().start);
      }
      const verify_detail::DistanceTree tree(edges, box, arcs);
      for (int i = 0; i < 100; ++i) {
        const double off = std::max(noise, 1e-15) * std::pow(10, 2 * unit(random));
        const Vec2 p{3 + off * unit(random), off * unit(random) - 5};
        double expected = std::numeric_limits<double>::infinity();
        for (const auto& edge : edges)
          expected = std::min(expected, verify_detail::distance_to_edge(p, edge));
        for (const double guess : {0.5, expected, 1.5})
          EXPECT_EQ(tree.distance(p, guess), expected) << noise << " " << arcs;
      }
    }
  }
}

/// Far from their nearest edge in the tree's order, all queries took time by the number of rings.
TEST(DistanceTreeOfArcs, ConcentricCirclesAreExact) {
  constexpr int rings = 2000;
  Shape shape;
  shape.loop_begin = {0};
  for (int k = 1; k <= rings; ++k) {
    const double r = k;
    for (const double x : {-r, r}) {
      shape.points.push_back({x, 0});
      shape.bulges.push_back(1);
    }
    shape.loop_begin.push_back(static_cast<std::uint32_t>(shape.points.size()));
    shape.component.push_back(0);
    shape.hole.push_back(false);
  }
  const verify_detail::DistanceTree tree(shape);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 20'000; ++i) {
    const double r = 1 + (rings - 1) * unit(random), angle = 6.28 * unit(random);
    const double nearest = std::abs(r - std::round(r));
    EXPECT_NEAR(tree.distance({r * std::cos(angle), r * std::sin(angle)}, nearest + 1e-9), nearest,
                1e-11);
  }
}

/// Triangles that meet at one vertex: every query there would look at all of them.
TEST(DistanceTreeOfArcs, StopsAtZero) {
  constexpr int triangles = 20'000;
  Shape shape;
  shape.loop_begin = {0};
  for (int k = 0; k < triangles; ++k) {
    for (const double part : {0.0, 0.5}) {
      const double angle = 6.283 * (k + part) / triangles;
      if (part == 0) shape.points.push_back({0, 0});
      shape.points.push_back({std::cos(angle), std::sin(angle)});
    }
    shape.loop_begin.push_back(static_cast<std::uint32_t>(shape.points.size()));
    shape.component.push_back(0);
    shape.hole.push_back(false);
  }
  const verify_detail::DistanceTree tree(shape);
  for (int i = 0; i < triangles; ++i) EXPECT_EQ(tree.distance({0, 0}, 1e-12), 0);
}

}  // namespace
/// Two arcs that meet in reflex vertices, with a disk's centre in the middle of both: one arc ends
/// where the other's centre is as far away as the vertices, which are touched instead.
TEST(VerifyArcs, AnEdgeThatTouchesAVertexIsNotNamedAfterItsArc) {
  for (const double y : {0.0, 1e-3, -25444.357876001024}) {
    for (const bool upper : {true, false}) {
      const auto shape = build_shape(
          {{{{{1, y}, {-1, y}}, RingRole::any, {upper ? 1.0001586 : 1, upper ? 1 : 1.0001586}}}});
      ASSERT_TRUE(shape);
      auto axis = compute(*shape, {.threads = 1});
      ASSERT_TRUE(axis);
      EXPECT_TRUE(verify(*shape, *axis, {.threads = 1}).passed);
      ASSERT_EQ(axis->edges.size(), 1U);
      for (std::uint32_t& side : axis->edges[0].site) {
        const std::uint32_t vertex = side;
        ASSERT_EQ(axis->sites[vertex].kind(), SiteKind::vertex);
        for (std::uint32_t other = 0; other < axis->sites.size(); ++other) {
          if (axis->sites[other].kind() != SiteKind::arc) continue;
          side = other;
          EXPECT_FALSE(verify(*shape, *axis, {.threads = 1}).passed) << y << upper << other;
        }
        side = vertex;
      }
    }
  }
}

}  // namespace medial
