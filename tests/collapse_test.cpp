// Partial collapse: closed forms, and properties that hold for random shapes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "medial/centreline.h"
#include "medial/compute.h"
#include "medial/measure.h"
#include "medial/query.h"
#include "support/computed.h"
#include "support/random_shapes.h"

namespace medial {
namespace {

using test::axis_of;
using test::RandomShape;
using test::Rings;

using std::numbers::pi;

CollapsedShape collapsed(const Rings& rings, double width) {
  auto result = collapse_narrow(axis_of(rings), width);
  EXPECT_TRUE(result.ok());
  return result.ok() ? std::move(result).value() : CollapsedShape{};
}

/// Two chambers of 4 x 4 with a neck between them, 2 long and 1 wide.
Rings bottle() {
  return {test::ring_of({{0, -2},
                         {4, -2},
                         {4, -0.5},
                         {6, -0.5},
                         {6, -2},
                         {10, -2},
                         {10, 2},
                         {6, 2},
                         {6, 0.5},
                         {4, 0.5},
                         {4, 2},
                         {0, 2}})};
}

TEST(Collapse, OfABottleKeepsTheChambers) {
  const CollapsedShape result = collapsed(bottle(), 2);
  EXPECT_EQ(result.polygons.component_count(), 2U);
  // Where the neck began, an arc of radius 1 over its width of 1.
  const double cap = 0.5 * (pi / 3 - std::sin(pi / 3));
  EXPECT_NEAR(area(result.polygons), 32 + 2 * cap, 1e-11);
  // The arcs around (4 - sqrt(3) / 2, 0) and its mirror image end at 5 - sqrt(3) / 2 and beyond.
  EXPECT_NEAR(total_length(result.lines), 2 - 2 * (1 - std::sqrt(0.75)), 1e-12);
  EXPECT_EQ(branches(result.lines).size(), 1U);
}

TEST(Collapse, KeepsWhatIsWide) {
  const CollapsedShape result = collapsed(bottle(), 0.9);
  EXPECT_EQ(result.polygons.component_count(), 1U);
  EXPECT_NEAR(area(result.polygons), 34, 1e-11);
  EXPECT_TRUE(result.lines.edges.empty());
}

TEST(Collapse, OfANarrowShapeIsItsLine) {
  const CollapsedShape result = collapsed(test::rectangle(10, 1), 2);
  EXPECT_TRUE(result.polygons.points.empty());
  EXPECT_NEAR(total_length(result.lines), 9, 1e-12);
  const CollapsedShape ring = collapsed({test::circle({0, 0}, 5), test::circle({0, 0}, 4)}, 2);
  EXPECT_TRUE(ring.polygons.points.empty());
  EXPECT_NEAR(total_length(ring.lines), 9 * pi, 1e-11);
}

TEST(Collapse, KeepsANetworkOfArms) {
  // A plus sign of arms 1 wide: all narrow; the corners at the ends go, the arms stay.
  const CollapsedShape result = collapsed({test::ring_of({{-5, -0.5},
                                                          {-0.5, -0.5},
                                                          {-0.5, -5},
                                                          {0.5, -5},
                                                          {0.5, -0.5},
                                                          {5, -0.5},
                                                          {5, 0.5},
                                                          {0.5, 0.5},
                                                          {0.5, 5},
                                                          {-0.5, 5},
                                                          {-0.5, 0.5},
                                                          {-5, 0.5}})},
                                          2);
  EXPECT_TRUE(result.polygons.points.empty());
  EXPECT_EQ(branches(result.lines).size(), 4U);
}

TEST(Collapse, RefusesNoWidth) {
  for (const double width : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_EQ(collapse_narrow(axis_of(bottle()), width).error().code, ErrorCode::invalid_option);
}

TEST(Collapse, OfRandomShapes) {
  std::size_t with_both = 0;
  for (std::uint64_t seed = 0; seed < test::shape_count(120, 24); ++seed) {
    const RandomShape random = test::random_any(seed);
    const auto shape = build_shape(random.rings);
    ASSERT_TRUE(shape.ok());
    const auto axis = compute(*shape);
    ASSERT_TRUE(axis.ok());
    if (axis->nodes.empty()) continue;
    const double size = diagonal(bounding_box(*shape));
    const double deepest = deepest_disk(*axis).radius;
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    for (const double share : {0.3, 0.8}) {
      const double radius = share * deepest;
      const auto result = collapse_narrow(*axis, 2 * radius);
      ASSERT_TRUE(result.ok()) << to_string(result.error());
      const double slack = 1e-7 * size;
      EXPECT_LE(area(result->polygons), area(*shape) + slack * size);
      with_both += result->lines.edges.empty() || result->polygons.points.empty() ? 0 : 1;
      // Every wide disk is in the polygons.
      for (std::size_t i = 0; i < axis->nodes.size(); i += 1 + axis->nodes.size() / 20) {
        const Disk& disk = axis->nodes[i].disk;
        if (disk.radius < radius) continue;
        EXPECT_GE(clearance(result->polygons, disk.center), disk.radius - slack);
      }
      // The polygons are in the shape.
      const std::size_t count = result->polygons.points.size();
      for (std::size_t i = 0; i < count; i += 1 + count / 20)
        EXPECT_GE(clearance(*shape, result->polygons.points[i]), -slack);
      // Lines are narrow.
      for (const Edge& edge : result->lines.edges)
        EXPECT_LE(disk_at(result->lines, edge, 0.5).radius, radius + slack);
    }
  }
  EXPECT_GT(with_both, 0U);
}

}  // namespace
}  // namespace medial
