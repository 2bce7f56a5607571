// Offset curves: closed forms, the distance of every point, topology by pixels, symmetries.
#include "medial/offset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/arc.h"
#include "medial/compute.h"
#include "medial/measure.h"
#include "medial/query.h"
#include "medial/verify.h"
#include "support/computed.h"
#include "support/offset_check.h"
#include "support/random_shapes.h"

namespace medial {
namespace {

const std::uint64_t offset_count = test::shape_count(33);

using std::numbers::pi;
using test::RandomShape;
using test::shape_of;

Offsets offsets_of(const test::Rings& rings, std::vector<double> clearances) {
  auto offsets = offset_curves(shape_of(rings), clearances);
  EXPECT_TRUE(offsets.ok());
  return std::move(offsets).value();
}

TEST(Offset, OfASquareInwards) {
  const Offsets offsets = offsets_of(test::rectangle(4, 4), {1});
  ASSERT_EQ(offsets.regions.size(), 1U);
  EXPECT_EQ(offsets.regions[0].rings.size(), 1U);
  EXPECT_EQ(offsets.regions[0].rings[0].points.size(), 4U);
  EXPECT_NEAR(area(offsets.regions[0]), 4, 1e-13);
  EXPECT_NEAR(length(offsets.regions[0]), 8, 1e-13);
  EXPECT_TRUE(offsets_of(test::rectangle(4, 4), {2}).regions.empty());
}

TEST(Offset, OfASquareOutwards) {
  for (const double d : {0.01, 1.0, 50.0}) {
    const Offsets offsets = offsets_of(test::rectangle(4, 3), {-d});
    ASSERT_EQ(offsets.regions.size(), 1U);
    EXPECT_EQ(offsets.regions[0].rings[0].points.size(), 8U);
    const double exact = 12 + 14 * d + pi * d * d;
    EXPECT_NEAR(area(offsets.regions[0]), exact, 1e-13 * exact);
    EXPECT_NEAR(length(offsets.regions[0]), 14 + 2 * pi * d, 1e-13 * (14 + 2 * pi * d));
  }
}

TEST(Offset, OfACircle) {
  const Offsets offsets = offsets_of({test::circle({3, 4}, 2)}, {-1, 0.5, 1.5});
  ASSERT_EQ(offsets.regions.size(), 3U);
  const double radii[] = {3, 1.5, 0.5};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(offsets.regions[i].rings.size(), 1U);
    EXPECT_NEAR(area(offsets.regions[i]), pi * radii[i] * radii[i], 1e-12);
    EXPECT_EQ(offsets.regions[i].parent, i == 0 ? no_region : i - 1);
  }
}

TEST(Offset, OfAStadium) {
  // Its axis does not cross small levels: the loop closes around both ends.
  const Offsets offsets = offsets_of({test::stadium({0, 0}, {5, 0}, 2)}, {-3, 0.5, 1.5, 1.9999});
  ASSERT_EQ(offsets.regions.size(), 4U);
  for (const OffsetRegion& region : offsets.regions) {
    const double r = 2 - region.clearance;
    EXPECT_NEAR(area(region), 10 * r + pi * r * r, 1e-12);
    EXPECT_NEAR(length(region), 10 + 2 * pi * r, 1e-12);
  }
}

TEST(Offset, OfARingClosesItsHoleOutwards) {
  test::Rings rings{test::circle({0, 0}, 5), test::circle({0, 0}, 2)};
  const Offsets offsets = offsets_of(rings, {-3, -1, 1});
  ASSERT_EQ(offsets.regions.size(), 3U);
  EXPECT_EQ(offsets.regions[0].rings.size(), 1U);
  EXPECT_NEAR(area(offsets.regions[0]), 64 * pi, 1e-12);
  EXPECT_EQ(offsets.regions[1].rings.size(), 2U);
  EXPECT_NEAR(area(offsets.regions[1]), (36 - 1) * pi, 1e-12);
  EXPECT_NEAR(area(offsets.regions[2]), (16 - 9) * pi, 1e-12);
}

TEST(Offset, DividesADumbbell) {
  // Two squares of side 4 and a corridor of width 1, which goes at 0.5.
  const test::Rings rings{test::ring_of({{0, 0},
                                         {4, 0},
                                         {4, 1.5},
                                         {6, 1.5},
                                         {6, 0},
                                         {10, 0},
                                         {10, 4},
                                         {6, 4},
                                         {6, 2.5},
                                         {4, 2.5},
                                         {4, 4},
                                         {0, 4}})};
  const Offsets offsets = offsets_of(rings, {0.4, 0.5, 1, 1.9});
  ASSERT_EQ(offsets.regions.size(), 7U);
  EXPECT_EQ(offsets.regions[0].clearance, 0.4);
  EXPECT_EQ(offsets.regions[1].parent, 0U);
  EXPECT_EQ(offsets.regions[2].parent, 0U);
  for (std::size_t i = 3; i < 7; ++i) {
    const OffsetRegion& region = offsets.regions[i];
    ASSERT_LT(region.parent, i);
    EXPECT_LT(offsets.regions[region.parent].clearance, region.clearance);
    // The same square.
    EXPECT_EQ(region.rings[0].points[0].x < 5,
              offsets.regions[region.parent].rings[0].points[0].x < 5);
  }
}

TEST(Offset, IslandsJoinOutwards) {
  test::Rings rings;
  for (int i = 0; i < 3; ++i) {
    const double x = 3 * i;
    rings.push_back(test::ring_of({{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}));
  }
  const Offsets offsets = offsets_of(rings, {0.25, -0.9, -1.1});
  ASSERT_EQ(offsets.regions.size(), 7U);
  EXPECT_EQ(offsets.regions[0].clearance, -1.1);
  EXPECT_EQ(offsets.regions[0].rings.size(), 1U);
  for (std::size_t i = 1; i <= 3; ++i) EXPECT_EQ(offsets.regions[i].parent, 0U);
  for (std::size_t i = 4; i <= 6; ++i) {
    EXPECT_EQ(offsets.regions[i].clearance, 0.25);
    const auto& parent = offsets.regions[offsets.regions[i].parent];
    EXPECT_EQ(parent.clearance, -0.9);
    EXPECT_NEAR(parent.rings[0].points[0].x, offsets.regions[i].rings[0].points[0].x, 2.5);
  }
}

TEST(Offset, OfAKeyholeWhoseCircleIsTwoArcs) {
  // The disk in the circle touches both arcs all along: no foot of it shows where they are left.
  for (int k = 0; k < 60; ++k) {
    const double angle = 0.1 * k + 1e-3;
    const auto at = [&](double x, double y) {
      return Vec2{2925, 3187} + turned({0.25 * x, 0.25 * y}, std::cos(angle), std::sin(angle));
    };
    const auto on_circle = [&](double degrees) {
      return at(std::cos(degrees * pi / 180), std::sin(degrees * pi / 180));
    };
    const double bulge = std::tan(140 * pi / 180 / 4);
    const Ring ring{{on_circle(50), at(0.65, 1.4), at(-0.65, 1.4), on_circle(130), on_circle(270)},
                    RingRole::any,
                    {0, 0, 0, bulge, bulge}};
    const Shape shape = shape_of({ring});
    const auto offsets = offset_curves(shape, std::vector{-0.1, 0.01, 0.05, 0.1, 0.2});
    ASSERT_TRUE(offsets.ok());
    const test::OffsetCheck check = test::check_offsets(shape, *offsets);
    EXPECT_LE(check.largest_error, 1e-11) << k;
    EXPECT_EQ(check.fault, "") << k;
  }
}

TEST(Offset, NextToTheCentreOfAKeyhole) {
  // The circle's arcs turn to the right by 2e-9 degrees from the necks' ends. Next to its centre
  // the offset is smaller than what that is across the circle.
  const Ring ring{
      {{13.600000000544958, -97.700000000328103},
       {13.600003305223645, -97.699995593938141},
       {12.800000001392149, -97.10000000080224},
       {13.599996695720634, -97.700004406608826}},
      RingRole::any,
      {-2.7539595942525136e-06, 0.99999449209598823, 0.99999449209598823, -2.7539595896312336e-06}};
  const Shape shape = shape_of({ring});
  for (const double corner_angle : {0.0, 0.01})
    for (int k = 3; k <= 12; ++k) {
      const double level = 0.49999999948853563 - std::pow(10, -k);
      const auto offsets = offset_curves(shape, std::vector{level}, {.corner_angle = corner_angle});
      ASSERT_TRUE(offsets.ok());
      EXPECT_EQ(offsets->regions.size(), 1U) << k;
      EXPECT_LE(test::check_offsets(shape, *offsets, 3, 0).largest_error, 1e-13) << k;
    }
}

TEST(Offset, BesideJointsOfHardlyAnyTurn) {
  // An offset of another one: pieces of 1e-8 turn by as much.
  const Ring drop{
      {{0.4679608671869086, 5.4594821445159685},
       {0.447738441072716, 6.195956630344697},
       {0.4477384376871827, 6.195956634325258},
       {0.4427043540136284, 6.201991107320444},
       {-0.4131910556691806, 6.233188721735832},
       {-0.4132082447318622, 6.2331717297045515},
       {-0.4132082710996582, 6.233171703640528},
       {-0.14904241266896592, 5.2465777654895085},
       {-0.14904236833226264, 5.24657775386728},
       {-0.14903794162759634, 5.246576593444291},
       {0.46792773062092685, 5.4594385600591915},
       {0.4679277430990472, 5.459438576473897}},
      RingRole::any,
      {0.35224254982866826, 2.2225925917172605e-09, -0.004766102339784699, 0.43231322321835086,
       -1.4658484122467337e-05, 0, 0.581098196940579, 1.949483733520392e-08, -2.775383673906396e-06,
       0.3030940410567038, 8.769893554438357e-09, -3.319225906334638e-05}};
  const Shape shape = shape_of({drop});
  const auto offsets = offset_curves(shape, std::vector{0.58777993704719234});
  ASSERT_TRUE(offsets.ok());
  EXPECT_EQ(offsets->regions.size(), 1U);
  EXPECT_LE(test::check_offsets(shape, *offsets, 3, 0).largest_error, 1e-13);
}

TEST(Offset, BelowTheTolerance) {
  // Coordinates are whole numbers there: the radius along an edge may be anywhere to a tolerance.
  const double far = 0x1p52;
  const auto at = [&](std::vector<Vec2> points) {
    for (Vec2& p : points) p = p + Vec2{far, far};
    return test::ring_of(points);
  };
  const Shape shape =
      shape_of({at({{3, 2}, {-3, 8}, {-8, 2}, {-7, -5}, {2, -3}}), at({{0, 3}, {-2, 0}, {1, -2}})});
  for (double level = 0.1; level < 1.5; level += 0.01) {
    const auto offsets = offset_curves(shape, std::vector{level});
    ASSERT_TRUE(offsets.ok());
    EXPECT_LE(test::check_offsets(shape, *offsets, 1, 0).largest_error, 2 * offsets->tolerance)
        << level;
  }
}

TEST(Offset, BesideJointsThatCountAsSmooth) {
  // Bulges a little off: arcs that were tangent meet at up to 0.009 degrees, convex or reflex.
  const auto check = [](test::Rings rings, test::Random& numbers) {
    for (Ring& ring : rings)
      for (double& bulge : ring.bulges) bulge *= 1 + 8e-5 * numbers.between(-1, 1);
    const auto shape = build_shape(rings);
    if (!shape) return false;
    const auto axis = compute(*shape);
    EXPECT_TRUE(axis.ok());
    const double deepest = deepest_disk(*axis).radius, size = diagonal(bounding_box(*shape));
    std::vector<double> levels;
    for (const double share : {-2.0, -0.3, 0.01, 0.3, 0.9, 0.9999, 0.9999999})
      levels.push_back(share * deepest);
    const auto offsets = offset_curves(*shape, levels);
    EXPECT_TRUE(offsets.ok());
    const test::OffsetCheck found = test::check_offsets(*shape, *offsets);
    EXPECT_LE(found.largest_error, 1e-12 * size) << found.worst.x << " " << found.worst.y;
    EXPECT_EQ(found.fault, "");
    return true;
  };
  std::size_t checked = 0;
  for (std::uint64_t seed = 0; seed < offset_count / 3; ++seed) {
    SCOPED_TRACE(seed);
    test::Random numbers(seed);
    const double angle = numbers.between(0, 6);
    // Nearly a circle, of arcs; a corridor around a corner; a slot; corners rounded; biarcs.
    test::Rings round{test::bulged_polygon(3, std::tan(pi / 6))};
    test::Rings slot{test::stadium({0, 0}, {std::cos(angle), std::sin(angle)}, 0.3)};
    test::Rings ell{test::rounded(test::l_shape(2)[0], 1)};
    checked += check(round, numbers);
    checked += check(slot, numbers);
    checked += check(ell, numbers);
    checked += check({test::rounded(test::star(numbers, 9), 0.1)}, numbers);
    checked += check({test::smooth_biarcs(numbers, 64, 4)}, numbers);
    if (HasFailure()) return;
  }
  EXPECT_GT(checked, offset_count);
}

TEST(Offset, PassesUntilNothingIsLeft) {
  const auto axis = compute(shape_of(test::rectangle(4, 3)));
  ASSERT_TRUE(axis.ok());
  const auto passes = offset_passes(*axis, 0.25, 0.5);
  ASSERT_TRUE(passes.ok());
  EXPECT_EQ(*passes, (std::vector<double>{0.25, 0.75, 1.25}));
  const auto offsets = inward_offsets(*axis, *passes);
  ASSERT_TRUE(offsets.ok());
  EXPECT_EQ(offsets->regions.size(), 3U);
  EXPECT_FALSE(offset_passes(*axis, 0, 1).ok());
  EXPECT_FALSE(offset_passes(*axis, 1, 0).ok());
  EXPECT_EQ(offset_passes(*axis, 1e-9, 1e-9).error().code, ErrorCode::too_large);
}

TEST(Offset, RefusesWhatItCannotDo) {
  const Shape square = shape_of(test::rectangle(1, 1));
  for (const double c : {0.0, std::nan(""), HUGE_VAL, -1e9})
    EXPECT_EQ(offset_curves(square, {&c, 1}).error().code, ErrorCode::invalid_option) << c;
  const double one = 1;
  EXPECT_EQ(offset_curves(Shape{}, {&one, 1}).error().code, ErrorCode::empty);
  Options sampled;
  sampled.method = method::Ridge{};
  EXPECT_EQ(offset_curves(square, {&one, 1}, sampled).error().code, ErrorCode::unsupported);
}

TEST(Offset, RefusesMoreThanItCanNumber) {
  // Four edges of the axis of each square cross all levels: 2^32 times and some.
  test::Rings squares;
  for (int i = 0; i < 1100; ++i) {
    const double x = 2 * i;
    squares.push_back(test::ring_of({{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}));
  }
  std::vector<double> levels;
  for (int k = 1; k <= 1'000'000; ++k) levels.push_back(4e-7 * k);
  EXPECT_EQ(offset_curves(shape_of(squares), levels).error().code, ErrorCode::too_large);
  for (double& level : levels) level = -level;
  EXPECT_EQ(offset_curves(shape_of(squares), levels).error().code, ErrorCode::too_large);
  levels.resize(2);
  EXPECT_EQ(offset_curves(shape_of(squares), levels)->regions.size(), 2200U);
}

/// Clearances inside and outside a shape: small ones, and some at which things happen.
std::vector<double> interesting(const MedialAxis& axis, double size, test::Random& random) {
  const double deepest = deepest_disk(axis).radius;
  std::vector<double> out{deepest * random.unit(), deepest * random.unit(), deepest * 0.999,
                          -size * random.unit(), -size * 0.01 * random.unit()};
  const auto node = random.integer(0, static_cast<std::int64_t>(axis.nodes.size()) - 1);
  out.push_back(axis.nodes[static_cast<std::size_t>(node)].disk.radius);  // exactly at a node
  std::erase_if(out, [&](double c) { return std::abs(c) < 1e-6 * size; });
  return out;
}

/// The least distance between neighbours on any of the rings.
double shortest_step(const Offsets& offsets) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const OffsetRegion& region : offsets.regions)
    for (const Ring& ring : region.rings)
      for (std::size_t i = 0; i < ring.points.size(); ++i)
        shortest =
            std::min(shortest, distance(ring.points[i], ring.points[(i + 1) % ring.points.size()]));
  return shortest;
}

TEST(Offset, EveryPointHasItsDistance) {
  std::size_t points = 0, regions = 0;
  for (std::uint64_t seed = 0; seed < offset_count; ++seed) {
    const RandomShape random = test::random_any(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const Shape shape = shape_of(random.rings);
    const double size = diagonal(bounding_box(shape));
    test::Random numbers(seed);
    const auto axis = compute(shape);
    ASSERT_TRUE(axis.ok());
    const auto clearances = interesting(*axis, size, numbers);
    const auto offsets = offset_curves(shape, clearances);
    ASSERT_TRUE(offsets.ok()) << to_string(offsets.error());
    const test::OffsetCheck check = test::check_offsets(shape, *offsets);
    EXPECT_LE(check.largest_error, 1e-9 * size) << check.worst.x << " " << check.worst.y;
    EXPECT_EQ(check.fault, "");
    EXPECT_GT(shortest_step(*offsets), 0x1p-53 * size);  // no steps of rounding
    points += check.points;
    regions += offsets->regions.size();
    if (HasFailure()) return;
  }
  EXPECT_GT(points, 20 * offset_count);
  EXPECT_GT(regions, offset_count);
}

TEST(Offset, OfARoundRoomWithDoors) {
  // The disk in the middle touches all walls between the doors, along all of them.
  for (const int doors : {2, 3, 4, 7}) {
    Ring ring;
    const double half = 0.1, distance = 0.075, wall = 2 * pi / doors - 2 * half;
    for (int i = 0; i < doors; ++i) {
      const auto at = [&](double radius, double angle) {
        const double turn = 2 * pi * i / doors + angle;
        return radius * Vec2{std::cos(turn), std::sin(turn)};
      };
      for (const Vec2 p : {at(1, -half), at(2, -half), at(2, half)}) {
        ring.points.push_back(p);
        ring.bulges.push_back(0);
      }
      ring.points.push_back(at(1, half));
      ring.bulges.push_back(std::tan(wall / 4));
    }
    const Shape shape = shape_of({ring});
    const auto offsets = offset_curves(shape, std::vector{distance});
    ASSERT_TRUE(offsets.ok());
    ASSERT_EQ(offsets->regions.size(), 1U) << doors;
    EXPECT_EQ(offsets->regions[0].rings.size(), 1U) << doors;
    EXPECT_EQ(test::check_offsets(shape, *offsets).fault, "") << doors;
    EXPECT_LE(test::check_offsets(shape, *offsets).largest_error, 1e-12) << doors;
  }
}

TEST(Offset, OfManyEdgesShorterThanTheTolerance) {
  constexpr std::size_t sides = 2000;
  constexpr double left = 1e-5;
  const double inradius = std::cos(pi / sides);
  const auto offsets = offset_curves(shape_of(test::regular_polygon(sides, 1)),
                                     std::vector{inradius - left}, {.tolerance = 1e-7});
  ASSERT_TRUE(offsets.ok());
  ASSERT_EQ(offsets->regions.size(), 1U);
  EXPECT_NEAR(length(offsets->regions[0]), 2 * pi * left, 1e-3 * left);
}

TEST(Offset, MovesWithTheShape) {
  // Rotation, scale, another start, the other direction: the same up to rounding.
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < offset_count / 5; ++seed) {
    const RandomShape random = test::random_any(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const Shape shape = shape_of(random.rings);
    const double size = diagonal(bounding_box(shape));
    test::Random numbers(seed);
    const auto axis = compute(shape);
    ASSERT_TRUE(axis.ok());
    const double deepest = deepest_disk(*axis).radius;
    if (deepest < 1e-3 * size) continue;
    const std::vector<double> levels{deepest * numbers.between(0.1, 0.9), -0.1 * size};
    const auto original = offset_curves(shape, levels);
    ASSERT_TRUE(original.ok());
    const double angle = numbers.between(0, 6), scale = numbers.power_of_ten(-2, 2);
    const double xx = scale * std::cos(angle), yx = scale * std::sin(angle);
    const test::Rings rings = test::transformed(
        random.rings,
        {.name = "", .xx = xx, .xy = -yx, .yx = yx, .yy = xx, .reverse = true, .restart = 1});
    const auto moved_shape = build_shape(rings);
    if (!moved_shape.ok()) continue;  // contacts that rounding has opened or crossed
    const auto moved =
        offset_curves(*moved_shape, std::vector{scale * levels[0], scale * levels[1]});
    ASSERT_TRUE(moved.ok()) << to_string(moved.error());
    const test::Measures a = test::measures_of(*original, 1), b = test::measures_of(*moved, scale);
    if (moved_shape->component_count() != shape.component_count()) continue;
    ASSERT_EQ(a.rings, b.rings);
    for (std::size_t i = 0; i < a.areas.size(); ++i) {
      EXPECT_NEAR(a.areas[i], b.areas[i], 1e-8 * size * size);
      EXPECT_NEAR(a.lengths[i], b.lengths[i], 1e-5 * (size + a.lengths[i]));
    }
    ++compared;
    if (HasFailure()) return;
  }
  EXPECT_GT(compared, offset_count / 12);
}

TEST(Offset, CountsRingsAsPixelsDo) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < std::min<std::uint64_t>(offset_count / 10, 60); ++seed) {
    const RandomShape random = test::random_any(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const Shape shape = shape_of(random.rings);
    const Box box = bounding_box(shape);
    const auto axis = compute(shape);
    ASSERT_TRUE(axis.ok());
    const double deepest = deepest_disk(*axis).radius;
    for (const double level : {0.3 * deepest, 0.7 * deepest, -0.5 * deepest}) {
      const std::size_t pixels = 150;
      const Vec2 extent = box.high - box.low;
      const double pixel = std::max(extent.x, extent.y) / static_cast<double>(pixels);
      if (!test::are_steady(shape, {&level, 1}, std::array{3 * pixel})[0]) continue;
      const auto offsets = offset_curves(shape, {&level, 1});
      ASSERT_TRUE(offsets.ok());
      const test::PixelCount count = test::count_by_pixels(shape, level, pixels);
      std::size_t rings = 0;
      for (const OffsetRegion& region : offsets->regions) rings += region.rings.size();
      EXPECT_EQ(offsets->regions.size(), count.regions) << level;
      EXPECT_EQ(rings, count.rings) << level;
      ++compared;
    }
  }
  EXPECT_GT(compared, std::min<std::uint64_t>(offset_count / 20, 30));
}

}  // namespace
}  // namespace medial
