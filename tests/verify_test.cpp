#include "medial/verify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "medial/compute.h"
#include "support/distance_check.h"
#include "support/generate.h"
#include "support/hand_made.h"
#include "support/property.h"
#include "verify/between_feet.h"
#include "verify/distance_tree.h"
#include "verify/piece_order.h"

namespace medial {
namespace {

using test::all_hand_made;
using test::ell;
using test::HandMade;
using test::hourglass;
using test::joined;
using test::notch;
using test::rectangle;
using test::square_with_hole;

/// Expects that the axis is refused, with a sentence that holds `words`.
void expect_failure(const HandMade& m, const std::string& words) {
  const Certificate certificate = verify(m.shape, m.axis);
  EXPECT_FALSE(certificate.passed) << words;
  EXPECT_NE(joined(certificate).find(words), std::string::npos)
      << "expected: " << words << "\ngot: " << joined(certificate);
}

/// The same under p -> scale * p + shift.
HandMade moved(HandMade m, double scale, Vec2 shift) {
  const auto move = [&](Vec2 p) { return scale * p + shift; };
  for (Vec2& p : m.shape.points) p = move(p);
  for (Site& site : m.axis.sites) {
    site.start = move(site.start);
    site.end = move(site.end);
  }
  for (Node& node : m.axis.nodes) node.disk = {move(node.disk.center), scale * node.disk.radius};
  for (Edge& edge : m.axis.edges)
    edge.control = {move(edge.control.center), scale * edge.control.radius};
  return m;
}

TEST(Verify, PassesAxesInClosedForm) {
  for (const HandMade& m : all_hand_made()) {
    const Certificate certificate = verify(m.shape, m.axis);
    EXPECT_TRUE(certificate.passed) << joined(certificate);
    EXPECT_LE(certificate.largest_residual, 4e-15);
    EXPECT_LE(certificate.largest_intrusion, 4e-15);
    EXPECT_LE(certificate.largest_contact_gap, 4e-15);
    EXPECT_LE(certificate.largest_uncovered, 4e-15);
    EXPECT_NEAR(certificate.disks_area, certificate.shape_area, 1e-13);
    EXPECT_EQ(certificate.worst_legality, 0);
    EXPECT_EQ(certificate.disks_checked, m.axis.nodes.size() + 8 * m.axis.edges.size());
    EXPECT_EQ(certificate.graph_parts, 1U);
    EXPECT_EQ(certificate.cycles, certificate.holes);
  }
}

TEST(Verify, CountsAndAreas) {
  const HandMade m = square_with_hole();
  const Certificate certificate = verify(m.shape, m.axis);
  EXPECT_EQ(certificate.components, 1U);
  EXPECT_EQ(certificate.holes, 1U);
  EXPECT_EQ(certificate.cycles, 1U);
  EXPECT_EQ(certificate.convex_corners, 4U);
  EXPECT_EQ(certificate.reflex_vertices, 4U);
  EXPECT_DOUBLE_EQ(certificate.shape_area, 96);
  EXPECT_NEAR(certificate.tolerance, 1e-14 * std::hypot(10, 10), 1e-18);
}

TEST(Verify, PassesAtAnyScaleAndFarFromTheOrigin) {
  for (const HandMade& m : all_hand_made()) {
    for (const double scale : {1e-9, 1e-6, 1.0, 1e9}) {
      for (const Vec2 shift : {Vec2{0, 0}, Vec2{1e7, -1e7}}) {
        if (shift.x != 0 && scale < 1) continue;  // the points would coincide
        const HandMade there = moved(m, scale, shift);
        const Certificate certificate = verify(there.shape, there.axis);
        EXPECT_TRUE(certificate.passed) << scale << " " << shift.x << "\n" << joined(certificate);
      }
    }
  }
}

TEST(Verify, IsTheSameOnAnyNumberOfThreads) {
  HandMade m = square_with_hole();
  m.axis.nodes[3].disk.radius += 1e-5;
  m.axis.nodes[7].disk.radius += 1e-5;
  VerifyOptions options;
  options.threads = 1;
  const Certificate one = verify(m.shape, m.axis, options);
  for (const int threads : {2, 8}) {
    options.threads = threads;
    const Certificate many = verify(m.shape, m.axis, options);
    EXPECT_EQ(one.failures, many.failures);
    EXPECT_EQ(one.largest_residual, many.largest_residual);
    EXPECT_EQ(one.worst, many.worst);
    EXPECT_EQ(one.disks_area, many.disks_area);
  }
}

TEST(Verify, PassesTheEmptyAxisOfTheEmptyShapeOnly) {
  EXPECT_TRUE(verify(Shape{}, MedialAxis{}).passed);
  EXPECT_FALSE(verify(rectangle().shape, MedialAxis{}).passed);
  EXPECT_FALSE(verify(Shape{}, rectangle().axis).passed);
}

TEST(VerifyFinds, MovedNode) {
  for (HandMade m : all_hand_made()) {
    for (std::size_t i = 0; i < m.axis.nodes.size(); ++i) {
      HandMade damaged = m;
      damaged.axis.nodes[i].disk.center.x += 1e-9;
      const Certificate certificate = verify(damaged.shape, damaged.axis);
      EXPECT_FALSE(certificate.passed) << i;
    }
  }
  HandMade m = rectangle();
  m.axis.nodes[0].disk.center.y += 1e-9;
  expect_failure(m,
                 "1 nodes have disks that reach over the boundary; the worst by 1e-09 at node 0");
}

TEST(VerifyFinds, WrongRadius) {
  for (const double change : {1e-12, 1e-3}) {
    HandMade m = ell();
    m.axis.nodes[1].disk.radius += change;
    expect_failure(m, "1 nodes have disks that reach over the boundary");
    expect_failure(m, "do not touch a site of their edge");
    m.axis.nodes[1].disk.radius -= 2 * change;
    expect_failure(m, "1 nodes have a radius that is not the distance to the boundary");
  }
  HandMade m = rectangle();
  m.axis.nodes[2].disk.radius = 1e-3;
  expect_failure(m, "1 of 4 convex corners are not leaves of radius 0; the first is (0, 0)");
  expect_failure(
      m,
      "1 leaves have a radius above 0 and are at no arc of largest curvature; the first is node 2");
}

TEST(VerifyFinds, MovedControlPoint) {
  for (const HandMade& m : all_hand_made()) {
    for (std::size_t i = 0; i < m.axis.edges.size(); ++i) {
      HandMade damaged = m;
      damaged.axis.edges[i].control.radius += 1e-11;
      expect_failure(damaged, "points inside edges have disks that reach over the boundary");
      // Across the edge; along a straight one nothing would change but the speed.
      damaged = m;
      const Vec2 d = m.axis.nodes[m.axis.edges[i].node[1]].disk.center -
                     m.axis.nodes[m.axis.edges[i].node[0]].disk.center;
      damaged.axis.edges[i].control.center =
          m.axis.edges[i].control.center + (1e-7 / norm(d)) * left_of(d);
      EXPECT_FALSE(verify(damaged.shape, damaged.axis).passed) << i;
    }
  }
}

TEST(VerifyFinds, WrongWeight) {
  HandMade m = hourglass();
  m.axis.edges[0].weight = 1;
  expect_failure(m, "points inside edges have");
}

TEST(VerifyFinds, AnyDroppedEdge) {
  for (const HandMade& m : all_hand_made()) {
    for (std::size_t i = 0; i < m.axis.edges.size(); ++i) {
      HandMade damaged = m;
      damaged.axis.edges.erase(damaged.axis.edges.begin() + static_cast<std::ptrdiff_t>(i));
      damaged.finish();
      // Between two vertices, the disks of both ends cover those of the edge.
      if (m.axis.edges[i].weight == 1)
        expect_failure(damaged, "which differs from the shape's area");
      const Certificate certificate = verify(damaged.shape, damaged.axis);
      EXPECT_NE(certificate.graph_parts + certificate.holes,
                certificate.components + certificate.cycles);
    }
  }
  HandMade m = rectangle();
  m.axis.edges.erase(m.axis.edges.begin());
  m.finish();
  expect_failure(m, "The graph has 2 connected parts for 1 component; component 0 has 2 of them");
  expect_failure(m, "A stretch of the boundary is touched by no disk");
}

TEST(VerifyFinds, DroppedLeaf) {
  HandMade m = rectangle();
  m.axis.edges.pop_back();
  m.axis.nodes.pop_back();
  m.finish();
  expect_failure(m, "1 of 4 convex corners are not leaves of radius 0; the first is (0, 2)");
  expect_failure(m, "A stretch of the boundary is touched by no disk");
  expect_failure(m, "The disks cover an area of");
}

TEST(VerifyFinds, BrokenCycle) {
  HandMade m = square_with_hole();
  m.axis.edges.erase(m.axis.edges.begin() + 1);  // along the hole's lower side
  m.finish();
  expect_failure(m, "Component 0 has 0 independent cycles for 1 hole");
}

TEST(VerifyFinds, ExtraCycle) {
  HandMade m = rectangle();
  m.axis.edges.push_back(m.axis.edges[0]);
  expect_failure(m, "Component 0 has 1 independent cycle for 0 holes");
  expect_failure(m, "The disks cover an area of");
}

TEST(VerifyFinds, StrayNode) {
  HandMade m = rectangle();
  m.node(2, 1, 1);
  m.finish();
  expect_failure(m, "The graph has 2 connected parts");
  expect_failure(m, "the first is node 6 with 0 edges");
}

TEST(VerifyFinds, SwappedSites) {
  for (const HandMade& m : all_hand_made()) {
    for (std::size_t i = 0; i < m.axis.edges.size(); ++i) {
      HandMade damaged = m;
      std::swap(damaged.axis.edges[i].site[0], damaged.axis.edges[i].site[1]);
      expect_failure(damaged, "1 edges have their sites on the wrong sides");
    }
  }
}

TEST(VerifyFinds, WrongSite) {
  HandMade m = rectangle();
  m.axis.edges[0].site[0] = m.segment_site[1];
  expect_failure(m, "disks of edges do not touch a site of their edge");
  m = rectangle();
  m.axis.edges[0].site[0] = m.axis.edges[0].site[1];
  expect_failure(m, "1 edges lie between a site and itself; the first is edge 0");
}

TEST(VerifyFinds, EdgesNextToTheirVertexAsSites) {
  const HandMade m = ell();
  int vertices = 0;
  for (std::size_t e = 0; e < m.axis.edges.size(); ++e)
    for (const std::uint32_t vertex : m.axis.edges[e].site) {
      if (m.axis.sites[vertex].kind() != SiteKind::vertex) continue;
      ++vertices;
      for (std::uint32_t i = 0; i < m.axis.sites.size(); ++i) {
        const Site& next = m.axis.sites[i];
        const Vec2 at = m.axis.sites[vertex].start;
        if (i == vertex || !(next.start == at || next.end == at)) continue;
        HandMade spoilt = m;
        for (std::uint32_t& own : spoilt.axis.edges[e].site)
          if (own == vertex) own = i;
        expect_failure(spoilt, "do not touch a site of their edge");
      }
    }
  EXPECT_GT(vertices, 0);
}

TEST(VerifyFinds, DisksBeyondTheNormalAtAVertex) {
  // They touch the vertex, as their edge says, but reach over the boundary edge next to it: of
  // disks behind the normal no such edge is looked at.
  for (const double off : {1e-6, 1e-3, 0.1}) {
    HandMade m = ell();
    Disk& disk = m.axis.nodes[m.axis.edges[1].node[1]].disk;
    ASSERT_EQ(disk.center, (Vec2{2, 1}));
    const double radius = 1 + 0.25 * off * off;  // touches (2, 2), and y = 0
    disk = {{2 + off, radius}, radius};
    expect_failure(m, "1 nodes have disks that reach over the boundary");
  }
}

TEST(VerifyFinds, ForeignSite) {
  HandMade m = ell();
  m.axis.sites[2].start.x += 1e-6;
  expect_failure(
      m, "1 sites are neither an edge nor a reflex vertex of the shape; the first is site 2");
}

TEST(VerifyFinds, ArcAsASiteOfAPolygon) {
  HandMade m = rectangle();
  m.axis.sites[0].bulge = 0.5;
  expect_failure(m, "1 sites are neither an edge nor a reflex vertex");
}

TEST(VerifyFinds, MissingReflexVertex) {
  // The axis of the rectangle that remains when the notch's sites are ignored.
  HandMade m = notch();
  for (Edge& edge : m.axis.edges)
    for (std::uint32_t& site : edge.site)
      if (m.axis.sites[site].kind() == SiteKind::vertex) site = m.segment_site[5];
  // Both neighbours' disks still touch the vertex, so it counts as touched; the edge does not fit.
  expect_failure(m, "do not touch a site");
}

TEST(VerifyFinds, AxisOfAnotherShape) {
  HandMade m = notch();
  m.axis = rectangle().axis;
  for (Node& node : m.axis.nodes) node.disk.radius /= 2;  // or one touches the notch by chance
  expect_failure(m, "convex corners are not leaves of radius 0");
  expect_failure(m, "1 of 1 reflex vertices are touched by no disk; the first is (3, 2)");
  expect_failure(m, "sites are neither an edge nor a reflex vertex");
}

TEST(VerifyFinds, KindsThatDoNotFit) {
  HandMade m = rectangle();
  m.axis.nodes[0].kind = NodeKind::site_change;
  expect_failure(m, "the first is node 0 with 3 edges");
  m = rectangle();
  m.axis.nodes[5].kind = static_cast<NodeKind>(77);
  expect_failure(m, "the first is node 5 with 1 edges");
}

TEST(VerifyFinds, IllegalBranch) {
  // A curve whose radius grows faster than its length: no disk of it is maximal.
  HandMade m = rectangle();
  m.axis.edges[0].control.radius = 9;
  expect_failure(m, "Shaked and Bruckstein");
  // A parabola bent twice as much as its radii allow.
  m = notch();
  Disk& control = m.axis.edges[0].control;
  control.center.y += control.center.y - m.axis.nodes[0].disk.center.y;
  expect_failure(m, "Shaked and Bruckstein");
}

TEST(VerifyFinds, BrokenIndicesAndNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  HandMade m = rectangle();
  m.axis.edges[1].node[1] = 6;
  expect_failure(m, "1 edges name a node that the axis does not have; the first is edge 1");
  m = rectangle();
  m.axis.edges[2].site[0] = 0xFFFFFFFF;
  expect_failure(m, "1 edges name a site that the axis does not have; the first is edge 2");
  m = rectangle();
  m.axis.nodes[1].disk.center.y = nan;
  expect_failure(m, "1 nodes have a coordinate or radius that is not finite; the first is node 1");
  m = rectangle();
  m.axis.nodes[1].disk.radius = -1;
  expect_failure(m, "1 nodes have a negative radius");
  m = rectangle();
  m.axis.nodes[1].component = 1;
  expect_failure(m, "1 nodes name a component that the shape does not have");
  m = rectangle();
  m.axis.edges[0].control.radius = infinity;
  expect_failure(m, "1 edges have a control point that is not finite");
  for (const double weight : {nan, infinity, -1.0, 0.0}) {
    m = rectangle();
    m.axis.edges[3].weight = weight;
    expect_failure(m,
                   "1 edges have a weight that is not finite or not positive; the first is edge 3");
  }
  m = rectangle();
  m.axis.sites[1].end.x = nan;
  expect_failure(m, "1 sites have a coordinate that is not finite or a bulge above 1");
  for (const double tolerance : {nan, -1.0, 1.0}) {
    m = rectangle();
    m.axis.tolerance = tolerance;
    expect_failure(m, "claims a tolerance");
  }
  // Too far away for any distance to be a number.
  for (const double far : {1e155, 1e300, -1e300}) {
    m = rectangle();
    m.axis.nodes[0].disk.center.x = far;
    expect_failure(m, "1 nodes have a radius that is not the distance to the boundary");
    expect_failure(m, "do not touch a site of their edge");
    m = rectangle();
    m.axis.edges[0].control.center = {far, -far};
    expect_failure(m, "points inside edges have a radius");
  }
  expect_failure(moved(rectangle(), 1e101, {0, 0}), "The shape cannot be checked");
  expect_failure(moved(rectangle(), 1e-101, {0, 0}), "The shape cannot be checked");
  m = rectangle();
  m.shape.loop_begin[1] = 9;
  expect_failure(m, "The shape itself is malformed");
  m = rectangle();  // no component is left, though there is a loop
  m.shape.hole[0] = true;
  expect_failure(m, "The shape itself is malformed");
}

TEST(VerifyFinds, NodesOfAnotherComponent) {
  // Two rectangles; the second one's axis says that it belongs to the first.
  const HandMade far = moved(rectangle(), 1, {10, 0});
  HandMade m = rectangle();
  const auto points = static_cast<std::uint32_t>(m.shape.points.size());
  const auto nodes = static_cast<std::uint32_t>(m.axis.nodes.size());
  const auto sites = static_cast<std::uint32_t>(m.axis.sites.size());
  m.shape.points.insert(m.shape.points.end(), far.shape.points.begin(), far.shape.points.end());
  m.shape.sources.insert(m.shape.sources.end(), far.shape.sources.begin(), far.shape.sources.end());
  m.shape.loop_begin.push_back(2 * points);
  m.shape.component.push_back(1);
  m.shape.hole.push_back(false);
  m.axis.sites.insert(m.axis.sites.end(), far.axis.sites.begin(), far.axis.sites.end());
  for (Node node : far.axis.nodes) {
    node.component = 1;
    m.axis.nodes.push_back(node);
  }
  for (Edge edge : far.axis.edges) {
    for (std::size_t end = 0; end < 2; ++end) {
      edge.node[end] += nodes;
      edge.site[end] += sites;
    }
    m.axis.edges.push_back(edge);
  }
  const Certificate certificate = verify(m.shape, m.axis);
  EXPECT_TRUE(certificate.passed) << joined(certificate);
  EXPECT_EQ(certificate.components, 2U);
  EXPECT_EQ(certificate.graph_parts, 2U);

  HandMade damaged = m;
  damaged.axis.nodes[nodes].component = 0;
  expect_failure(damaged, "nodes are connected with nodes of another component");
  damaged = m;
  for (Node& node : damaged.axis.nodes) node.component = 0;
  expect_failure(damaged, "The graph has 2 connected parts for 2 components");
}

TEST(Verify, JudgesAgainstTheAskedTolerance) {
  HandMade m = rectangle();
  for (const std::uint32_t node : {0U, 1U}) m.axis.nodes[node].disk.radius -= 1e-8;
  m.axis.edges[0].control.radius -= 1e-8;
  EXPECT_FALSE(verify(m.shape, m.axis).passed);
  m.axis.tolerance = 1e-7;
  EXPECT_TRUE(verify(m.shape, m.axis).passed) << joined(verify(m.shape, m.axis));
  m.axis.tolerance = 0;
  VerifyOptions options;
  options.tolerance = 1e-8;
  EXPECT_TRUE(verify(m.shape, m.axis, options).passed);
  options.tolerance = 1e-9;
  EXPECT_FALSE(verify(m.shape, m.axis, options).passed);
}

TEST(Verify, NeverCrashesOnRandomDamage) {
  // Anything may stand in a file: indices, kinds and numbers are overwritten at random.
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return random() % n; };
  const double numbers[] = {0,      1,   -1, 1e300, -1e300,
                            1e-300, 0.5, 3,  1e16,  std::numeric_limits<double>::denorm_min()};
  for (int round = 0; round < 3000; ++round) {
    auto all = all_hand_made();
    HandMade& m = all[below(all.size())];
    for (std::size_t k = 0; k <= below(3); ++k) {
      Node& node = m.axis.nodes[below(m.axis.nodes.size())];
      Edge& edge = m.axis.edges[below(m.axis.edges.size())];
      Site& site = m.axis.sites[below(m.axis.sites.size())];
      const double number = numbers[below(std::size(numbers))];
      switch (below(10)) {
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
          edge.control.radius = number;
          break;
        case 4:
          edge.weight = number;
          break;
        case 5:
          edge.node[below(2)] = static_cast<std::uint32_t>(below(m.axis.nodes.size() + 1));
          break;
        case 6:
          edge.site[below(2)] = static_cast<std::uint32_t>(below(m.axis.sites.size() + 1));
          break;
        case 7:
          site.start.x = number;
          break;
        case 8:
          site.bulge = number;
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

TEST(VerifyFinds, DamageInComputedAxes) {
  // The engine may be wrong here, so damage only axes that pass; but most must pass.
  constexpr unsigned count = 150;
  unsigned passed = 0;
  for (unsigned seed = 0; seed < count; ++seed) {
    const auto shape = build_shape(test::random_shape(seed).rings);
    ASSERT_TRUE(shape.ok()) << seed;
    const auto computed = compute(*shape);
    ASSERT_TRUE(computed.ok()) << seed;
    const MedialAxis& axis = *computed;
    const Certificate certificate = verify(*shape, axis);
    if (!certificate.passed) continue;
    ++passed;
    std::mt19937 random(seed);
    const auto any_edge = static_cast<std::ptrdiff_t>(random() % axis.edges.size());
    const std::size_t any_node = random() % axis.nodes.size();

    MedialAxis damaged = axis;
    damaged.nodes[any_node].disk.radius += 3 * certificate.tolerance;
    EXPECT_FALSE(verify(*shape, damaged).passed) << seed << " node " << any_node;
    damaged = axis;
    damaged.edges[static_cast<std::size_t>(any_edge)].control.radius += 12 * certificate.tolerance;
    EXPECT_FALSE(verify(*shape, damaged).passed) << seed << " edge " << any_edge;
    damaged = axis;
    damaged.edges.erase(damaged.edges.begin() + any_edge);
    EXPECT_FALSE(verify(*shape, damaged).passed) << seed << " edge " << any_edge;
    damaged = axis;
    damaged.edges.push_back(axis.edges[static_cast<std::size_t>(any_edge)]);
    EXPECT_FALSE(verify(*shape, damaged).passed) << seed << " edge " << any_edge;
  }
  EXPECT_GE(passed, count * 3 / 4);
}

TEST(DistanceTree, AgreesWithBruteForce) {
  // A spiral saw of many edges, long ones among short ones.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const std::size_t count : {3U, 16U, 17U, 64U, 65U, 1000U, 5000U}) {
    Shape shape;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 6.28 * static_cast<double>(i) / static_cast<double>(count);
      const double r = 1 + (i % 7 == 0 ? 3 * unit(random) : 0.01 * unit(random));
      shape.points.push_back({1e5 + r * std::cos(angle), r * std::sin(angle)});
    }
    shape.loop_begin = {0, static_cast<std::uint32_t>(count)};
    shape.component = {0};
    shape.hole = {false};
    const verify_detail::DistanceTree tree(shape);
    for (int i = 0; i < 300; ++i) {
      const Vec2 p{1e5 + 10 * unit(random) - 5, 10 * unit(random) - 5};
      double expected = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < count; ++j)
        expected = std::min(expected, verify_detail::distance_to_segment(
                                          p, shape.points[j], shape.points[(j + 1) % count]));
      for (const double guess : {0.0, 0.5 * expected, expected, 2 * expected, 1e300})
        EXPECT_EQ(tree.distance(p, guess), expected);
    }
    test::expect_distances_on_curves(shape, 8, {1e5, 0});
    for (const double guess : {0.0, 1.0, 1e300}) {
      EXPECT_DOUBLE_EQ(tree.distance({1e100, 0}, guess), 1e100);
      EXPECT_FALSE(tree.distance({1e300, -1e300}, guess) <= 1e200);
    }
  }
}

/// Regular polygons of so many corners around the origin, one in the other or beside each other.
std::vector<verify_detail::BoundaryEdge> polygons(std::size_t corners, std::size_t count,
                                                  bool nested) {
  std::vector<verify_detail::BoundaryEdge> edges;
  for (std::size_t k = 0; k < count; ++k) {
    const double radius = nested ? 1 + 0.01 * static_cast<double>(k) : 0.4;
    const Vec2 centre{nested ? 0.0 : static_cast<double>(k), 0};
    const auto corner = [&](std::size_t i) {
      const double angle =
          6.28318 * static_cast<double>(i % corners) / static_cast<double>(corners);
      return centre + radius * Vec2{std::cos(angle), std::sin(angle)};
    };
    for (std::size_t i = 0; i < corners; ++i) edges.push_back({corner(i), corner(i + 1), 0});
  }
  return edges;
}

TEST(DistanceTree, RunsAreChainsUnlessTheyLieInEachOthersWay) {
  const auto chains = [](const std::vector<verify_detail::BoundaryEdge>& edges) {
    const std::vector<std::uint32_t> order = verify_detail::order_of(edges);
    std::vector<bool> seen(edges.size(), false);
    for (const std::uint32_t i : order) seen[i] = true;
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), std::ssize(edges));
    std::size_t found = 0;
    for (std::size_t i = 0; i + 3 < order.size(); i += 4)
      if (order[i] + 3 == order[i + 3] && edges[order[i]].end == edges[order[i + 1]].start) ++found;
    return found;
  };
  EXPECT_EQ(chains(polygons(400, 1, false)), 100U);
  EXPECT_EQ(chains(polygons(4, 100, false)), 100U);
  EXPECT_LE(chains(polygons(4, 100, true)), 5U);
  EXPECT_EQ(chains(polygons(3, 100, false)), 0U);
  for (const std::size_t corners : {3U, 4U, 5U, 6U, 7U, 64U}) {
    for (const bool nested : {false, true}) {
      const auto edges = polygons(corners, 60, nested);
      const verify_detail::DistanceTree tree(edges, {{-2, -2}, {62, 2}}, false);
      std::mt19937 random(1);
      std::uniform_real_distribution<double> unit(-1, 1);
      for (int i = 0; i < 100; ++i) {
        const Vec2 p{2 * unit(random), 2 * unit(random)};
        double expected = std::numeric_limits<double>::infinity();
        for (const auto& edge : edges)
          expected = std::min(expected, verify_detail::distance_to_edge(p, edge));
        EXPECT_EQ(tree.distance(p, 2 * expected), expected);
      }
    }
  }
}

/// Disks near each other in a shape, at random.
verify_detail::DiskHull random_hull(test::Random& random, const Box& box) {
  verify_detail::DiskHull hull;
  const double spread = random.power_of_ten(-4, -1) * diagonal(box);
  const Vec2 at{random.between(box.low.x, box.high.x), random.between(box.low.y, box.high.y)};
  for (Disk& disk : hull)
    disk = {at + spread * Vec2{random.between(-1, 1), random.between(-1, 1)},
            random.power_of_ten(-4, -0.3) * spread};
  return hull;
}

/// Calls `visit` with disks of a hull and an edge over which each reaches, by its number, and the
/// place of the edge nearest to the disk's centre.
template <class Visit>
void for_each_reached(const Shape& shape, const verify_detail::DiskHull& hull, const Visit& visit) {
  for (int k = 0; k <= 20; ++k) {
    const double t = k / 20.0, s = 1 - t, a = s * s, b = 2 * s * t, c = t * t;
    const Disk disk{a * hull[0].center + b * hull[1].center + c * hull[2].center,
                    a * hull[0].radius + b * hull[1].radius + c * hull[2].radius};
    for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
      const auto points = shape.loop(loop);
      for (std::size_t j = 0; j < points.size(); ++j) {
        const verify_detail::BoundaryEdge edge{points[j], points[(j + 1) % points.size()], 0};
        const Vec2 place = verify_detail::point_at(edge, verify_detail::foot_at(edge, disk.center));
        if (distance(place, disk.center) < disk.radius)
          visit(disk, shape.loop_begin[loop] + j, place);
      }
    }
  }
}

TEST(BetweenFeet, DisksReachDeeperThanThoseAtTheEndsThereOnly) {
  test::Random random(3);
  const auto at_random = [&] { return Vec2{random.between(-1, 1), random.between(-1, 1)}; };
  int missed = 0, deeper = 0;
  for (int i = 0; i < 100000; ++i) {
    verify_detail::DiskHull hull;
    for (Disk& disk : hull) disk = {at_random(), random.between(0, 2)};
    const Vec2 place = at_random();
    const auto reach = [&](const Disk& disk) { return disk.radius - distance(disk.center, place); };
    double most = reach(hull[0]);
    for (int k = 0; k <= 50; ++k) {
      const double t = k / 50.0, a = (1 - t) * (1 - t), b = 2 * t * (1 - t), c = t * t;
      most = std::max(most, reach({a * hull[0].center + b * hull[1].center + c * hull[2].center,
                                   a * hull[0].radius + b * hull[1].radius + c * hull[2].radius}));
    }
    const bool is_deeper = most > 1e-13 + std::max(reach(hull[0]), reach(hull[2]));
    verify_detail::Bounds bounds{};
    bounds.set(i % 4, {0, 1}, {place, place});
    const bool misses = verify_detail::BetweenFeet(hull, {0, 0}, 1e-15).misses(bounds, i % 4);
    EXPECT_FALSE(misses && is_deeper);
    missed += misses ? 1 : 0;
    deeper += is_deeper ? 1 : 0;
  }
  EXPECT_GT(missed, 30000);
  EXPECT_GT(deeper, 10000);
}

TEST(DistanceTree, FindsAllThatDisksReach) {
  test::Random random(7);
  const Shape shapes[] = {*build_shape(test::jagged_star(300)),
                          *build_shape(test::nested_squares(80)), *build_shape(test::blob(500)),
                          *build_shape(test::regular_polygon(500))};
  int passed_over = 0;
  for (const Shape& shape : shapes) {
    const verify_detail::DistanceTree tree(shape);
    int found = 0, found_between = 0;
    for (int i = 0; i < 1000; ++i) {
      const verify_detail::DiskHull hull = random_hull(random, bounding_box(shape));
      const auto reach = [](const Disk& disk, Vec2 place) {
        return disk.radius - distance(disk.center, place);
      };
      const auto is_near = [&](const verify_detail::NearEdges& near, std::size_t edge) {
        for (std::size_t k = 0; k < near.size; ++k)
          if (near.index[k] == edge) return true;
        return false;
      };
      verify_detail::NearEdges near, between;
      const bool all = tree.find_near(hull, 0, near);
      const bool deeper = tree.find_near_between_feet(hull, 0, between);
      found += all ? 1 : 0;
      found_between += deeper ? 1 : 0;
      for_each_reached(shape, hull, [&](const Disk& disk, std::size_t edge, Vec2 place) {
        EXPECT_TRUE(!all || is_near(near, edge));
        if (!deeper || is_near(between, edge)) return;
        ++passed_over;
        EXPECT_LE(reach(disk, place),
                  1e-13 + std::max(reach(hull[0], place), reach(hull[2], place)));
      });
    }
    EXPECT_GT(found, 800);
    EXPECT_GE(found_between, found);
    verify_detail::NearEdges near;
    EXPECT_FALSE(tree.find_near({Disk{{0, 0}, 1}, {{1e200, 0}, 1e300}, {{0, 0}, 1}}, 0, near));
  }
  EXPECT_GT(passed_over, 0);
}

TEST(DistanceTree, SettlesWhatDisksOfNeedlesReach) {
  for (const auto& rings : {test::jagged_star(2000), test::nested_squares(500)}) {
    const Shape shape = *build_shape(rings);
    const MedialAxis axis = *compute(shape);
    const verify_detail::DistanceTree tree(shape);
    std::size_t settled = 0;
    for (const Edge& edge : axis.edges) {
      const Disk &from = axis.nodes[edge.node[0]].disk, &to = axis.nodes[edge.node[1]].disk;
      verify_detail::NearEdges near;
      if (tree.find_near({from, edge.control, to}, axis.tolerance, near)) ++settled;
    }
    EXPECT_GE(1000 * settled, 999 * axis.edges.size());
  }
}

TEST(VerifyFinds, DamageNextToADiskThatAllEdgesTouch) {
  const Shape shape = *build_shape(test::regular_polygon(1000));
  const MedialAxis axis = *compute(shape);
  EXPECT_TRUE(verify(shape, axis).passed);
  const auto fails = [&](const auto& damage) {
    MedialAxis damaged = axis;
    damage(damaged);
    return !verify(shape, damaged).passed;
  };
  const std::size_t some = axis.edges.size() / 3;
  EXPECT_TRUE(fails([&](MedialAxis& of) { of.edges[some].control.radius += 1e-12; }));
  EXPECT_TRUE(fails([&](MedialAxis& of) { of.edges[some].control.center.x += 1e-9; }));
  EXPECT_TRUE(fails([&](MedialAxis& of) {
    for (Node& node : of.nodes)
      if (node.disk.radius > 0.5) node.disk.radius += 1e-12;
  }));
}

}  // namespace
}  // namespace medial
