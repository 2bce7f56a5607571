#include "medial/query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "axis/node_kinds.h"
#include "axis/steps.h"
#include "support/hand_made.h"

namespace medial {
namespace {

using test::all_hand_made;
using test::ell;
using test::HandMade;
using test::hourglass;
using test::notch;
using test::rectangle;
using test::square_with_hole;

double distance_to(const Site& site, Vec2 p) { return distance(foot(site, p), p); }

/// Simpson's rule over many chords: a length without any closed form.
double length_by_chords(const MedialAxis& axis, const Edge& edge) {
  double coarse = 0, fine = 0;
  constexpr int n = 4096;
  for (int i = 0; i < n; ++i) {
    const Vec2 a = disk_at(axis, edge, static_cast<double>(i) / n).center;
    const Vec2 b = disk_at(axis, edge, (i + 0.5) / n).center;
    const Vec2 c = disk_at(axis, edge, (i + 1.0) / n).center;
    coarse += distance(a, c);
    fine += distance(a, b) + distance(b, c);
  }
  return fine + (fine - coarse) / 3;
}

MedialAxis parabola(Vec2 a, Vec2 control, Vec2 b) {
  MedialAxis axis;
  axis.nodes = {{{a, 1}, 0, NodeKind::leaf}, {{b, 1}, 0, NodeKind::leaf}};
  axis.edges = {{{0, 1}, {0, 0}, {control, 1}, 1}};
  return axis;
}

TEST(DiskAt, TouchesBothSitesAlongEveryEdge) {
  for (const HandMade& m : all_hand_made()) {
    for (const Edge& edge : m.axis.edges) {
      for (int i = 0; i <= 64; ++i) {
        const Disk disk = disk_at(m.axis, edge, i / 64.0);
        for (const std::uint32_t site : edge.site)
          EXPECT_NEAR(distance_to(m.axis.sites[site], disk.center), disk.radius, 4e-15);
      }
    }
  }
}

TEST(DiskAt, IsExactlyTheNodeAtTheEnds) {
  const HandMade m = hourglass();
  for (const Edge& edge : m.axis.edges) {
    for (const int end : {0, 1}) {
      const Disk expected = m.axis.nodes[edge.node[static_cast<std::size_t>(end)]].disk;
      const Disk disk = disk_at(m.axis, edge, end);
      EXPECT_EQ(disk.center, expected.center);
      EXPECT_EQ(disk.radius, expected.radius);
    }
  }
}

TEST(Foot, OfSegmentAndVertex) {
  const Site segment{{0, 0}, {4, 0}, 0, 0};
  EXPECT_EQ(foot(segment, {1, 3}), (Vec2{1, 0}));
  EXPECT_EQ(foot(segment, {-2, 3}), (Vec2{0, 0}));
  EXPECT_EQ(foot(segment, {9, 3}), (Vec2{4, 0}));
  const Site vertex{{1e7, 2}, {1e7, 2}, 0, 0};
  EXPECT_EQ(foot(vertex, {1, 3}), (Vec2{1e7, 2}));
}

TEST(Length, OfStraightEdges) {
  const HandMade m = rectangle();
  EXPECT_DOUBLE_EQ(length(m.axis, m.axis.edges[0]), 2);
  EXPECT_NEAR(total_length(m.axis), 2 + 4 * std::sqrt(2.0), 1e-14);
  EXPECT_DOUBLE_EQ(length(hourglass().axis, hourglass().axis.edges[0]), 1);
}

TEST(Length, OfTheUnitParabola) {
  // y = x^2 over [0, 1]: sqrt(5) / 2 + asinh(2) / 4.
  const MedialAxis axis = parabola({0, 0}, {0.5, 0}, {1, 1});
  EXPECT_NEAR(length(axis, axis.edges[0]), std::sqrt(5.0) / 2 + std::asinh(2.0) / 4, 1e-15);
}

TEST(Length, IsSmoothFromBentToStraight) {
  // Legs of 1, a corner that flattens: across the change of formula, against chords.
  for (int i = 0; i <= 60; ++i) {
    const double bend = std::ldexp(1.0, -i);
    const MedialAxis axis = parabola({-1, 0}, {0, bend}, {1, 0});
    const double expected = length_by_chords(axis, axis.edges[0]);
    EXPECT_NEAR(length(axis, axis.edges[0]), expected, 1e-12 * expected) << bend;
  }
}

TEST(Length, OfDegenerateEdges) {
  const MedialAxis point = parabola({3, 3}, {3, 3}, {3, 3});
  EXPECT_EQ(length(point, point.edges[0]), 0);
  const MedialAxis back = parabola({0, 0}, {1, 0}, {0, 0});  // to 1/2 and back
  EXPECT_NEAR(length(back, back.edges[0]), 1, 1e-15);
  const MedialAxis tiny = parabola({0, 0}, {0.5e-12, 0}, {1e-12, 1e-12});
  EXPECT_NEAR(length(tiny, tiny.edges[0]), 1e-12 * (std::sqrt(5.0) / 2 + std::asinh(2.0) / 4),
              1e-26);
}

/// Largest distance in (x, y) and in r between the edge and the chain of samples, seen from points
/// of the curve; the radius of the chord is taken at the nearest point.
double deviation(const MedialAxis& axis, const Edge& edge, const std::vector<Disk>& samples) {
  double worst = 0;
  for (int i = 0; i <= 2000; ++i) {
    const Disk disk = disk_at(axis, edge, i / 2000.0);
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j + 1 < samples.size(); ++j) {
      const Vec2 d = samples[j + 1].center - samples[j].center;
      const double t =
          std::clamp(dot(disk.center - samples[j].center, d) / squared_norm(d), 0.0, 1.0);
      const double gap = distance(disk.center, samples[j].center + t * d);
      const double r = samples[j].radius + t * (samples[j + 1].radius - samples[j].radius);
      best = std::min(best, std::max(gap, std::abs(disk.radius - r)));
    }
    worst = std::max(worst, best);
  }
  return worst;
}

TEST(SampleByChord, StaysWithinTheChord) {
  for (const HandMade& m : all_hand_made()) {
    for (const Edge& edge : m.axis.edges) {
      for (const double chord : {1e-1, 1e-2, 1e-3, 1e-5}) {
        const auto samples = sample_by_chord(m.axis, edge, chord);
        EXPECT_EQ(samples.front().center, m.axis.nodes[edge.node[0]].disk.center);
        EXPECT_EQ(samples.back().center, m.axis.nodes[edge.node[1]].disk.center);
        EXPECT_LE(deviation(m.axis, edge, samples), 1.001 * chord);
      }
    }
  }
}

TEST(SampleByChord, SpendsNoPointsOnLinesAndFewOnCurves) {
  const HandMade line = rectangle();
  EXPECT_EQ(sample_by_chord(line.axis, line.axis.edges[0], 1e-9).size(), 2U);
  const HandMade curved = notch();
  const auto size = [&](double chord) {
    return sample_by_chord(curved.axis, curved.axis.edges[0], chord).size();
  };
  EXPECT_GT(size(1e-6), 50U);
  EXPECT_LT(size(1e-6), 2000U);
  EXPECT_LE(size(0), 100001U);
  const HandMade waist = hourglass();
  EXPECT_LE(sample_by_chord(waist.axis, waist.axis.edges[0], 0).size(), 100001U);
  EXPECT_GT(sample_by_chord(waist.axis, waist.axis.edges[0], 1e-4).size(), 4U);
}

TEST(SampleByStep, StepsAreEqualAndSmallEnough) {
  for (const HandMade& m : all_hand_made()) {
    for (const Edge& edge : m.axis.edges) {
      const auto samples = sample_by_step(m.axis, edge, 0.01);
      const double total = length(m.axis, edge);
      EXPECT_EQ(samples.size(), static_cast<std::size_t>(std::ceil(total / 0.01)) + 1);
      const double step = total / static_cast<double>(samples.size() - 1);
      for (std::size_t i = 0; i + 1 < samples.size(); ++i)
        EXPECT_NEAR(distance(samples[i].center, samples[i + 1].center), step, 1e-5);
    }
  }
}

TEST(Incidence, ListsEdgesByIndex) {
  const HandMade m = rectangle();
  const Incidence incidence(m.axis);
  EXPECT_EQ(std::vector<std::uint32_t>(incidence.edges(0).begin(), incidence.edges(0).end()),
            (std::vector<std::uint32_t>{0, 1, 4}));
  EXPECT_EQ(incidence.degree(2), 1U);
}

TEST(Branches, JoinChainsThroughChangesOfSites) {
  const HandMade m = ell();  // 5 leaves, 3 branching nodes, 2 changes of sites: 7 branches
  const auto all = branches(m.axis);
  EXPECT_EQ(all.size(), 7U);
  std::vector<int> used(m.axis.edges.size(), 0);
  std::uint32_t lowest_before = 0;
  for (const Branch& branch : all) {
    std::uint32_t lowest = branch.steps.front().edge;
    std::uint32_t at = branch.from;
    for (const Step step : branch.steps) {
      ++used[step.edge];
      lowest = std::min(lowest, step.edge);
      const auto& node = m.axis.edges[step.edge].node;
      EXPECT_EQ(node[step.forward ? 0 : 1], at);
      at = node[step.forward ? 1 : 0];
    }
    EXPECT_EQ(at, branch.to);
    EXPECT_GE(lowest, lowest_before);
    lowest_before = lowest;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 1), static_cast<int>(used.size()));
}

TEST(Branches, ClosedChainsAndLoops) {
  MedialAxis axis;
  axis.nodes.resize(4);
  // A ring of three nodes, and a node with an edge to itself.
  axis.edges = {{{1, 0}, {0, 0}, {}, 1},
                {{1, 2}, {0, 0}, {}, 1},
                {{2, 0}, {0, 0}, {}, 1},
                {{3, 3}, {0, 0}, {}, 1}};
  const auto all = branches(axis);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].steps.size(), 3U);
  EXPECT_EQ(all[0].from, all[0].to);
  EXPECT_EQ(all[1].steps.size(), 1U);
  EXPECT_EQ(all[1].from, 3U);
  EXPECT_EQ(all[1].to, 3U);
  EXPECT_TRUE(branches(MedialAxis{}).empty());
}

TEST(DeepestNode, IsTheMaximumInscribedCircle) {
  EXPECT_EQ(deepest_node(rectangle().axis), 0U);  // the lowest of two equals
  const HandMade m = ell();
  EXPECT_DOUBLE_EQ(m.axis.nodes[deepest_node(m.axis)].disk.radius, 4 - 2 * std::sqrt(2.0));
}

TEST(AxisLocator, AgreesWithDenseSamples) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-5, 12);
  for (const HandMade& m : all_hand_made()) {
    const AxisLocator locator(m.axis);
    std::vector<Vec2> dense;
    for (const Edge& edge : m.axis.edges)
      for (int i = 0; i <= 4000; ++i) dense.push_back(disk_at(m.axis, edge, i / 4000.0).center);
    for (int i = 0; i < 200; ++i) {
      const Vec2 p{coordinate(random), coordinate(random)};
      const AxisPoint found = locator.nearest(p);
      double best = std::numeric_limits<double>::infinity();
      for (const Vec2 q : dense) best = std::min(best, distance(p, q));
      EXPECT_LE(found.distance, best + 1e-14);
      EXPECT_GE(found.distance, best - 1e-3);
      EXPECT_NEAR(distance(found.disk.center, p), found.distance, 1e-13);
      EXPECT_EQ(disk_at(m.axis, m.axis.edges[found.edge], found.t).center, found.disk.center);
    }
  }
}

TEST(AxisLocator, FindsPointsOfTheAxisInALargeGrid) {
  // Thousands of parabolas: every point of each is at distance 0 from the axis.
  MedialAxis axis;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(0, 100), small(-1, 1), unit(0, 1);
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const Vec2 a{coordinate(random), coordinate(random)};
    axis.nodes.push_back({{a, 1}, 0, NodeKind::leaf});
    axis.nodes.push_back({{a + Vec2{small(random), small(random)}, 1}, 0, NodeKind::leaf});
    axis.edges.push_back(
        {{2 * i, 2 * i + 1}, {0, 0}, {a + Vec2{small(random), small(random)}, 1}, 1});
  }
  const AxisLocator locator(axis);
  for (const Edge& edge : axis.edges) {
    const Vec2 on = disk_at(axis, edge, unit(random)).center;
    EXPECT_LE(locator.nearest(on).distance, 3e-14);
  }
  for (int i = 0; i < 300; ++i) {
    const Vec2 p{coordinate(random), coordinate(random)};
    double best = std::numeric_limits<double>::infinity();
    for (const Edge& edge : axis.edges)
      for (int j = 0; j <= 100; ++j)
        best = std::min(best, distance(p, disk_at(axis, edge, j / 100.0).center));
    EXPECT_LE(locator.nearest(p).distance, best + 1e-14);
  }
}

TEST(AxisLocator, EmptyAxis) {
  const MedialAxis axis;
  EXPECT_EQ(AxisLocator(axis).nearest({0, 0}).distance, std::numeric_limits<double>::infinity());
}

TEST(Clearance, InsideOutsideAndInHoles) {
  const HandMade m = square_with_hole();
  EXPECT_DOUBLE_EQ(clearance(m.shape, {2, 5}), 2);
  EXPECT_DOUBLE_EQ(clearance(m.shape, {3, 3}), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(clearance(m.shape, {5, 5}), -1);
  EXPECT_DOUBLE_EQ(clearance(m.shape, {13, 14}), -5);
  EXPECT_EQ(std::abs(clearance(m.shape, {0, 3})), 0);
  // At the height of vertices.
  EXPECT_DOUBLE_EQ(clearance(m.shape, {1, 4}), 1);
  EXPECT_DOUBLE_EQ(clearance(m.shape, {1, 6}), 1);
  EXPECT_DOUBLE_EQ(clearance(m.shape, {-1, 0}), -1);
  EXPECT_DOUBLE_EQ(clearance(m.shape, {-1, 10}), -1);
}

TEST(Clearance, DecidesNextToTheBoundaryExactly) {
  // A long slanted edge: points one unit in the last place beside it are on the right side.
  const HandMade m({{{0, 0}, {3, 1}, {0, 1}}});
  const double y = 0.1, x = 0.3;  // 3 * 0.1 rounds: 0.3 < 3 y exactly
  EXPECT_GE(clearance(m.shape, {std::nextafter(x, 0), y}), 0);
  EXPECT_LE(clearance(m.shape, {std::nextafter(std::nextafter(x, 1), 1), y}), 0);
}

}  // namespace
}  // namespace medial
