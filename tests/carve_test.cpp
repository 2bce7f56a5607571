// Carving: closed forms, and the tool at work on random shapes: nowhere deeper than allowed, and
// nothing left that another place of the tool would take.
#include "medial/carve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "medial/compute.h"
#include "medial/query.h"
#include "support/cut.h"
#include "support/generate_arcs.h"

namespace medial {
namespace {

using test::RandomShape;

std::uint64_t shape_count() {
  const char* text = std::getenv("MEDIAL_PROPERTY_COUNT");
  return text && *text ? std::strtoull(text, nullptr, 10) / 50 : 300;
}

Shape shape_of(const test::Rings& rings) {
  auto shape = build_shape(rings);
  EXPECT_TRUE(shape.ok());
  return std::move(shape).value();
}

Carving carving_of(const Shape& shape, const CarveOptions& options) {
  const auto axis = compute(shape);
  EXPECT_TRUE(axis.ok());
  auto carving = carve(*axis, options);
  EXPECT_TRUE(carving.ok()) << to_string(carving.error());
  return std::move(carving).value();
}

TEST(Carve, ASquareIsAPyramid) {
  const Shape square = shape_of(test::rectangle(10, 10));
  const Carving carving = carving_of(square, {.angle = 90});
  EXPECT_NEAR(carving.deepest, 5, 1e-12);
  EXPECT_TRUE(std::isinf(carving.flat_from));
  ASSERT_EQ(carving.paths.size(), 2U);  // four branches, two trails
  const test::Cutter cutter{carving.tip_radius, carving.slope};
  for (const Vec2 p : {Vec2{5, 5}, Vec2{1, 5}, Vec2{2, 7}, Vec2{0.001, 0.001}})
    EXPECT_NEAR(cutter.depth_at(p, carving.paths), clearance(square, p), 1e-12);
  // The tool comes up to the corners.
  double highest = -10;
  for (const ToolPath& path : carving.paths)
    for (const ToolPoint& point : path.points) highest = std::max(highest, point.z);
  EXPECT_NEAR(highest, 0, 1e-12);
}

TEST(Carve, ANarrowerToolGoesDeeper) {
  const Shape square = shape_of(test::rectangle(10, 10));
  EXPECT_NEAR(carving_of(square, {.angle = 60}).deepest, 5 * std::sqrt(3), 1e-12);
  EXPECT_NEAR(carving_of(square, {.angle = 120}).deepest, 5 / std::sqrt(3), 1e-12);
}

TEST(Carve, DepthAndToolMakeFlatBottoms) {
  const Shape square = shape_of(test::rectangle(10, 10));
  const Carving by_depth = carving_of(square, {.angle = 90, .depth = 2});
  const Carving by_tool = carving_of(square, {.angle = 90, .tool = 4});
  for (const Carving& carving : {by_depth, by_tool}) {
    EXPECT_NEAR(carving.deepest, 2, 1e-12);
    EXPECT_NEAR(carving.flat_from, 2, 1e-12);
    EXPECT_EQ(std::count_if(carving.paths.begin(), carving.paths.end(),
                            [](const ToolPath& path) { return path.kind == ToolPathKind::wall; }),
              1);
    const test::Cutter cutter{carving.tip_radius, carving.slope};
    EXPECT_NEAR(cutter.depth_at({1, 5}, carving.paths), 1, 1e-12);
    EXPECT_NEAR(cutter.depth_at({5, 5}, carving.paths), 2, carving.step / carving.slope + 1e-12);
  }
}

TEST(Carve, AnEndMillClearsAPocket) {
  const Shape square = shape_of(test::rectangle(10, 10));
  const Carving carving = carving_of(square, {.angle = 0, .depth = 3, .tool = 2});
  EXPECT_NEAR(carving.deepest, 3, 0);
  EXPECT_EQ(carving.travel_length, 0);  // from pass to pass without lifting
  const test::Cutter cutter{carving.tip_radius, carving.slope};
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p{random.between(0.3, 9.7), random.between(0.3, 9.7)};
    EXPECT_EQ(cutter.depth_at(p, carving.paths), 3);
  }
  EXPECT_EQ(cutter.depth_at({0.05, 0.05}, carving.paths), 0);  // the corner is round
}

TEST(Carve, WaysBetweenPathsAreShort) {
  const Shape maze = shape_of(test::maze(2000));
  const Carving carving = carving_of(maze, {.angle = 90});
  EXPECT_LT(carving.travel_length, 0.7 * carving.travel_unordered);
  // As few paths as the graph's odd nodes allow.
  const auto axis = compute(maze);
  const Incidence incidence(*axis);
  std::size_t odd = 0;
  for (std::uint32_t n = 0; n < axis->nodes.size(); ++n) odd += incidence.degree(n) % 2;
  EXPECT_EQ(carving.paths.size(), odd / 2);
}

TEST(Carve, RefusesWhatNoToolIs) {
  const auto axis = compute(shape_of(test::rectangle(1, 1)));
  for (const CarveOptions& options :
       {CarveOptions{.angle = 180}, CarveOptions{.angle = -1}, CarveOptions{.angle = 0},
        CarveOptions{.angle = std::nan("")}, CarveOptions{.angle = 90, .depth = -1},
        CarveOptions{.angle = 90, .tool = 1, .tip = 1}, CarveOptions{.angle = 0, .tool = 1}})
    EXPECT_EQ(carve(*axis, options).error().code, ErrorCode::invalid_option);
  EXPECT_EQ(carve(MedialAxis{}, {}).error().code, ErrorCode::empty);
  EXPECT_EQ(carve(*axis, {.angle = 90, .depth = 1e-3, .step = 1e-9}).error().code,
            ErrorCode::too_large);
}

TEST(Carve, NeitherGougesNorLeavesAnything) {
  std::size_t probes = 0;
  for (std::uint64_t seed = 0; seed < shape_count(); ++seed) {
    const RandomShape random =
        seed % 2 == 0 ? test::random_shape(seed) : test::random_arc_shape(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const Shape shape = shape_of(random.rings);
    if (shape.points.size() > 150) continue;
    const Box box = bounding_box(shape);
    const double size = diagonal(box);
    const auto axis = compute(shape);
    ASSERT_TRUE(axis.ok());
    const double deepest = axis->nodes[deepest_node(*axis)].disk.radius;
    if (deepest < 1e-3 * size) continue;
    test::Random numbers(seed);
    CarveOptions options;
    options.angle = numbers.between(20, 150);
    options.chord = 1e-4 * deepest;
    switch (seed % 4) {
      case 0:  // a point, as deep as it goes
        break;
      case 1:  // a point and a flat bottom
        options.tool = 2 * deepest * numbers.between(0.2, 0.9);
        break;
      case 2:  // a flat tip and a flat bottom
        options.tool = 2 * deepest * numbers.between(0.4, 0.9);
        options.tip = options.tool * numbers.between(0.2, 0.6);
        break;
      case 3:  // an end mill
        options.angle = 0;
        options.tool = 2 * deepest * numbers.between(0.1, 0.9);
        options.depth = 0.3 * size;
        break;
    }
    const auto carving = carve(*axis, options);
    ASSERT_TRUE(carving.ok()) << to_string(carving.error());
    const test::Cutter cutter{carving->tip_radius, carving->slope};
    const double slope = carving->slope, tip = carving->tip_radius;
    const double limit = options.angle == 0
                             ? options.depth
                             : std::min(carving->deepest, (options.tool / 2 - tip) / slope +
                                                              (options.tool > 0 ? 0.0 : 1e300));
    // What may remain: see carve().
    const double left = slope > 0 ? (3 * options.chord + (tip > 0 ? 0 : carving->step)) / slope : 0;
    for (int i = 0; i < 60; ++i) {
      const Vec2 p{numbers.between(box.low.x, box.high.x), numbers.between(box.low.y, box.high.y)};
      const double room = clearance(shape, p);
      const double cut = cutter.depth_at(p, carving->paths);
      // Never outside; inside no deeper than a wall from the boundary.
      const double allowed = room <= 0 ? 0 : slope > 0 ? std::min(room / slope, limit) : limit;
      EXPECT_LE(cut, allowed + 1e-6 * deepest) << p.x << " " << p.y;
      if (room <= 0) continue;
      // Another place where the tool may be takes nothing more off.
      for (int k = 0; k < 4; ++k) {
        const double angle = numbers.between(0, 7), far = numbers.between(0, 1.2 * deepest);
        const Vec2 at = k == 0 ? p : p + far * Vec2{std::cos(angle), std::sin(angle)};
        const double there = clearance(shape, at);
        if (there < tip) continue;
        const double deep = slope > 0 ? std::min((there - tip) / slope, limit) : limit;
        const double more = cutter.depth_at(p, at, deep);
        if (slope == 0 && distance(p, at) > tip * (1 - 1e-9)) continue;
        EXPECT_GE(cut, more - left - 1e-9 * deepest) << p.x << " " << p.y;
        ++probes;
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(probes, 20 * shape_count());
}

}  // namespace
}  // namespace medial
