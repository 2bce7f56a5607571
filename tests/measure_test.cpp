// Widths: closed forms, dense grids, random shapes.
#include "medial/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "axis/steps.h"
#include "medial/compute.h"
#include "medial/query.h"
#include "ops/routes.h"
#include "support/computed.h"
#include "support/generate.h"
#include "support/random_shapes.h"

namespace medial {
namespace {

using test::Computed;
using test::computed;
using test::random_any;
using test::RandomShape;
using test::Rings;

using std::numbers::pi;

/// Two chambers of 4 x 4 with a neck between them, 2 long and `width` wide.
Rings bottle(double width) {
  const double h = width / 2;
  return {test::ring_of({{0, -2},
                         {4, -2},
                         {4, -h},
                         {6, -h},
                         {6, -2},
                         {10, -2},
                         {10, 2},
                         {6, 2},
                         {6, h},
                         {4, h},
                         {4, 2},
                         {0, 2}})};
}

std::vector<double> even(double length, std::size_t count) {
  std::vector<double> at(count + 1);
  for (std::size_t i = 0; i <= count; ++i)
    at[i] = length * static_cast<double>(i) / static_cast<double>(count);
  return at;
}

TEST(WidthsAlong, OfAWedgeAreLinear) {
  const double half = 10 * pi / 180;
  const auto [shape, axis] =
      computed(test::triangle({0, 0}, {10, -10 * std::tan(half)}, {10, 10 * std::tan(half)}));
  const auto paths = main_paths(axis);
  ASSERT_EQ(paths.size(), 1U);
  for (const LocalWidth& width : widths_along(axis, paths[0], even(paths[0].length, 50))) {
    const double x = width.disk.center.x;
    EXPECT_NEAR(width.width(), 2 * x * std::sin(half), 1e-12);
    EXPECT_NEAR(width.span(), 2 * x * std::sin(half) * std::cos(half), 1e-12);
    EXPECT_NEAR(width.disk.center.y, 0, 1e-12);
  }
}

TEST(WidthsAlong, HaveFeetOnBothSides) {
  for (std::uint64_t seed = 0; seed < test::shape_count(200, 24); ++seed) {
    const RandomShape random = random_any(seed);
    const auto [shape, axis] = computed(random.rings);
    const double size = diagonal(bounding_box(shape));
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    for (const AxisPath& path : main_paths(axis)) {
      const auto widths = widths_along(axis, path, even(path.length, 20));
      ASSERT_EQ(widths.size(), 21U);
      for (std::size_t i = 0; i < widths.size(); ++i) {
        for (const Vec2 q : widths[i].feet)
          EXPECT_NEAR(distance(q, widths[i].disk.center), widths[i].disk.radius, 1e-9 * size);
        if (i == 0) continue;
        EXPECT_LE(distance(widths[i].disk.center, widths[i - 1].disk.center),
                  path.length / 20 + 1e-9 * size);
      }
    }
  }
}

TEST(Necks, OfABottleIsItsNeck) {
  for (const double width : {0.1, 1.0, 2.0}) {
    const auto [shape, axis] = computed(bottle(width));
    const auto found = necks(axis);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].width.width(), width, 1e-12);
    EXPECT_NEAR(found[0].width.span(), width, 1e-12);
    EXPECT_NEAR(found[0].width.disk.center.x, 5, 1e-12);
    EXPECT_GE(found[0].opens_to, 2 - 1e-12);
  }
}

/// Straight edges without sites between disks on a line; `side` is joined to the disk `at`.
MedialAxis chain_of(std::vector<Disk> disks, std::size_t at, const Disk& side) {
  MedialAxis axis;
  axis.tolerance = 1e-12;
  disks.push_back(side);
  for (const Disk& disk : disks) axis.nodes.push_back({disk, 0, NodeKind::branching});
  for (std::uint32_t i = 0; i + 2 < disks.size(); ++i)
    axis.edges.push_back(straight_edge(axis, i, i + 1));
  const auto last = static_cast<std::uint32_t>(disks.size() - 1);
  axis.edges.push_back(straight_edge(axis, static_cast<std::uint32_t>(at), last));
  return axis;
}

TEST(Necks, OfParallelWallsAreInTheMiddleOfThem) {
  const std::vector<Disk> disks{{{0, 0}, 3}, {{4, 0}, 1},  {{5, 0}, 1},
                                {{8, 0}, 1}, {{10, 0}, 1}, {{14, 0}, 3}};
  const auto expect_in_any_order = [](MedialAxis axis, const std::vector<double>& places) {
    const auto less = [](const Edge& a, const Edge& b) { return a.node < b.node; };
    std::sort(axis.edges.begin(), axis.edges.end(), less);
    do {
      const auto found = necks(axis);
      ASSERT_EQ(found.size(), 1U);
      const double x = found[0].width.disk.center.x;
      EXPECT_TRUE(std::any_of(places.begin(), places.end(), [x](double at) {
        return std::abs(x - at) < 1e-12;
      })) << x;
    } while (std::next_permutation(axis.edges.begin(), axis.edges.end(), less));
  };
  // A side way that opens does not end the walls; one that is as narrow does.
  expect_in_any_order(chain_of(disks, 2, {{5, 2}, 1.5}), {7});
  expect_in_any_order(chain_of(disks, 2, {{5, 2}, 1}), {4.5, 7.5});
}

TEST(Necks, AreNoneInConvexShapes) {
  for (const Rings& rings :
       {test::rectangle(10, 3), test::regular_polygon(7), Rings{test::stadium({0, 0}, {5, 1}, 2)},
        test::triangle({0, 0}, {5, 0}, {1, 3})}) {
    EXPECT_TRUE(necks(computed(rings).axis, 1.0001).empty());
  }
}

TEST(Transects, LieAcrossTheCourse) {
  // Beside a neck the disks touch its corners only; the line runs straight through all the same.
  const auto [shape, axis] = computed(bottle(1));
  const AxisPath path = main_paths(axis)[0];
  const std::vector<double> at = even(path.length, 7);
  const auto found = transects_along(shape, axis, path, at);
  ASSERT_EQ(found.size(), at.size());
  std::size_t swung = 0;
  const auto by_feet = widths_along(axis, path, at);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vec2 center = found[i].disk.center;
    const double half = center.x > 4 && center.x < 6 ? 0.5 : 2;
    EXPECT_NEAR(found[i].span(), 2 * half, 1e-9);
    for (const Vec2 end : found[i].feet) EXPECT_NEAR(end.x, center.x, 1e-9);
    swung += std::fabs(by_feet[i].feet[0].x - center.x) > 0.1 ? 1 : 0;
  }
  EXPECT_GT(swung, 0U);
}

TEST(Transects, EndOnArcs) {
  const auto [shape, axis] = computed({test::circle({0, 0}, 5), test::circle({1, 0}, 2)});
  const AxisPath path = main_paths(axis)[0];
  for (const LocalWidth& at : transects_along(shape, axis, path, even(path.length, 20))) {
    const double outer = std::min(std::fabs(norm(at.feet[0]) - 5), std::fabs(norm(at.feet[1]) - 5));
    const double inner = std::min(std::fabs(distance(at.feet[0], {1, 0}) - 2),
                                  std::fabs(distance(at.feet[1], {1, 0}) - 2));
    EXPECT_LT(outer, 1e-9);
    EXPECT_LT(inner, 1e-9);
    EXPECT_GE(at.span(), at.disk.radius);
  }
}

TEST(Transects, EndOnArcsThatAreAllButStraight) {
  Rings rings = test::rectangle(10, 2);
  for (const double bulge : {1e-3, 1e-7, 1e-11, 1e-12}) {
    SCOPED_TRACE(bulge);
    rings[0].bulges = {bulge, 0, bulge, 0};
    const auto [shape, axis] = computed(rings);
    const AxisPath path = main_paths(axis)[0];
    for (const LocalWidth& at : transects_along(shape, axis, path, even(path.length, 5))) {
      const double x = at.disk.center.x, sagitta = 2 * bulge * x * (10 - x) / 10;  // of a parabola
      if (x < 2 || x > 8) continue;
      EXPECT_NEAR(at.span(), 2 + 2 * sagitta, 1e-10 + 3 * bulge * bulge);
    }
  }
}

TEST(Necks, AroundAHole) {
  // An eccentric circular hole: one widest and one narrowest place.
  const auto [shape, axis] = computed({test::circle({0, 0}, 5), test::circle({1, 0}, 2)});
  const auto found = necks(axis);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].width.width(), 2, 1e-9);
  EXPECT_NEAR(found[0].opens_to, 2, 1e-9);
  EXPECT_NEAR(found[0].width.disk.center.x, 4, 1e-9);
}

TEST(Necks, AreLocalMinima) {
  std::size_t count = 0;
  for (std::uint64_t seed = 0; seed < test::shape_count(100, 24); ++seed) {
    const RandomShape random = random_any(seed);
    const auto [shape, axis] = computed(random.rings);
    const Incidence incidence(axis);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    for (const Neck& neck : necks(axis, 1.01)) {
      const Edge& edge = axis.edges[neck.place.edge];
      const double r = neck.width.disk.radius, slack = 1e-9 * r + 8 * axis.tolerance;
      for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0})
        EXPECT_GE(disk_at(axis, edge, t).radius, r - slack);
      if (neck.place.t > 0 && neck.place.t < 1) {
        ++count;
        continue;
      }
      // In a node: it rises from there on two edges at least, or stays.
      const std::uint32_t node = edge.node[neck.place.t == 0 ? 0 : 1];
      int rising = 0;
      for (const std::uint32_t e : incidence.edges(node)) {
        const EdgePlace low = ops::narrowest_place(axis, e);
        rising += disk_at(axis, axis.edges[e], low.t).radius >= r - slack ? 1 : 0;
      }
      EXPECT_GE(rising, 2);
      ++count;
    }
  }
  EXPECT_GT(count, 0U);
}

TEST(MeanWidth, OfARectangle) {
  // a = 10 by b = 2: the middle strip has the width b, and each end's corner squares (of the two
  // diagonals) widths that grow evenly from the corner.
  const auto [shape, axis] = computed(test::rectangle(10, 2));
  const auto paths = main_paths(axis);
  const MeanWidth mean = mean_width(axis, paths[0]);
  EXPECT_NEAR(mean.length, 8, 1e-12);
  EXPECT_NEAR(mean.area, 20, 1e-11);
  EXPECT_NEAR(mean.by_length, 2, 1e-12);
  EXPECT_NEAR(mean.area_by_length, 2.5, 1e-12);
  // Four unit squares in the corners: each point belongs to the disk of its distance from the
  // nearer side along that side: the mean of 2 max(x, y) is 4 / 3. The ends' middles do not exist.
  EXPECT_NEAR(mean.by_area, (16 * 2 + 4 * 4.0 / 3) / 20, 1e-11);
}

TEST(MeanWidth, OfADiskAndAStadium) {
  const auto disk = computed({test::circle({1, 1}, 3)});
  const MeanWidth round = mean_width(disk.axis, {});
  EXPECT_NEAR(round.area, 9 * pi, 1e-10);
  EXPECT_NEAR(round.by_area, 6, 1e-11);
  const auto stadium = computed({test::stadium({0, 0}, {3, 4}, 1)});
  const MeanWidth mean = mean_width(stadium.axis, main_paths(stadium.axis)[0]);
  EXPECT_NEAR(mean.area, 10 + pi, 1e-11);
  EXPECT_NEAR(mean.by_area, 2, 1e-11);
  EXPECT_NEAR(mean.by_length, 2, 1e-11);
}

TEST(MeanWidth, KnowsTheArea) {
  for (std::uint64_t seed = 0; seed < test::shape_count(80, 24); ++seed) {
    const RandomShape random = random_any(seed);
    const auto [shape, axis] = computed(random.rings);
    const double expected = area(shape), size = diagonal(bounding_box(shape));
    const MeanWidth mean = mean_width(axis, {});
    EXPECT_NEAR(mean.area, expected, 1e-9 * expected + 1e-11 * size * size)
        << random.kind << " " << seed;
    const double deepest = deepest_disk(axis).radius;
    EXPECT_LE(mean.by_area, 2 * deepest * (1 + 1e-9));
  }
}

TEST(MeanWidth, AndNecksAreTheSameUnderSymmetries) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < test::shape_count(250, 24); ++seed) {
    const RandomShape random = test::random_shape(seed);
    if (!random.rigid) continue;
    const auto [shape, axis] = computed(random.rings);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const double expected = mean_width(axis, {}).by_area;
    const auto expected_necks = necks(axis, 1.5);
    const double smallest = expected_necks.empty() ? 0 : expected_necks[0].width.width();
    for (const test::Symmetry& symmetry : test::symmetries()) {
      const auto moved = computed(test::transformed(random.rings, symmetry));
      const double scale = symmetry.scale(), slack = 1000 * moved.axis.tolerance / scale;
      ASSERT_NEAR(mean_width(moved.axis, {}).by_area / scale, expected, 1e-6 * expected + slack)
          << symmetry.name;
      const auto found = necks(moved.axis, 1.5);
      ASSERT_EQ(found.empty(), expected_necks.empty()) << symmetry.name;
      if (!found.empty()) {
        ASSERT_NEAR(found[0].width.width() / scale, smallest, 1e-6 * expected + slack)
            << symmetry.name;
      }
      ++compared;
    }
  }
  EXPECT_GT(compared, 0U);
}

TEST(LargestDisjointDisks, OfASquare) {
  const auto [shape, axis] = computed(test::rectangle(2, 2));
  const auto disks = largest_disjoint_disks(shape, 9);
  ASSERT_EQ(disks.size(), 9U);
  EXPECT_NEAR(disks[0].radius, 1, 1e-12);
  const double corner = 3 - 2 * std::sqrt(2.0);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(disks[i].radius, corner, 1e-12);
  // Eight more touch a side and two disks: 1 / sqrt r = 1 + 1 / sqrt(corner), by Soddy's formula.
  const double root = 1 / (1 + 1 / std::sqrt(corner));
  for (std::size_t i = 5; i < 9; ++i) EXPECT_NEAR(disks[i].radius, root * root, 1e-11);
}

TEST(LargestDisjointDisks, OfThinStrips) {
  for (const double width : {1e-3, 1e-5, 1e-6, 1e-8}) {
    const std::vector<Ring> rings{{{{0, 0}, {10, 0}, {10, width}, {0, width}}}};
    const auto shape = build_shape(rings);
    ASSERT_TRUE(shape.ok());
    const auto disks = largest_disjoint_disks(*shape, 3);
    ASSERT_EQ(disks.size(), 3U);
    for (const Disk& disk : disks) EXPECT_NEAR(disk.radius, width / 2, 1e-9 * width);
  }
}

/// A triangle of some sixty spacings of its coordinates: the disks are right but for the rounding
/// of their centres.
TEST(LargestDisjointDisks, OfSmallShapesFarAway) {
  constexpr double far = 1e15;
  const std::vector<Vec2> corners{{0, 0}, {8, 0}, {3, 8}};
  std::vector<Vec2> moved;
  for (const Vec2 p : corners) moved.push_back(p + Vec2{far, far});
  const auto here = build_shape(Rings{{corners}});
  const auto there = build_shape(Rings{{moved}});
  ASSERT_TRUE(here.ok() && there.ok());
  const auto expected = largest_disjoint_disks(*here, 5), disks = largest_disjoint_disks(*there, 5);
  ASSERT_EQ(disks.size(), expected.size());
  for (std::size_t i = 0; i < disks.size(); ++i) {
    EXPECT_NEAR(disks[i].radius, expected[i].radius, 1e-12);
    EXPECT_LE(distance(disks[i].center - Vec2{far, far}, expected[i].center), 0.125);
  }
}

/// Walls of many short edges, nearly parallel: all of the ring between them is nearly as deep.
TEST(LargestDisjointDisks, OfRings) {
  for (const std::size_t n : {40U, 400U, 4000U}) {
    Rings rings = test::regular_polygon(n);
    rings.push_back(test::regular_polygon(n, 0.9)[0]);
    const auto [shape, axis] = computed(rings);
    const auto disks = largest_disjoint_disks(shape, 2);
    ASSERT_EQ(disks.size(), 2U);
    EXPECT_NEAR(disks[0].radius, deepest_disk(axis).radius, 1e-14) << n;
    EXPECT_LE(disks[1].radius, disks[0].radius);
  }
  const std::vector<Ring> annulus{{{{1, 0}, {-1, 0}}, RingRole::any, {1, 1}},
                                  {{{0.5, 0}, {-0.5, 0}}, RingRole::any, {1, 1}}};
  const auto shape = build_shape(annulus);
  ASSERT_TRUE(shape.ok());
  const auto disks = largest_disjoint_disks(*shape, 9);
  ASSERT_EQ(disks.size(), 9U);
  // A disk keeps the centres of others 39 of the 360 degrees away: five fit anyhow.
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(disks[i].radius, 0.25, 1e-14);
}

/// All disks between two circles are equally deep, and none touches a third edge.
TEST(LargestDisjointDisks, OfThousandsThatNearlyTie) {
  constexpr std::size_t n = 3000;
  const auto [shape, axis] =
      computed({test::regular_polygon(n, 2)[0], test::regular_polygon(n, 1)[0]});
  const auto disks = largest_disjoint_disks(shape, 1);
  ASSERT_EQ(disks.size(), 1U);
  EXPECT_NEAR(disks[0].radius, deepest_disk(axis).radius, 1e-14);
  EXPECT_NEAR(clearance(shape, disks[0].center), disks[0].radius, 1e-14);
}

TEST(LargestDisjointDisks, OfAnAnnulusAwayFromTheMiddle) {
  for (const double hole : {0.1, 0.5, 0.7, 0.999}) {
    const Shape shape =
        test::shape_of({test::circle({0.3, -0.2}, 1), test::circle({0.3, -0.2}, hole)});
    const auto disks = largest_disjoint_disks(shape, 2);
    ASSERT_EQ(disks.size(), 2U) << hole;
    for (const Disk& disk : disks) EXPECT_NEAR(disk.radius, (1 - hole) / 2, 1e-14) << hole;
  }
}

/// Where circles touch, the boundary turns back, and their centres are as near to the cusps as to
/// all other places.
TEST(LargestDisjointDisks, OfCirclesThatTouch) {
  for (const std::size_t n : {2U, 3U, 5U}) {
    Rings rings = test::rectangle(static_cast<double>(n), static_cast<double>(n));
    const Vec2 corner = rings[0].points[0];
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k)
        rings.push_back(test::circle(
            corner + Vec2{static_cast<double>(i) + 0.5, static_cast<double>(k) + 0.5}, 0.5));
    const auto disks = largest_disjoint_disks(test::shape_of(rings), n * n);
    ASSERT_EQ(disks.size(), n * n);
    // One between each four circles, then one at each side between two.
    const std::size_t inner = (n - 1) * (n - 1);
    for (std::size_t i = 0; i < inner; ++i)
      EXPECT_NEAR(disks[i].radius, (std::sqrt(2.0) - 1) / 2, 1e-14) << n;
    for (std::size_t i = inner; i < n * n; ++i) EXPECT_NEAR(disks[i].radius, 0.125, 1e-14) << n;
  }
}

/// The middle of an arc whose circle is 1e13 times as large as the shape.
TEST(LargestDisjointDisks, OfWallsThatAreAlmostStraight) {
  for (const double bulge : {1e-3, 1e-6, 1e-9, 1e-12}) {
    Rings rings = test::rectangle(10, 2);
    rings[0].bulges = {bulge, 0, 0.5 * bulge, 0};
    const auto disks = largest_disjoint_disks(test::shape_of(rings), 1);
    ASSERT_EQ(disks.size(), 1U);
    EXPECT_NEAR(disks[0].radius, 1 + 2.5 * bulge * 1.5, 1e-14) << bulge;
  }
}

/// The deepest disk of the axis, found without an axis, and that of all images.
TEST(LargestDisjointDisks, BeginWithTheDeepestOfTheAxis) {
  constexpr std::uint64_t first = 20261127500000;
  const std::uint64_t count = test::shape_count(20, 250);
  std::uint64_t images = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const RandomShape random = random_any(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const auto [shape, axis] = computed(random.rings);
    const double size = diagonal(bounding_box(shape));
    const auto disks = largest_disjoint_disks(shape, 1);
    ASSERT_EQ(disks.size(), 1U);
    EXPECT_NEAR(disks[0].radius, deepest_disk(axis).radius, 2e-14 * size);
    for (const test::Symmetry& symmetry : test::symmetries()) {
      const auto image = build_shape(test::transformed(random.rings, symmetry));
      if (!image.ok()) continue;  // rotated or shifted, rings that touch may cross
      const auto found = largest_disjoint_disks(*image, 1);
      ASSERT_EQ(found.size(), 1U) << symmetry.name;
      const double far = norm(image->points[0]);  // the precision that its coordinates lost
      EXPECT_NEAR(found[0].radius, symmetry.scale() * disks[0].radius,
                  2e-14 * symmetry.scale() * size + 0x1p-50 * far)
          << symmetry.name;
      ++images;
    }
  }
  EXPECT_GT(images, count * test::symmetries().size() * 9 / 10);
}

TEST(LargestDisjointDisks, AgreeWithADenseGrid) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < test::shape_count(1000, 24) + 4; ++seed) {
    const RandomShape random = random_any(seed);
    const auto [shape, axis] = computed(random.rings);
    if (shape.points.size() > 60) continue;
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const double size = diagonal(bounding_box(shape));
    const auto disks = largest_disjoint_disks(shape, 5, 1e-3 * size);
    constexpr int n = 60;
    const Box box = bounding_box(shape);
    std::vector<Vec2> grid;
    std::vector<double> room;
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        grid.push_back({box.low.x + (box.high.x - box.low.x) * i / n,
                        box.low.y + (box.high.y - box.low.y) * j / n});
        room.push_back(clearance(shape, grid.back()));
      }
    }
    for (const Disk& disk : disks) {
      EXPECT_NEAR(
          disk.radius,
          clearance(shape, disk.center) < disk.radius ? clearance(shape, disk.center) : disk.radius,
          1e-9 * size);
      const double best = *std::ranges::max_element(room);
      EXPECT_GE(disk.radius, best - 1e-9 * size);
      EXPECT_LE(disk.radius, best + size / n);  // a cell's diagonal
      for (std::size_t k = 0; k < grid.size(); ++k)
        room[k] = std::min(room[k], distance(grid[k], disk.center) - disk.radius);
      ++compared;
    }
    for (std::size_t i = 0; i < disks.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE(distance(disks[i].center, disks[j].center),
                  disks[i].radius + disks[j].radius - 1e-9 * size);
  }
  EXPECT_GT(compared, 0U);
}

/// What the largest disk leaves of a circle of many arcs is thinner than any square that holds much
/// of it.
TEST(LargestDisjointDisks, OfANearCircle) {
  constexpr int arcs = 60;
  test::Random random(7);
  Ring ring;
  for (int i = 0; i < arcs; ++i) {
    const double angle = 2 * std::numbers::pi * i / arcs, r = 1 + 1e-12 * random.between(-1, 1);
    ring.points.push_back({r * std::cos(angle), r * std::sin(angle)});
    ring.bulges.push_back(std::tan(0.5 * std::numbers::pi / arcs) *
                          (1 + 1e-10 * random.between(-1, 1)));
  }
  const auto shape = build_shape(std::vector<Ring>{ring});
  ASSERT_TRUE(shape) << to_string(shape.error());
  const std::vector<Disk> disks = largest_disjoint_disks(*shape, 3);
  ASSERT_EQ(disks.size(), 3);
  EXPECT_NEAR(disks[0].radius, 1, 1e-9);
  for (std::size_t i = 1; i < disks.size(); ++i) {
    EXPECT_GT(disks[i].radius, 0);
    EXPECT_LT(disks[i].radius, 1e-9);
    EXPECT_GE(distance(disks[i].center, disks[0].center), disks[0].radius);
  }
}

}  // namespace
}  // namespace medial
