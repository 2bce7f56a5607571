// From axes back to shapes: exactly, after pruning, by tangents of samples, as pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "medial/compute.h"
#include "medial/prune.h"
#include "medial/query.h"
#include "medial/sides.h"
#include "medial/verify.h"
#include "ops/hull_outline.h"
#include "support/random_shapes.h"

namespace medial {
namespace {

const std::uint64_t shape_count = test::shape_count(40);

using test::RandomShape;

struct Case {
  std::string name;
  Shape shape;
  MedialAxis axis;
  double size = 0;
};

Case case_of(std::uint64_t seed) {
  const RandomShape random = test::random_any(seed);
  auto shape = build_shape(random.rings);
  EXPECT_TRUE(shape.ok());
  auto axis = compute(*shape);
  EXPECT_TRUE(axis.ok());
  const double size = diagonal(bounding_box(*shape));
  return {random.kind + " " + std::to_string(seed), std::move(*shape), std::move(*axis), size};
}

Case case_of(std::vector<Vec2> points) {
  const Ring ring{std::move(points)};
  auto shape = build_shape({&ring, 1});
  auto axis = compute(*shape);
  const double size = diagonal(bounding_box(*shape));
  return {"polygon", std::move(*shape), std::move(*axis), size};
}

std::vector<Vec2> sorted(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  return points;
}

TEST(Rebuild, TheAxisOfAShapeGivesItBack) {
  std::size_t same_points = 0, polygons = 0;
  for (std::uint64_t seed = 0; seed < shape_count; ++seed) {
    const Case one = case_of(seed);
    SCOPED_TRACE(one.name);
    RebuildReport report;
    const auto again = rebuild(one.axis, {}, &report);
    ASSERT_TRUE(again.ok()) << to_string(again.error());
    const ShapeDistance apart = shape_distance(*again, one.shape);
    ASSERT_LE(apart.hausdorff(), 1e-9 * one.size);
    ASSERT_NEAR(apart.area, apart.other_area, 1e-9 * one.size * one.size);
    ASSERT_EQ(again->component_count(), one.shape.component_count());
    ASSERT_EQ(again->hole_count(), one.shape.hole_count());
    if (!one.shape.bulges.empty()) continue;
    ++polygons;
    same_points += sorted(again->points) == sorted(one.shape.points) ? 1 : 0;
  }
  // The very same vertices; seldom one more, where a corner is blunter than rounding.
  EXPECT_GE(same_points, polygons - polygons / 50);
}

/// An arc whose joints are a hundredth of a degree off smooth: its disk is a leaf, and touches
/// neither of the neighbours where they begin. The arc comes back all the same.
TEST(Rebuild, AnArcBetweenBluntJointsComesBack) {
  const auto ring = [](double angle) {
    // A cap on a box: an arc of a quarter turn of radius 2 between arcs of radius 3 and 4.
    const auto leaving = [](Vec2 from, double direction, double radius, double turn) {
      const double chord = 2 * radius * std::sin(turn / 2);
      return from + chord * Vec2{std::cos(direction + turn / 2), std::sin(direction + turn / 2)};
    };
    const double right = std::numbers::pi / 2, small = right / 4;
    const Vec2 a{10, 5};
    const Vec2 b = leaving(a, right, 3, small);
    const Vec2 c = leaving(b, right + small + angle, 2, right);
    const Vec2 d = leaving(c, 2 * right + small + 2 * angle, 4, small);
    const auto bulge = [](double turn) { return std::tan(turn / 4); };
    return Ring{{{0, 0}, {10, 0}, a, b, c, d, {0, 6}},
                RingRole::any,
                {0, 0, bulge(small), bulge(right), bulge(small), 0, 0}};
  };
  for (const double angle : {-1e-5, -1e-7, 0.0, 1e-9, 1e-6, 1e-5, 1e-4, 1.7e-4, 1e-3}) {
    SCOPED_TRACE(angle);
    const Ring one = ring(angle);
    const auto shape = build_shape({&one, 1});
    ASSERT_TRUE(shape.ok()) << to_string(shape.error());
    const auto axis = compute(*shape);
    ASSERT_TRUE(axis.ok());
    const auto again = rebuild(*axis);
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(sorted(again->points), sorted(shape->points));
    EXPECT_LE(shape_distance(*again, *shape).hausdorff(), 1e-12);
  }
}

/// With a larger corner angle an axis has no branches to blunter joints, and ends before the arcs
/// between them: these come back by the same angle, and without it the union of the disks.
TEST(Rebuild, JointsAsBluntAsTheCornerAngleComeBack) {
  const double cap = std::tan(87.0 / 4 * std::numbers::pi / 180);  // of 90: the joints are blunt
  const Ring one{{{0, -1}, {4, -1}, {5, 0}, {4, 1}, {0, 1}, {-1, 0}},
                 RingRole::any,
                 {0, cap, cap, 0, cap, cap}};
  const auto shape = build_shape({&one, 1});
  ASSERT_TRUE(shape.ok());
  const auto axis = compute(*shape, {.corner_angle = 4});
  ASSERT_TRUE(axis.ok());
  ASSERT_EQ(axis->edges.size(), 1U);
  const auto again = rebuild(*axis, {.corner_angle = 4}), disks = rebuild(*axis);
  ASSERT_TRUE(again.ok() && disks.ok());
  EXPECT_EQ(sorted(again->points), sorted(shape->points));
  EXPECT_LE(shape_distance(*again, *shape).hausdorff(), 1e-12);
  EXPECT_GT(shape_distance(*disks, *shape).hausdorff(), 0.02);
}

/// A finger that pruning has cut short keeps its round end: no arc comes back that the disk there
/// does not touch all along.
TEST(Rebuild, AnArcThatWasCutOffDoesNotComeBack) {
  const Ring one{{{0, -1}, {4, -1}, {4, 1}, {0, 1}}, RingRole::any, {0, 1, 0, 0}};
  const auto shape = build_shape({&one, 1});
  ASSERT_TRUE(shape.ok());
  auto axis = compute(*shape);
  ASSERT_TRUE(axis.ok());
  const auto end = std::ranges::max_element(axis->nodes, {},
                                            [](const Node& node) { return node.disk.center.x; });
  ASSERT_NEAR(end->disk.center.x, 4, 1e-12);
  end->disk.center.x -= 0.02;
  for (Edge& edge : axis->edges)
    for (const std::size_t k : {0U, 1U})
      if (axis->nodes[edge.node[k]].disk.center == end->disk.center)
        edge.control.center = midpoint(end->disk.center, axis->nodes[edge.node[1 - k]].disk.center);
  const auto again = rebuild(*axis);
  ASSERT_TRUE(again.ok());
  EXPECT_NEAR(area(*again), 2 * 3.98 + std::numbers::pi / 2, 1e-9);
}

/// An edge as short as rounding keeps both its ends, and so the arc beside it its bulge.
TEST(Rebuild, EdgesAsShortAsRoundingComeBack) {
  const double hardly = 3e-13;
  const Ring one{
      {{0, 0}, {20, 0}, {20, hardly}, {10, 15}, {0, 12}}, RingRole::any, {0, 0, -0.25, 0, 0.3}};
  const auto shape = build_shape({&one, 1});
  ASSERT_TRUE(shape.ok()) << to_string(shape.error());
  const auto axis = compute(*shape);
  ASSERT_TRUE(axis.ok());
  const auto again = rebuild(*axis);
  ASSERT_TRUE(again.ok());
  ASSERT_EQ(sorted(again->points), sorted(shape->points));
  std::vector<double> bulges = shape->bulges, other = again->bulges;
  std::ranges::sort(bulges);
  std::ranges::sort(other);
  EXPECT_EQ(bulges, other);
}

/// What is left of a shape lies in it, has the same parts and holes, and is less for a larger
/// threshold; the disks of the pruned axis are as large in it as they were.
TEST(Rebuild, OfAPrunedAxisIsTheUnionOfItsDisks) {
  std::size_t smaller = 0;
  for (std::uint64_t seed = 0; seed < shape_count / 2; ++seed) {
    const Case one = case_of(seed);
    SCOPED_TRACE(one.name);
    const PruneMeasure measure = prune_measures()[seed / 2 % prune_measures().size()];
    SCOPED_TRACE(name_of(measure));
    const PruneOrder order(one.axis, measure);
    double before = area(one.shape);
    const double whole = before;
    for (const double factor : {0.5, 1.0, 4.0}) {
      const MedialAxis pruned = order.at(factor * default_threshold(measure));
      const auto shape = rebuild(pruned);
      ASSERT_TRUE(shape.ok()) << to_string(shape.error());
      EXPECT_EQ(shape->component_count(), one.shape.component_count());
      EXPECT_EQ(shape->hole_count(), one.shape.hole_count());
      const double now = area(*shape);
      EXPECT_LE(now, before + 1e-9 * whole);
      smaller += now < (1 - 1e-6) * before ? 1 : 0;
      before = now;
      for (std::size_t i = 0; i < shape->points.size(); i += 1 + shape->points.size() / 50)
        EXPECT_GE(clearance(one.shape, shape->points[i]), -1e-9 * one.size);
      for (std::size_t i = 0; i < pruned.nodes.size(); i += 1 + pruned.nodes.size() / 50) {
        const Disk& disk = pruned.nodes[i].disk;
        EXPECT_NEAR(clearance(*shape, disk.center), disk.radius, 1e-9 * one.size);
      }
    }
  }
  EXPECT_GT(smaller, shape_count / 8);
}

/// The measure `area` states the lost area.
TEST(Rebuild, OneEndCutOffLosesTheAreaThatItsMeasureTells) {
  // A house: one roof corner of 90 degrees.
  const Case one = case_of({{0, 0}, {4, 0}, {4, 4}, {2, 6}, {0, 4}});
  const PruneOrder order(one.axis, PruneMeasure::area);
  std::vector<double> values;
  for (std::uint32_t e = 0; e < one.axis.edges.size(); ++e) values.push_back(order.of_edge(e));
  const double threshold = 0.3 * *std::min_element(values.begin(), values.end());
  const MedialAxis pruned = order.at(threshold);
  const std::size_t cut = static_cast<std::size_t>(std::count_if(
      pruned.nodes.begin(), pruned.nodes.end(),
      [](const Node& node) { return node.kind == NodeKind::leaf && node.disk.radius > 0; }));
  const auto shape = rebuild(pruned);
  ASSERT_TRUE(shape.ok());
  EXPECT_EQ(cut, 5U);
  EXPECT_NEAR(area(*shape), 20 * (1 - static_cast<double>(cut) * threshold), 1e-9);
}

/// Ho and Dyer's rectangle (Fig. 9 of Volkmann and St. Clair): the ends of its four branches go up
/// to disks of one radius, whose arcs round the corners.
TEST(Rebuild, ARectangleGetsRoundCorners) {
  const Case one = case_of({{0, 0}, {8, 0}, {8, 4}, {0, 4}});
  const auto shape = rebuild(PruneOrder(one.axis, PruneMeasure::radius).at(0.5));
  ASSERT_TRUE(shape.ok()) << to_string(shape.error());
  EXPECT_NEAR(area(*shape), 32 - (4 - std::numbers::pi), 1e-9);
  EXPECT_EQ(std::ranges::count_if(shape->bulges, [](double bulge) { return bulge != 0; }), 4);
}

TEST(Rebuild, OneDiskIsACircle) {
  const Case one = case_of({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  const auto shape = rebuild(PruneOrder(one.axis, PruneMeasure::erosion).at(1e6));
  ASSERT_TRUE(shape.ok());
  EXPECT_NEAR(area(*shape), std::numbers::pi, 1e-12);
  EXPECT_FALSE(rebuild(MedialAxis{}).ok());
}

TEST(Rebuild, PolygonsStayWithinTheChord) {
  const Case one = case_of({{0, 0}, {6, 0}, {6, 2}, {0, 2}});
  const MedialAxis pruned = PruneOrder(one.axis, PruneMeasure::angle).at(100);
  const auto exact = rebuild(pruned);
  const auto polygon = rebuild(pruned, {.chord = 1e-3});
  ASSERT_TRUE(exact.ok() && polygon.ok());
  EXPECT_FALSE(exact->bulges.empty());
  EXPECT_NEAR(area(*exact), 8 + std::numbers::pi, 1e-12);
  EXPECT_TRUE(polygon->bulges.empty());
  const double apart = shape_distance(*exact, *polygon, 200).hausdorff();
  EXPECT_LE(apart, 1.0001e-3);
  EXPECT_GE(apart, 0.3e-3);
}

/// Section II.C: the more points, the nearer.
TEST(Rebuild, TangentsOfMorePointsComeNearer) {
  const Case one =
      case_of({{0, 0}, {9, 0}, {9, 3}, {6, 3}, {6, 7}, {4, 7}, {4, 3}, {2, 4}, {0, 3}});
  double before = one.size;
  for (const std::uint64_t points : {50U, 200U, 800U, 3200U}) {
    RebuildReport report;
    const auto shape = rebuild(one.axis, {.by = RebuildBy::tangents, .points = points}, &report);
    ASSERT_TRUE(shape.ok());
    EXPECT_NEAR(static_cast<double>(report.medial_points), static_cast<double>(points),
                20 + 0.1 * static_cast<double>(points));
    const ShapeDistance apart = shape_distance(*shape, one.shape);
    EXPECT_LT(apart.hausdorff(), 0.6 * before);
    EXPECT_NEAR(apart.area, apart.other_area, 2 * apart.hausdorff() * one.size);
    before = apart.hausdorff();
  }
  EXPECT_LT(before, 2e-3 * one.size);
}

TEST(Rebuild, TangentsOfAnyShapeGiveOne) {
  for (std::uint64_t seed = 0; seed < shape_count / 4; ++seed) {
    const Case one = case_of(seed);
    SCOPED_TRACE(one.name);
    const auto shape = rebuild(one.axis, {.by = RebuildBy::tangents, .points = 200});
    EXPECT_TRUE(shape.ok()) << to_string(shape.error());
  }
}

/// A circle of arcs that rounding makes distinct: its axis is as long as rounding.
TEST(Rebuild, TangentsOfANearCircle) {
  for (const double off : {1e-13, 1e-11, 1e-9, 1e-6}) {
    SCOPED_TRACE(off);
    test::Random random(9);
    Ring ring;
    for (int i = 0; i < 24; ++i) {
      const double angle = i * std::numbers::pi / 12, r = 1 + off * random.between(-1, 1);
      ring.points.push_back({r * std::cos(angle), r * std::sin(angle)});
      ring.bulges.push_back(std::tan(std::numbers::pi / 48) * (1 + off * random.between(-1, 1)));
    }
    const auto shape = build_shape({&ring, 1});
    ASSERT_TRUE(shape.ok());
    const auto axis = compute(*shape);
    ASSERT_TRUE(axis.ok());
    for (const std::uint64_t points : {0U, 100U, 10000U}) {
      const auto again = rebuild(*axis, {.by = RebuildBy::tangents, .points = points});
      ASSERT_TRUE(again.ok()) << to_string(again.error());
      const ShapeDistance apart = shape_distance(*again, *shape);
      EXPECT_LE(apart.hausdorff(), 0.05);
    }
  }
}

/// The hull of two disks, and the effect of more disks.
TEST(Rebuild, HullsOfAFewDisks) {
  MedialAxis axis;
  axis.nodes = {{{{0, 0}, 2}}, {{{10, 0}, 1}}};
  const auto connect = [&](std::uint32_t a, std::uint32_t b) {
    const Disk &from = axis.nodes[a].disk, &to = axis.nodes[b].disk;
    axis.edges.push_back({{a, b},
                          {no_site, no_site},
                          {midpoint(from.center, to.center), (from.radius + to.radius) / 2}});
  };
  connect(0, 1);
  // Two disks around centres 10 apart: two trapezoids and two sectors.
  const double angle = std::acos(0.1), side = std::sqrt(99.0);
  const double hull = 3 * side + 4 * (std::numbers::pi - angle) + angle;
  const RebuildOptions hulls{.by = RebuildBy::hulls};
  const auto two = rebuild(axis, hulls);
  ASSERT_TRUE(two.ok()) << to_string(two.error());
  EXPECT_NEAR(area(*two), hull, 1e-3);
  // A disk within another adds nothing; a bar goes on 10 further, 2 wide.
  axis.nodes.push_back({{{0, 0.5}, 1}});
  connect(0, 2);
  axis.nodes.push_back({{{20, 0}, 1}});
  connect(1, 3);
  const auto three = rebuild(axis, hulls);
  ASSERT_TRUE(three.ok()) << to_string(three.error());
  EXPECT_NEAR(area(*three), hull + 20, 0.01);
  EXPECT_EQ(three->component_count(), 1U);
}

TEST(Rebuild, SampledAxesGivePolygons) {
  const Case one =
      case_of({{0, 0}, {9, 0}, {9, 3}, {6, 3}, {6, 7}, {4, 7}, {4, 3}, {2, 4}, {0, 3}});
  const auto axis = compute(one.shape, {.method = method::Potential{}});
  ASSERT_TRUE(axis.ok());
  const auto shape = rebuild(*axis);
  ASSERT_TRUE(shape.ok()) << to_string(shape.error());
  EXPECT_NEAR(area(*shape), area(one.shape), 0.02 * area(one.shape));
}

/// Pixels have directions of 45 degrees and radii off by half a pixel's diagonal: their tangents
/// miss by a share of the radius, the hulls of their disks by some pixels. (Those of brushfire end
/// far before corners do.)
TEST(Rebuild, RidgesComeWithinPixels) {
  const Case one = case_of(
      {{0, 0}, {90, 0}, {90, 30}, {60, 30}, {60, 70}, {40, 70}, {40, 30}, {20, 40}, {0, 30}});
  for (const double pixel : {0.5, 0.125}) {
    SCOPED_TRACE(pixel);
    const auto axis = compute(one.shape, {.method = method::Ridge{.grid = {.resolution = pixel}}});
    ASSERT_TRUE(axis.ok()) << to_string(axis.error());
    RebuildReport report;
    const auto shape = rebuild(*axis, {}, &report);
    ASSERT_TRUE(shape.ok()) << to_string(shape.error());
    EXPECT_LT(report.medial_points, axis->nodes.size() / 2);
    EXPECT_LE(shape_distance(*shape, one.shape).hausdorff(), 4 * pixel);
  }
}

TEST(Rebuild, AsPixels) {
  const Case one = case_of({{1, 1}, {9, 1}, {9, 4}, {4, 4}, {4, 6}, {1, 6}});
  const auto up = rebuild_image(one.axis, 400), down = rebuild_image(one.axis, 400, true);
  ASSERT_TRUE(up.ok() && down.ok());
  EXPECT_NEAR(up->placement[1], 0.02, 1e-12);
  EXPECT_EQ(up->image.width(), 402U);
  EXPECT_EQ(up->image.height(), 252U);
  const auto pixels = static_cast<double>(up->image.count());
  EXPECT_NEAR(pixels * up->placement[1] * up->placement[1], area(one.shape),
              0.005 * area(one.shape));
  EXPECT_TRUE(up->image.at(380, 240));  // the arm below is long: the last rows
  EXPECT_FALSE(up->image.at(380, 10));
  EXPECT_TRUE(down->image.at(380, 10));  // and the first ones where y points down
  EXPECT_FALSE(rebuild_image(one.axis, 0).ok());
  EXPECT_FALSE(rebuild_image(MedialAxis{}, 10).ok());
}

TEST(ShapeDistance, IsWhatItIsByHand) {
  const Case one = case_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  const Case other = case_of({{0, 0}, {4, 0}, {4, 5}, {0, 4}});
  const ShapeDistance apart = shape_distance(one.shape, other.shape);
  EXPECT_EQ(apart.area, 16);
  EXPECT_EQ(apart.other_area, 18);
  EXPECT_NEAR(apart.hausdorff(), 1, 1e-12);
  EXPECT_EQ(apart.worst.y, 5);
  EXPECT_EQ(shape_distance(one.shape, one.shape).hausdorff(), 0);
  EXPECT_EQ(shape_distance({}, {}).hausdorff(), 0);
  EXPECT_TRUE(std::isinf(shape_distance(one.shape, {}).hausdorff()));
}

/// Found by fuzzing: a damaged pack of 194 bytes, whose error is 1e-12 of its size, became outlines
/// of millions of points.
TEST(Rebuild, ATinyChordDoesNotMakeMillionsOfPoints) {
  MedialAxis axis;
  for (int i = 0; i < 50; ++i)
    axis.nodes.push_back({{{0.1 * i, 0}, 1 + 0.01 * i}, 0, NodeKind::leaf});
  std::size_t points = 0;
  for (const Ring& ring : ops::outline_of_hulls(axis, 1e-12)) points += ring.points.size();
  EXPECT_GT(points, std::size_t{1} << 17);
  EXPECT_LE(points, (std::size_t{1} << 18) + 3 * axis.nodes.size());
}

}  // namespace
}  // namespace medial
