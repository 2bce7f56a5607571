#include "medial/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <ostream>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "base/predicates.h"
#include "support/shape_check.h"
#include "support/wkt.h"

namespace medial {
namespace {

using test::expect_contract;
using test::loops_as_set;

std::vector<Ring> wkt(const char* text) { return test::rings_of_wkt(text).value(); }

/// Loose rings: the even-odd rule decides.
std::vector<Ring> loose(std::vector<Ring> rings) {
  for (Ring& ring : rings) ring.role = RingRole::any;
  return rings;
}

Shape built(std::span<const Ring> rings, ShapeReport* report = nullptr) {
  Result<Shape> shape = build_shape(rings, {}, report);
  EXPECT_TRUE(shape.ok()) << (shape ? "" : to_string(shape.error()));
  if (!shape) return {};
  expect_contract(rings, *shape);
  return std::move(shape).value();
}

void expect_error(std::span<const Ring> rings, ErrorCode code, std::optional<std::uint64_t> ring,
                  std::optional<std::uint64_t> vertex = {}, std::optional<Vec2> point = {}) {
  const Result<Shape> shape = build_shape(rings);
  ASSERT_FALSE(shape.ok());
  const Error& error = shape.error();
  EXPECT_EQ(error.code, code) << to_string(error);
  EXPECT_EQ(error.place.ring, ring) << to_string(error);
  if (vertex) {
    EXPECT_EQ(error.place.vertex, vertex) << to_string(error);
  }
  if (point) {
    EXPECT_EQ(error.place.point, point) << to_string(error);
  }
  EXPECT_FALSE(error.text.empty());
}

// ---------------------------------------------------------------------------------- cleaning

TEST(Cleaning, CountsWhatItMends) {
  ShapeReport report;
  // Closed; (0,0) and (4,4) repeated, also across the seam; (2,0), (3,0) and (0,2) on straight
  // runs.
  const std::vector<Ring> rings = {
      {{{0, 0}, {0, 0}, {2, 0}, {3, 0}, {4, 0}, {4, 4}, {4, 4}, {0, 4}, {0, 2}, {0, 0}, {0, 0}}},
      {{{1, 1}, {2, 1}, {1, 2}}}};
  const Shape shape = built(rings, &report);
  EXPECT_EQ(report.input_rings, 2U);
  EXPECT_EQ(report.input_points, 14U);
  EXPECT_EQ(report.closing_points, 1U);
  EXPECT_EQ(report.unclosed_rings, 1U);
  EXPECT_EQ(report.repeated_points, 3U);
  EXPECT_EQ(report.collinear_points, 3U);
  EXPECT_EQ(report.reversed_rings, 1U);
  EXPECT_EQ(report.touching_vertices, 0U);
  EXPECT_EQ(report.split_edges, 0U);
  ASSERT_EQ(shape.points.size(), 7U);
  EXPECT_EQ(shape.points[1], (Vec2{4, 0}));
  EXPECT_EQ(shape.sources[1].vertex, 4U);
  EXPECT_EQ(shape.sources[3].vertex, 7U);
}

TEST(Cleaning, DropsTheSeamOfAStraightRun) {
  ShapeReport report;
  const Shape shape =
      built(std::vector<Ring>{{{{2, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {2, 0}}}}, &report);
  EXPECT_EQ(report.collinear_points, 1U);
  EXPECT_EQ(shape.points, (std::vector<Vec2>{{4, 0}, {4, 4}, {0, 4}, {0, 0}}));
}

TEST(Cleaning, KeepsWhatIsNearlyStraight) {
  const double up = std::nextafter(1.0, 2.0);
  const Shape shape = built(std::vector<Ring>{{{{0, 1}, {1, 1}, {2, up}, {1, 3}}}});
  EXPECT_EQ(shape.points.size(), 4U);
}

TEST(Cleaning, RemovesNegativeZero) {
  const Shape shape = built(std::vector<Ring>{{{{-0.0, 0.0}, {1, -0.0}, {0.0, 1}, {0.0, -0.0}}}});
  ASSERT_EQ(shape.points.size(), 3U);
  for (const Vec2 point : shape.points) {
    EXPECT_FALSE(std::signbit(point.x) || std::signbit(point.y));
  }
}

// ---------------------------------------------------------------------------------- errors

TEST(Errors, Empty) { expect_error({}, ErrorCode::empty, {}); }

TEST(Errors, NotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    for (const Vec2 point : {Vec2{bad, 1}, Vec2{1, bad}}) {
      const std::vector<Ring> rings = {{{{0, 0}, {9, 0}, {0, 9}}}, {{{1, 1}, {2, 1}, point}}};
      expect_error(rings, ErrorCode::not_finite, 1, 2);
    }
  }
}

TEST(Errors, TooFewPoints) {
  const Ring good{{{0, 0}, {9, 0}, {0, 9}}};
  expect_error(std::vector<Ring>{good, {}}, ErrorCode::too_few_points, 1);
  expect_error(std::vector<Ring>{good, {{{1, 1}}}}, ErrorCode::too_few_points, 1, 0, Vec2{1, 1});
  expect_error(std::vector<Ring>{good, {{{1, 1}, {1, 1}, {1, 1}}}}, ErrorCode::too_few_points, 1, 0,
               Vec2{1, 1});
  expect_error(std::vector<Ring>{{{{1, 1}, {2, 2}, {1, 1}, {2, 2}, {1, 1}}}},
               ErrorCode::too_few_points, 0, 0, Vec2{1, 1});
}

TEST(Errors, NoArea) {
  const Ring good{{{0, 0}, {9, 0}, {0, 9}}};
  expect_error(std::vector<Ring>{good, {{{1, 1}, {2, 2}, {3, 3}}}}, ErrorCode::no_area, 1, 0,
               Vec2{1, 1});
  expect_error(std::vector<Ring>{{{{5, 1}, {5, 2}, {5, 9}, {5, 3}, {5, 1}}}}, ErrorCode::no_area, 0,
               0, Vec2{5, 1});
}

TEST(Errors, CrossingWithinARing) {
  expect_error(std::vector<Ring>{{{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}}, ErrorCode::crossing, 0, 0,
               Vec2{2, 2});
}

TEST(Errors, CrossingBetweenRings) {
  // Edge 1 of the square, (4,0)-(4,4), meets edges 0 and 2 of the triangle; the lower comes first.
  const std::vector<Ring> rings = {{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}}, {{{2, 1}, {6, 2}, {2, 3}}}};
  expect_error(rings, ErrorCode::crossing, 0, 1, Vec2{4, 1.5});
}

TEST(Errors, CrossingNamesTheVertexOfTheInput) {
  // Dropped vertices count: the crossing edge begins at vertex 3 of the input.
  expect_error(std::vector<Ring>{{{{0, 0}, {0, 0}, {2, 2}, {4, 4}, {4, 0}, {0, 4}}}},
               ErrorCode::crossing, 0, 0, Vec2{2, 2});
  expect_error(std::vector<Ring>{{{{0, 4}, {0, 4}, {0, 0}, {1, 1}, {4, 4}, {4, 0}}}},
               ErrorCode::crossing, 0, 2, Vec2{2, 2});
}

TEST(Errors, CrossingInAThirdVertex) {
  // Two edges cross exactly where another ring has a vertex.
  const std::vector<Ring> rings = {{{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}, {{{2, 2}, {3, 5}, {1, 5}}}};
  expect_error(rings, ErrorCode::crossing, 0, 0, Vec2{2, 2});
}

TEST(Errors, RingsWithRolesThatCrossInAVertex) {
  // The hole leaves its outer ring through the vertices (4,1) and (4,3).
  const auto rings = wkt("POLYGON ((0 0, 4 0, 4 1, 5 2, 4 3, 4 4, 0 4), (2 2, 4 1, 6 2, 4 3))");
  expect_error(rings, ErrorCode::crossing, 0, 2, Vec2{4, 1});
  const Shape shape = built(loose(rings));
  EXPECT_EQ(shape.component_count(), 2U);
}

TEST(Errors, Overlap) {
  const Ring square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
  expect_error(std::vector<Ring>{square, {{{4, 1}, {4, 2}, {6, 2}}}}, ErrorCode::overlap, 0, 1,
               Vec2{4, 1});
  expect_error(std::vector<Ring>{square, square}, ErrorCode::overlap, 0, 0, Vec2{0, 0});
  // A common edge, walked the other way.
  expect_error(std::vector<Ring>{square, {{{4, 0}, {4, 4}, {8, 4}, {8, 0}}}}, ErrorCode::overlap, 0,
               1, Vec2{4, 0});
  // A spike: forth and back.
  expect_error(std::vector<Ring>{{{{0, 0}, {4, 0}, {4, 4}, {4, 6}, {4, 4}, {0, 4}}}},
               ErrorCode::overlap, 0, 1, Vec2{4, 4});
  expect_error(std::vector<Ring>{{{{0, 0}, {4, 0}, {4, 4}, {9, 4}, {2, 4}, {0, 4}}}},
               ErrorCode::overlap, 0, 2, Vec2{4, 4});
}

TEST(Errors, HoleOutside) {
  expect_error(wkt("POLYGON ((0 0, 4 0, 4 4, 0 4), (6 1, 7 1, 7 2))"), ErrorCode::hole_outside, 1,
               0, Vec2{6, 1});
  // A hole in a hole.
  expect_error(wkt("POLYGON ((0 0, 9 0, 9 9, 0 9), (1 1, 8 1, 8 8, 1 8), (3 3, 4 3, 4 4))"),
               ErrorCode::hole_outside, 2, 0, Vec2{3, 3});
  // Touching from outside.
  expect_error(wkt("POLYGON ((0 0, 4 0, 4 4, 0 4), (4 4, 5 4, 5 5))"), ErrorCode::hole_outside, 1);
}

TEST(Errors, NestedOuter) {
  expect_error(wkt("MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4)), ((1 1, 2 1, 2 2)))"),
               ErrorCode::nested_outer, 1, 0, Vec2{1, 1});
  expect_error(wkt("MULTIPOLYGON (((0 2, 1 1, 2 2)), ((0 0, 4 0, 4 4, 0 4)))"),
               ErrorCode::nested_outer, 0, 0, Vec2{0, 2});
}

TEST(Errors, SentenceNamesThePlace) {
  Error error;
  error.code = ErrorCode::crossing;
  error.text = "two edges cross";
  EXPECT_EQ(to_string(error), "two edges cross [crossing]");
  error.place.file = "a.wkt";
  error.place.feature = 3;
  error.place.ring = 1;
  error.place.vertex = 7;
  error.place.point = Vec2{0.1, -2};
  EXPECT_EQ(to_string(error),
            "a.wkt: feature 3, ring 1, vertex 7 at (0.1, -2): two edges cross [crossing]");
  EXPECT_STREQ(name_of(ErrorCode::hole_outside), "hole_outside");
}

// ---------------------------------------------------------------------------------- nesting

TEST(Nesting, IslandsInLakesInIslands) {
  std::vector<Ring> rings;
  for (int k = 0; k < 7; ++k) {
    const double r = 10 - k;
    rings.push_back({{{-r, -r}, {r, -r}, {r, r}, {-r, r}, {-r, -r}}});
  }
  const Shape shape = built(rings);
  EXPECT_EQ(shape.component_count(), 4U);
  EXPECT_EQ(shape.hole_count(), 3U);
  EXPECT_DOUBLE_EQ(area(shape), 4 * (100 - 81 + 64 - 49 + 36 - 25 + 16));
  EXPECT_EQ(shape.component, (std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2, 3}));
  EXPECT_EQ(shape.hole, (std::vector<bool>{false, true, false, true, false, true, false}));

  for (std::size_t k = 0; k < rings.size(); ++k)
    rings[k].role = k % 2 ? RingRole::hole : RingRole::outer;
  EXPECT_EQ(built(rings).component_count(), 4U);
}

TEST(Nesting, HolesBelowHolesFindTheirOuterRing) {
  // Each of 10 x 10 holes hangs above another one; two outer rings side by side.
  std::vector<Ring> rings;
  for (int side = 0; side < 2; ++side) {
    const double x0 = 100 * side;
    for (int i = 0; i < 10; ++i) {
      for (int j = 0; j < 10; ++j) {
        const double x = x0 + 4 * i + 1;
        const double y = 4 * j + 1;
        rings.push_back({{{x, y}, {x + 2, y}, {x + 2, y + 2}, {x, y + 2}}});
      }
    }
    rings.push_back({{{x0, 0}, {x0 + 50, 0}, {x0 + 50, 50}, {x0, 50}}});
  }
  const Shape shape = built(rings);
  EXPECT_EQ(shape.component_count(), 2U);
  EXPECT_EQ(shape.hole_count(), 200U);
  EXPECT_EQ(std::count(shape.component.begin(), shape.component.end(), 0U), 101);
  EXPECT_DOUBLE_EQ(area(shape), 2 * (2500 - 400));
}

// ---------------------------------------------------------------------------------- touching

struct TouchCase {
  const char* name;
  const char* text;
  std::size_t components;
  std::size_t holes;
  double area;
  std::uint64_t touches;
  std::uint64_t splits;
};
void PrintTo(const TouchCase& touch_case, std::ostream* out) { *out << touch_case.text; }

class Touching : public testing::TestWithParam<TouchCase> {};

TEST_P(Touching, IsSpliced) {
  const TouchCase& expected = GetParam();
  ShapeReport report;
  const Shape shape = built(wkt(expected.text), &report);
  EXPECT_EQ(shape.component_count(), expected.components);
  EXPECT_EQ(shape.hole_count(), expected.holes);
  EXPECT_DOUBLE_EQ(area(shape), expected.area);
  EXPECT_EQ(report.touching_vertices, expected.touches);
  EXPECT_EQ(report.split_edges, expected.splits);
}

INSTANTIATE_TEST_SUITE_P(
    Cases, Touching,
    testing::Values(
        TouchCase{"HoleVertexOuterVertex", "POLYGON ((0 0, 4 0, 4 4, 0 4), (0 0, 2 1, 1 2))", 1, 0,
                  14.5, 1, 0},
        TouchCase{"HoleVertexOuterEdge", "POLYGON ((0 0, 4 0, 4 4, 0 4), (0 2, 1 1, 1 3))", 1, 0,
                  15, 1, 1},
        TouchCase{"OuterVertexHoleEdge",
                  "POLYGON ((0 0, 4 0, 2 2, 4 4, 0 4), (2 1, 2 3, 1 3, 1 1))", 1, 0, 10, 1, 1},
        TouchCase{"TwoHolesInAVertex",
                  "POLYGON ((0 0, 9 0, 9 9, 0 9), (2 4, 4 4, 4 6), (4 4, 6 4, 6 2))", 1, 1, 77, 1,
                  0},
        TouchCase{"HoleVertexHoleEdge",
                  "POLYGON ((0 0, 9 0, 9 9, 0 9), (2 2, 4 2, 4 6, 2 6), (4 4, 6 4, 6 2))", 1, 1, 71,
                  1, 1},
        TouchCase{"HoleCutsOuterInTwo", "POLYGON ((0 0, 4 0, 4 4, 0 4), (0 2, 2 1, 4 2, 2 3))", 2,
                  0, 12, 2, 2},
        TouchCase{"HoleRingEnclosesAnIsland",
                  "POLYGON ((0 0, 9 0, 9 9, 0 9), (2 2, 4 4, 2 6, 1 4), (2 2, 7 4, 2 6, 6 4))", 2,
                  1, 81 - 6 - 2, 2, 0},
        TouchCase{"OutersInAVertex", "MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4)), ((4 4, 5 4, 5 5)))", 2,
                  0, 16.5, 1, 0},
        TouchCase{"OuterVertexOuterEdge",
                  "MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4)), ((4 2, 5 1, 5 3)))", 2, 0, 17, 1, 1},
        TouchCase{"IslandTouchesItsLake",
                  "MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9), (1 1, 8 1, 8 8, 1 8)), ((1 4, 3 3, 3 5)))",
                  2, 1, 81 - 49 + 2, 1, 1},
        TouchCase{"FigureEight", "POLYGON ((0 0, 1 1, 2 0, 2 2, 1 1, 0 2))", 2, 0, 2, 1, 0},
        TouchCase{"FigureEightThatCrosses", "POLYGON ((0 0, 1 1, 2 3, 3 0, 1 1, 0 2))", 2, 0, 3.5,
                  1, 0},
        TouchCase{"RingTouchesItselfInside", "POLYGON ((0 0, 8 0, 8 8, 4 8, 2 4, 6 4, 4 8, 0 8))",
                  1, 0, 56, 1, 0},
        TouchCase{"RingVertexOnItsOwnEdge", "POLYGON ((0 0, 8 0, 8 8, 6 8, 4 0, 2 8, 0 8))", 2, 0,
                  48, 1, 1},
        TouchCase{
            "FourHolesInOneVertex",
            "POLYGON ((0 0, 8 0, 8 8, 0 8), (4 4, 3 1, 5 1), (4 4, 7 3, 7 5), (4 4, 5 7, 3 7), "
            "(4 4, 1 5, 1 3))",
            1, 1, 52, 1, 0}),
    [](const auto& named) { return named.param.name; });

TEST(Touching, LoopPassesTheCommonVertexOncePerWedge) {
  const Shape shape = built(wkt("POLYGON ((0 0, 4 0, 4 4, 0 4), (0 2, 1 1, 1 3))"));
  EXPECT_EQ(shape.points,
            (std::vector<Vec2>{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 2}, {1, 3}, {1, 1}, {0, 2}}));
}

// ---------------------------------------------------------------------------------- magnitudes

TEST(Magnitudes, ScaledAndShifted) {
  // Coordinates that stay exact when shifted by 1e12 (a multiple of 2^-12).
  const auto rings = wkt(
      "POLYGON ((0 0, 16 0, 16 16, 0 16), (0 4, 4 2, 4 6), (8 8, 12 8, 12 12), (8 8, 4 8, 4 12), "
      "(10 2, 12 2, 11 3))");
  const Shape plain = built(rings);
  EXPECT_EQ(plain.component_count(), 1U);
  EXPECT_EQ(plain.hole_count(), 2U);
  for (const Vec2 shift : {Vec2{0, 0}, Vec2{1e12, -3e12}, Vec2{-4.5e15, 4.5e15}}) {
    for (const int exponent : {-1000, -500, -30, 0, 40, 400, 900}) {
      if (shift != Vec2{0, 0} && exponent != 0) continue;
      std::vector<Ring> moved = rings;
      for (Ring& ring : moved) {
        for (Vec2& point : ring.points) {
          point = {std::ldexp(point.x, exponent) + shift.x,
                   std::ldexp(point.y, exponent) + shift.y};
        }
      }
      const Result<Shape> shape = build_shape(moved);
      ASSERT_TRUE(shape.ok()) << to_string(shape.error());
      EXPECT_EQ(shape->loop_begin, plain.loop_begin);
      EXPECT_EQ(shape->hole, plain.hole);
      if (exponent == 0) {
        EXPECT_DOUBLE_EQ(area(*shape), area(plain));
      }
    }
  }
}

TEST(Magnitudes, TinyAndHugeUnits) {
  for (const double unit : {1e-300, 1e-9, 0.1, 1e12, 1e300}) {
    std::vector<Ring> rings = wkt("POLYGON ((0 0, 9 0, 9 9, 0 9), (1 1, 2 7, 7 2))");
    for (Ring& ring : rings) {
      for (Vec2& point : ring.points) point = unit * point;
    }
    const Result<Shape> shape = build_shape(rings);
    ASSERT_TRUE(shape.ok()) << to_string(shape.error());
    EXPECT_EQ(shape->hole_count(), 1U);
    const Box box = bounding_box(*shape);
    EXPECT_EQ(box.high, (Vec2{9 * unit, 9 * unit}));
    EXPECT_NEAR(diagonal(box) / unit, 9 * std::sqrt(2.0), 1e-14);
    // The crossing of a bow tie, far beyond the precision of a product of doubles.
    const std::vector<Ring> bow = {{{{0, 0}, {4 * unit, 4 * unit}, {4 * unit, 0}, {0, 4 * unit}}}};
    const Result<Shape> crossed = build_shape(bow);
    ASSERT_FALSE(crossed.ok());
    EXPECT_EQ(crossed.error().code, ErrorCode::crossing);
    EXPECT_NEAR(crossed.error().place.point->x / unit, 2, 1e-15);
  }
}

TEST(Magnitudes, WholeRangeOfDoubles) {
  // Differences of coordinates overflow.
  constexpr double m = std::numeric_limits<double>::max();
  constexpr double s = std::numeric_limits<double>::denorm_min();
  const std::vector<Ring> rings = {{{{-m, -m}, {m, -m}, {m, m}, {-m, m}}},
                                   {{{-m, 0}, {-1, -m / 2}, {m / 2, 1}, {0, m / 2}}},
                                   {{{0, 0}, {s, 0}, {s, s}, {0, s}}}};
  ShapeReport report;
  const Result<Shape> shape = build_shape(rings, {}, &report);
  ASSERT_TRUE(shape.ok()) << to_string(shape.error());
  EXPECT_EQ(shape->component_count(), 2U);
  EXPECT_EQ(shape->hole_count(), 0U);
  EXPECT_EQ(report.split_edges, 1U);
}

// ---------------------------------------------------------------------------------- random input

/// The same region in another order: rings shuffled, turned, reversed, closed.
std::vector<Ring> shuffled(std::vector<Ring> rings, std::mt19937_64& random) {
  std::shuffle(rings.begin(), rings.end(), random);
  for (Ring& ring : rings) {
    const auto start = static_cast<std::ptrdiff_t>(random() % ring.points.size());
    std::rotate(ring.points.begin(), ring.points.begin() + start, ring.points.end());
    if (random() % 2) std::reverse(ring.points.begin(), ring.points.end());
    if (random() % 2) ring.points.push_back(ring.points.front());
  }
  return rings;
}

std::vector<std::pair<double, double>> coordinates(const Ring& ring) {
  std::vector<std::pair<double, double>> result;
  for (const Vec2 point : ring.points) result.emplace_back(point.x, point.y);
  return result;
}

TEST(Random, GridRingsAgainstBruteForce) {
  std::mt19937_64 random(3);
  int valid = 0;
  int touching = 0;
  for (int trial = 0; trial < 30000; ++trial) {
    const int grid = 3 + static_cast<int>(random() % 8);
    const auto coordinate = [&] {
      return static_cast<double>(random() % static_cast<unsigned>(grid + 1));
    };
    std::vector<Ring> rings(1 + random() % 4);
    for (Ring& ring : rings) {
      const std::size_t size = 3 + (random() % 4 ? 0 : random() % 5);
      for (std::size_t i = 0; i < size; ++i) ring.points.push_back({coordinate(), coordinate()});
    }
    ShapeReport report;
    const Result<Shape> shape = build_shape(rings, {}, &report);
    const test::Faults faults = test::brute_force_faults(rings);
    if (shape) {
      EXPECT_TRUE(faults.none()) << "trial " << trial;
      expect_contract(rings, *shape);
      EXPECT_NEAR(area(*shape), test::even_odd_area(rings), 1e-9) << "trial " << trial;
      EXPECT_EQ(shape->component_count(), test::interior_components(rings)) << "trial " << trial;
      const Result<Shape> again = build_shape(shuffled(rings, random));
      ASSERT_TRUE(again.ok()) << to_string(again.error());
      EXPECT_EQ(loops_as_set(*again), loops_as_set(*shape)) << "trial " << trial;
      ++valid;
      touching += report.touching_vertices > 0;
    } else {
      test::expect_fault_is_real(rings, faults, shape.error());
    }
    if (HasFailure()) {
      for (const Ring& ring : rings) {
        ADD_FAILURE() << "trial " << trial << ": " << testing::PrintToString(coordinates(ring));
      }
      return;
    }
  }
  EXPECT_GT(valid, 3000);
  EXPECT_GT(touching, 500);
}

TEST(Random, CellsThatTouchInCorners) {
  // The border of random cells of a sheared grid, traced with random turns where four edges meet.
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 3000; ++trial) {
    const int n = 2 + static_cast<int>(random() % 7);
    const test::Cells cells = test::random_cells(n, random);
    const std::vector<Ring> rings = test::border(cells, random);
    if (rings.empty()) continue;
    const Result<Shape> shape = build_shape(rings);
    ASSERT_TRUE(shape.ok()) << to_string(shape.error());
    const test::CellCounts counts = test::count(cells);
    EXPECT_EQ(shape->component_count(), counts.components) << "trial " << trial;
    EXPECT_EQ(shape->hole_count(), counts.holes) << "trial " << trial;
    EXPECT_DOUBLE_EQ(area(*shape), counts.area);
    expect_contract(rings, *shape);
    const Result<Shape> again = build_shape(shuffled(rings, random));
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(loops_as_set(*again), loops_as_set(*shape));
    if (HasFailure()) return;
  }
}

// ---------------------------------------------------------------------------------- order n log n

TEST(Adversarial, ManyEdgesOnTheSweepLine) {
  // A comb on its side: nearly all edges are active at once. Quadratic work would take minutes.
  Ring comb;
  constexpr int teeth = 200000;
  for (int i = 0; i < teeth; ++i) {
    comb.points.push_back({1.0 + 0.3 * (i % 3), 2.0 * i});
    comb.points.push_back({1000.0 + i % 7, 2.0 * i + 1});
  }
  comb.points.push_back({0, 2.0 * teeth});
  comb.points.push_back({0, -1});
  const std::vector<Ring> rings = {comb};
  const Result<Shape> shape = build_shape(rings);
  ASSERT_TRUE(shape.ok()) << to_string(shape.error());
  EXPECT_EQ(shape->loop_count(), 1U);
}

TEST(Adversarial, ManyVerticesOnOneEdge) {
  // One long edge, touched by all holes.
  std::vector<Ring> rings;
  constexpr int count = 50000;
  rings.push_back({{{-1, 0}, {4.0 * count, 0}, {4.0 * count, 9}, {-1, 9}}});
  for (int i = 0; i < count; ++i) rings.push_back({{{4.0 * i, 0}, {4.0 * i + 1, 1}, {4.0 * i, 2}}});
  ShapeReport report;
  const Result<Shape> shape = build_shape(rings, {}, &report);
  ASSERT_TRUE(shape.ok()) << to_string(shape.error());
  EXPECT_EQ(report.split_edges, static_cast<std::uint64_t>(count));
  EXPECT_EQ(shape->loop_count(), 1U);
  EXPECT_DOUBLE_EQ(area(*shape), 9 * (4.0 * count + 1) - count);
}

TEST(Adversarial, ManyEdgesInOneVertex) {
  // A fan of slim triangles around the origin.
  std::vector<Ring> rings;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const double y = 4.0 * i - 2.0 * count;
    rings.push_back({{{0, 0}, {1e5, y}, {1e5, y + 2}}, RingRole::outer});
  }
  ShapeReport report;
  const Result<Shape> shape = build_shape(rings, {}, &report);
  ASSERT_TRUE(shape.ok()) << to_string(shape.error());
  EXPECT_EQ(report.touching_vertices, 1U);
  EXPECT_EQ(shape->component_count(), static_cast<std::size_t>(count));
}

TEST(Adversarial, VerticalEdgesAndEqualX) {
  // A staircase of vertical slits: many vertices share each x.
  std::vector<Ring> rings;
  rings.push_back({{{-1, -1}, {301, -1}, {301, 1201}, {-1, 1201}}});
  for (int i = 0; i < 300; ++i) {
    for (int j = 0; j < 300; ++j) {
      const double x = i;
      const double y = 4.0 * j;
      rings.push_back({{{x, y}, {x + 0.5, y}, {x + 0.5, y + 3}, {x, y + 3}}});
    }
  }
  const Result<Shape> shape = build_shape(rings);
  ASSERT_TRUE(shape.ok()) << to_string(shape.error());
  EXPECT_EQ(shape->hole_count(), 90000U);
}

// ------------------------------------------------------------------------------ small polygons

/// The result for a ring if another ring, far away, requires the sweep.
Result<Shape> swept(const Ring& ring, ShapeReport& report) {
  const Ring far{{{1000, 1000}, {1001, 1000}, {1000, 1001}}};
  Result<Shape> shape = build_shape(std::vector<Ring>{ring, far}, {}, &report);
  if (!shape) return shape;
  const std::size_t size = shape->points.size() - 3;
  shape->points.resize(size);
  shape->sources.resize(size);
  shape->loop_begin.pop_back();
  shape->component.pop_back();
  shape->hole.pop_back();
  return shape;
}

TEST(SmallPolygons, AreWhatTheSweepMakesOfThem) {
  std::mt19937_64 random(3);
  int simple = 0, reversed = 0, refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    const int grid = i % 2 == 0 ? 5 : 1'000;  // many ties, and none
    const auto coordinate = [&] {
      return static_cast<double>(random() % static_cast<std::uint64_t>(grid));
    };
    Ring ring;
    ring.role = i % 3 == 0 ? RingRole::outer : RingRole::any;
    for (std::uint64_t k = 3 + random() % 6; k > 0; --k)
      ring.points.push_back({coordinate(), coordinate()});
    ShapeReport report, expected_report;
    const Result<Shape> shape = build_shape(std::span(&ring, 1), {}, &report);
    const Result<Shape> expected = swept(ring, expected_report);
    ASSERT_EQ(shape.ok(), expected.ok()) << i;
    EXPECT_EQ(report.reversed_rings, expected_report.reversed_rings) << i;
    EXPECT_EQ(report.touching_vertices, expected_report.touching_vertices) << i;
    if (!shape) {
      ++refused;
      EXPECT_EQ(to_string(shape.error()), to_string(expected.error())) << i;
      continue;
    }
    ++simple;
    reversed += report.reversed_rings > 0 ? 1 : 0;
    EXPECT_EQ(shape->points, expected->points) << i;
    EXPECT_EQ(shape->loop_begin, expected->loop_begin) << i;
    EXPECT_EQ(shape->component, expected->component) << i;
    EXPECT_EQ(shape->hole, expected->hole) << i;
    for (std::size_t v = 0; v < shape->sources.size(); ++v)
      EXPECT_EQ(shape->sources[v].vertex, expected->sources[v].vertex) << i;
  }
  EXPECT_GT(simple, 2'000);
  EXPECT_GT(reversed, 500);
  EXPECT_GT(refused, 2'000);
}

}  // namespace
}  // namespace medial
