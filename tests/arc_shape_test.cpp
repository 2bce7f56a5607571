#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/arc.h"
#include "base/compat.h"
#include "medial/medial.h"
#include "site/smooth_place.h"
#include "support/generate_arcs.h"
#include "support/generate_parts.h"
#include "support/nasty.h"
#include "support/wkt.h"

namespace medial {
namespace {

using test::bulged_polygon;
using test::circle;
using test::Rings;
using test::stadium;

using std::numbers::pi;

Ring with_role(Ring ring, RingRole role) {
  ring.role = role;
  return ring;
}

Ring reversed(const Ring& ring) {
  return test::transformed({ring}, {.name = "reversed", .reverse = true})[0];
}

Shape built(const Rings& rings, ShapeReport* report = nullptr) {
  Result<Shape> shape = build_shape(rings, {}, report);
  EXPECT_TRUE(shape.ok()) << (shape ? "" : to_string(shape.error()));
  return shape ? std::move(shape).value() : Shape{};
}

ErrorCode code_of(const Rings& rings) {
  const Result<Shape> shape = build_shape(rings);
  EXPECT_FALSE(shape.ok());
  return shape ? ErrorCode::internal : shape.error().code;
}

BulgeArc edge(const Ring& ring, std::size_t i) {
  const double bulge = i < ring.bulges.size() ? ring.bulges[i] : 0;
  return {ring.points[i], ring.points[(i + 1) % ring.points.size()], bulge};
}

/// Whether p lies between an arc of at most a half circle and its chord.
bool beside_chord(const BulgeArc& arc, Vec2 p) {
  if (arc.bulge == 0) return false;
  const double side = cross(arc.chord(), p - arc.start);
  if (side * arc.bulge >= 0) return false;
  const double b = arc.bulge;
  const double power = 2 * b * dot(p - arc.start, p - arc.end) + (b * b - 1) * side;
  return power * b < 0;  // in the disk
}

bool inside_even_odd(const Rings& rings, Vec2 p) {
  bool inside = false;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      const BulgeArc arc = edge(ring, i);
      const Vec2 a = arc.start;
      const Vec2 b = arc.end;
      if ((a.y > p.y) != (b.y > p.y)) {
        const double x = a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
        inside = inside != (x > p.x);
      }
      inside = inside != beside_chord(arc, p);
    }
  }
  return inside;
}

/// Checks the guarantees of build_shape(), and the even-odd rule next to each edge.
void expect_contract(const Rings& rings, const Shape& shape) {
  const double size = diagonal(bounding_box(shape));
  ASSERT_TRUE(shape.bulges.empty() || shape.bulges.size() == shape.points.size());
  ASSERT_EQ(shape.sources.size(), shape.points.size());
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const std::span<const Vec2> loop = shape.loop(i);
    const std::uint32_t begin = shape.loop_begin[i];
    ASSERT_GE(loop.size(), 2U);
    double doubled = 0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const BulgeArc arc{loop[k], loop[(k + 1) % loop.size()], shape.bulge(begin + k)};
      ASSERT_NE(arc.start, arc.end);
      EXPECT_LE(std::abs(arc.bulge), 1);
      doubled += cross(arc.start - loop[0], arc.end - loop[0]) + 2 * area_beside_chord(arc);
      const Vec2 tangent = (1 / norm(arc.chord())) * arc.chord();
      const double length = norm(arc.chord());
      if (length < 1e-6 * size) continue;
      for (const double side : {1.0, -1.0}) {
        const Vec2 p = apex(arc) + (side * 1e-11 * size) * left_of(tangent);
        EXPECT_EQ(inside_even_odd(rings, p), side > 0) << "loop " << i << ", edge " << k;
      }
    }
    EXPECT_EQ(doubled < 0, shape.hole[i]);
  }
}

// ---------------------------------------------------------------------------------- cleaning

/// Of three arcs of almost one circle the short one in the middle turns by less than the tolerance
/// against its own length, but not against that of the others: its normal would let disks reach
/// over the first one by 29 tolerances.
TEST(SmoothPlace, ShortArcBetweenLongOnes) {
  const double length = 27, round = 286669.41464779759, flat = 286669.41557465104, turn = 4.59e-11;
  const auto arc_of = [](Vec2 start, double direction, double chord, double radius) {
    const double half = std::asin(0.5 * chord / radius);
    const Vec2 along{std::cos(direction + half), std::sin(direction + half)};
    return site::make_arc(start, start + chord * along, std::tan(0.5 * half));
  };
  const site::Site first = arc_of({0, 0}, 0, 3423, flat);
  const double arriving = 2 * std::asin(0.5 * 3423 / flat);
  const site::Site second = arc_of(first.end(), arriving + turn, length, round);
  const site::SmoothPlace place = site::smooth_place(first, second);
  // A disk all but as round as the second one, on that normal.
  const double radius = round - 1e-6;
  const Disk disk{place.point + radius * place.normal, radius};
  const double over_first = radius - site::carrier_distance(first, disk.center);
  const double over_second = radius - std::sqrt(site::squared_distance(second, disk.center));
  const double rounding = 2 * std::nextafter(radius, 1e6) - 2 * radius;
  EXPECT_LE(std::max(over_first, over_second), turn * length + rounding);
}

TEST(ArcCleaning, FullCircleOfManyArcsBecomesTwoHalfCircles) {
  Ring ring;
  for (int i = 0; i < 12; ++i) {
    ring.points.push_back({3 * std::cos(i * pi / 6), 3 * std::sin(i * pi / 6)});
    ring.bulges.push_back(std::tan(pi / 24));
  }
  ShapeReport report;
  const Shape shape = built({ring}, &report);
  EXPECT_EQ(report.collinear_points, 10U);
  ASSERT_EQ(shape.points.size(), 2U);
  EXPECT_EQ(shape.bulges, (std::vector<double>{1, 1}));
  // The same two, whatever the start and the orientation.
  for (std::size_t start = 0; start < 12; ++start) {
    for (const bool backwards : {false, true}) {
      const Rings other =
          test::transformed({ring}, {.name = "", .reverse = backwards, .restart = start});
      const Shape same = built(other);
      ASSERT_EQ(same.points.size(), 2U);
      EXPECT_TRUE(
          std::is_permutation(same.points.begin(), same.points.end(), shape.points.begin()));
    }
  }
}

/// Of arcs within some roundings of one circle, what is kept does not depend on how they are
/// written.
TEST(ArcCleaning, WhatIsKeptIsTheSameInAllImages) {
  std::size_t kept = 0, written = 0;
  for (std::uint64_t seed = 20261127100000; seed < 20261127100200; ++seed) {
    test::Random random(seed);
    Ring ring = test::arcs_of_circle(static_cast<int>(random.integer(3, 40)));
    const double size = random.power_of_ten(-16, -13);
    for (Vec2& p : ring.points)
      p = p + Vec2{random.between(-size, size), random.between(-size, size)};
    for (double& bulge : ring.bulges) bulge *= 1 + random.between(-size, size);
    const Shape shape = built({ring});
    written += ring.points.size();
    kept += shape.points.size();
    for (const test::Symmetry& symmetry :
         {test::Symmetry{.name = "mirrored", .xx = -1},
          test::Symmetry{.name = "turned", .xx = 0, .xy = -1, .yx = 1, .yy = 0},
          test::Symmetry{.name = "backwards", .reverse = true},
          test::Symmetry{.name = "restarted", .restart = 2},
          test::Symmetry{.name = "all", .xx = 0, .xy = 2, .yx = 2, .yy = 0, .restart = 1}}) {
      std::vector<Vec2> points = shape.points;
      for (Vec2& p : points) p = symmetry(p);
      const Shape image = built(test::transformed({ring}, symmetry));
      ASSERT_EQ(image.points.size(), points.size()) << seed << ", " << symmetry.name;
      // Where vertices of a circle are as far out as each other, any of them will do.
      if (points.size() > 2) {
        EXPECT_TRUE(std::is_permutation(points.begin(), points.end(), image.points.begin()))
            << seed << ", " << symmetry.name;
      }
    }
  }
  EXPECT_LT(2 * kept, written);
}

/// A run of more than a half circle becomes two equal arcs, whichever vertices it has.
TEST(ArcCleaning, LongRunsBecomeTwoArcs) {
  Ring ring;
  const std::array<double, 4> angles{0, 100, 170, 270};
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double angle = angles[i] * pi / 180;
    ring.points.push_back({std::cos(angle), std::sin(angle)});
    ring.bulges.push_back(i < 3 ? std::tan((angles[i + 1] - angles[i]) * pi / 720) : 0);
  }
  ShapeReport report;
  const Shape shape = built({ring}, &report);
  EXPECT_EQ(report.collinear_points, 1U);
  ASSERT_EQ(shape.points.size(), 3U);
  EXPECT_EQ(shape.bulges[0], shape.bulges[1]);
  EXPECT_NEAR(shape.bulges[0], std::tan(135 * pi / 720), 1e-15);
  EXPECT_NEAR(distance(shape.points[1], {std::cos(0.75 * pi), std::sin(0.75 * pi)}), 0, 1e-15);
  EXPECT_EQ(shape.sources[1].vertex, 1U);
}

TEST(ArcCleaning, LongArcsAreSplit) {
  const double bulge = std::tan(3 * pi / 8);  // three quarters of a circle
  const Shape shape = built({{{{1, 0}, {0, -1}}, RingRole::any, {bulge, 0}}});
  ASSERT_EQ(shape.points.size(), 3U);
  EXPECT_NEAR(area(shape), 0.75 * pi + 0.5, 1e-15);
  EXPECT_EQ(shape.sources[1].vertex, 0U);
  const Box box = bounding_box(shape);
  EXPECT_NEAR(box.low.x, -1, 1e-15);
  EXPECT_NEAR(box.high.y, 1, 1e-15);
  EXPECT_NEAR(box.high.x, 1, 1e-15);
}

TEST(ArcCleaning, NearlyFullCircle) {
  const Shape shape = built({{{{0, 0}, {1e-3, 0}}, RingRole::any, {1e4, 0}}});
  const double radius = 1e-3 * (1 + 1e8) / 4e4;
  EXPECT_NEAR(area(shape) / (pi * radius * radius), 1, 1e-7);
}

TEST(ArcCleaning, BulgesBelowRoundingAreStraight) {
  const Shape shape = built({{{{0, 0}, {2, 0}, {1, 1}}, RingRole::any, {1e-17, 0, -1e-30}}});
  EXPECT_TRUE(shape.bulges.empty());
  EXPECT_EQ(area(shape), 1);
}

/// Their joint is no corner, though they meet at an angle; that of segments is taken as it is.
TEST(ArcCleaning, ArcsThatBecomeStraightAreOneSegment) {
  Ring ring{{{30, 0}, {31, 0}, {31 + 4e-6, -1e-14}, {31 + 1.2e-5, 0}, {33, 4}, {30, 4}},
            RingRole::any,
            {0.1, 5e-10, -5e-10, 0.1, 0, 0}};
  EXPECT_EQ(built({ring}).points.size(), 5U);
  ring.bulges = {0.1, 0, 5e-10, 0.1, 0, 0};
  EXPECT_EQ(built({ring}).points.size(), 5U);
  ring.bulges = {0.1, 0, 0, 0.1, 0, 0};
  EXPECT_EQ(built({ring}).points.size(), 6U);
  ring.bulges = {0.1, 5e-10, 5e-10, 0.1, 0, 0};
  ring.points[2].y = -1e-12;
  EXPECT_EQ(built({ring}).points.size(), 6U);
}

TEST(ArcCleaning, ZeroLengthEdgesAndStraightRunsBesideArcs) {
  ShapeReport report;
  const Rings rings = {{{{0, 0}, {1, 0}, {2, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}},
                        RingRole::any,
                        {0, 0, 0.7, 0.5, 0, 0, 9}}};
  const Shape shape = built(rings, &report);
  EXPECT_EQ(report.closing_points, 1U);
  EXPECT_EQ(report.repeated_points, 1U);
  EXPECT_EQ(report.collinear_points, 1U);
  EXPECT_EQ(shape.points, (std::vector<Vec2>{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  EXPECT_EQ(shape.bulges, (std::vector<double>{0, 0.5, 0, 0}));
}

TEST(ArcCleaning, Errors) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code_of({{{{0, 0}, {2, 0}, {1, 1}}, RingRole::any, {0, nan, 0}}}),
            ErrorCode::not_finite);
  EXPECT_EQ(code_of({{{{0, 0}, {20, 0}}, RingRole::any, {0, 1e308}}}), ErrorCode::not_finite);
  EXPECT_EQ(code_of({{{{0, 0}, {0, 0}}, RingRole::any, {1, 1}}}), ErrorCode::too_few_points);
  EXPECT_EQ(code_of({{{{0, 0}, {2, 0}}, RingRole::any, {0.5, -0.5}}}), ErrorCode::no_area);
}

// ---------------------------------------------------------------------------------- measures

TEST(ArcCleaning, VerticesThatDifferByLessThanTheSweepResolvesAreOne) {
  // As paths of relative coordinates end: one rounding beside their start.
  for (const double y : {0.481, 0.0625, 1e-3, 1e-9}) {
    const double beside = std::nextafter(y, 1.0);
    const Shape shape =
        built({{{{4.931, y}, {16, 1}, {9, 16}, {4.931, beside}}, RingRole::any, {0.2, 0.1, 0, 0}}});
    EXPECT_EQ(shape.points.size(), 3U) << y;
  }
}

TEST(ArcParts, TurnByNoMoreThanTheArc) {
  for (const double bulge : {1.0, -1.0, 0.4, -0.4}) {
    const BulgeArc arc{{0, 0}, {1, 0}, bulge};
    // Ends that lie beside the arc by rounding: all of it, and a part that leads backward.
    for (const Vec2 off : {Vec2{2e-13, 1e-13}, Vec2{-2e-13, 1e-13}, Vec2{-1e-13, -2e-13}}) {
      EXPECT_LE(std::abs(partial_bulge(arc, arc.start, arc.end + off)), std::abs(bulge));
      EXPECT_LE(std::abs(partial_bulge(arc, arc.start, arc.start + off)), 1e-12);
    }
    const Vec2 middle = apex(arc);
    EXPECT_NEAR(partial_bulge(arc, arc.start, middle), half_bulge(bulge), 1e-15);
    EXPECT_NEAR(partial_bulge(arc, middle, arc.end), half_bulge(bulge), 1e-15);
  }
}

TEST(ArcMeasures, AreaAndBox) {
  EXPECT_NEAR(area(built({circle({5, 7}, 2, 0.3)})), 4 * pi, 1e-14);
  EXPECT_NEAR(area(built({circle({0, 0}, 2), circle({0.5, 0.1}, 1, 1)})), 3 * pi, 1e-14);
  EXPECT_NEAR(area(built({stadium({0, 0}, {3, 4}, 1)})), 10 + pi, 1e-14);
  const Shape reuleaux = built({bulged_polygon(3, std::tan(pi / 12))});
  EXPECT_NEAR(area(reuleaux), 3 * (pi - std::sqrt(3.0)) / 2, 1e-14);
  const Box box = bounding_box(built({circle({5, 7}, 2, 0.3)}));
  EXPECT_NEAR(box.low.x, 3, 1e-14);
  EXPECT_NEAR(box.low.y, 5, 1e-14);
  EXPECT_NEAR(box.high.x, 7, 1e-14);
  EXPECT_NEAR(box.high.y, 9, 1e-14);
}

TEST(ArcMeasures, OrientationIsThatOfTheArcs) {
  // The chords enclose nothing, or less than the arcs on the other side.
  const Shape shape = built({{{{0, 0}, {2, 0}, {1, 0.1}}, RingRole::any, {-0.9, 0, 0}}});
  EXPECT_GT(area(shape), 0.5);
  EXPECT_FALSE(shape.hole[0]);
}

TEST(ArcMeasures, SeriesMeetsTheClosedForm) {
  for (const double bulge : {0.1249999, 0.1250001}) {
    const double angle = 4 * std::atan(bulge);
    const double radius = (1 + bulge * bulge) / (4 * bulge);
    EXPECT_NEAR(area_beside_chord({{0, 0}, {1, 0}, bulge}),
                radius * radius * (angle - std::sin(angle)) / 2, 1e-14);
  }
}

// ---------------------------------------------------------------------------------- contacts

TEST(ArcContacts, TangentCirclesTouch) {
  for (const double turn : {0.0, 0.4, 1.0, 2.5, 3.14}) {
    for (const double start : {0.0, 0.7, 1.9}) {
      SCOPED_TRACE(turn + start);
      const Vec2 direction{std::cos(turn), std::sin(turn)};
      ShapeReport report;
      // A hole that touches the circle from inside: one loop.
      const Rings inside = {circle({0, 0}, 1, start), circle(0.5 * direction, 0.5, turn + start)};
      const Shape crescent = built(inside, &report);
      EXPECT_EQ(report.touching_vertices, 1U);
      EXPECT_EQ(crescent.loop_count(), 1U);
      EXPECT_NEAR(area(crescent), 0.75 * pi, 1e-14);
      expect_contract(inside, crescent);
      // Two disks: two components.
      const Rings outside = {circle({0, 0}, 1, start), circle(1.5 * direction, 0.5, turn - start)};
      const Shape disks = built(outside, &report);
      EXPECT_EQ(report.touching_vertices, 1U);
      EXPECT_EQ(disks.component_count(), 2U);
      expect_contract(outside, disks);
    }
  }
}

/// Three petals that meet in one point: the region between them there has no area.
TEST(ArcContacts, HolesWithoutAreaAreDropped) {
  const Shape shape = built({{{{7.1128056983011049e-15, 2.0374722137188794e-14},
                               {1.0000000000000071, -0.14999999999998614},
                               {1.0000000000000109, 0.15000000000001443}},
                              RingRole::any,
                              {0.11091224540635002, 0.25008876127675839, 0.1119881212595564}},
                             {{{1.7118623751258152e-14, 1.3843208102948667e-14},
                               {-0.37009618943233302, 0.94102540378444433},
                               {-0.62990381056766287, 0.79102540378445019}},
                              RingRole::any,
                              {0.11153291560225556, 0.47956045089904453, 0.092669652022288954}},
                             {{{1.9562420706833858e-14, 8.677681967974082e-15},
                               {-0.62990381056765243, -0.79102540378443109},
                               {-0.37009618943231892, -0.94102540378443178}},
                              RingRole::any,
                              {0.10898379747919211, 0.13763815161806672, 0.14429209439071444}}});
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop)
    EXPECT_GT(shape.loop(loop).size(), 2U);
  const auto axis = compute(shape);
  ASSERT_TRUE(axis) << to_string(axis.error());
  EXPECT_TRUE(verify(shape, *axis).passed);
}

/// A vertex some tolerances outside a circle, with an arc that ends there.
TEST(ArcContacts, CrossingInAVertexIsNamed) {
  const double quarter = std::tan(pi / 8);
  EXPECT_EQ(code_of({{{{0.78648407794521635, -1.8388699777685922},
                       {1.8388699777685922, 0.78648407794521624},
                       {-0.7864840779452178, 1.8388699777685917},
                       {-1.8388699777685931, -0.78648407794521435}},
                      RingRole::any,
                      {quarter, quarter, quarter, quarter}},
                     {{{-0.052672720123108155, -1.9993062758254529},
                       {0.27355958131225672, -1.0075540459311663},
                       {-0.32623230143536347, -0.99175222989423428}},
                      RingRole::any,
                      {-0.083470578766599107, 0, -0.20520194255753366}}}),
            ErrorCode::crossing);
}

TEST(ArcContacts, CircleTouchesStraightEdgesAndVertices) {
  ShapeReport report;
  const Rings square = {{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}}, circle({1, 1}, 1, 0.2)};
  const Shape corners = built(square, &report);
  EXPECT_EQ(report.touching_vertices, 4U);
  EXPECT_EQ(corners.component_count(), 4U);
  EXPECT_NEAR(area(corners), 4 - pi, 1e-14);

  // A square in a circle: its corners lie on the arcs, to rounding.
  const double s = std::sqrt(0.5);
  const Rings inscribed = {circle({0, 0}, 1, 0.2), {{{s, s}, {-s, s}, {-s, -s}, {s, -s}}}};
  const Shape segments = built(inscribed, &report);
  EXPECT_EQ(report.touching_vertices, 4U);
  EXPECT_EQ(segments.component_count(), 4U);
  EXPECT_NEAR(area(segments), pi - 2, 1e-14);
}

TEST(ArcContacts, CrossingIsNamed) {
  const Rings rings = {circle({0, 0}, 1, 0.3), circle({1.4, 0}, 0.5, 0.7)};
  const Result<Shape> shape = build_shape(rings);
  ASSERT_FALSE(shape.ok());
  EXPECT_EQ(shape.error().code, ErrorCode::crossing);
  ASSERT_TRUE(shape.error().place.point);
  const Vec2 p = *shape.error().place.point;
  EXPECT_NEAR(norm(p), 1, 1e-14);
  EXPECT_NEAR(distance(p, {1.4, 0}), 0.5, 1e-14);
  EXPECT_EQ(shape.error().place.ring, 0U);
}

TEST(ArcContacts, CrossingTwiceBetweenVertices) {
  // An arc that dips through a segment and comes back: its ends are on the right side.
  const Rings rings = {{{{0, 0}, {10, 0}, {10, 5}, {0, 5}}},
                       {{{4, 0.5}, {6, 0.5}, {5, 2}}, RingRole::any, {0.6, 0, 0}}};
  EXPECT_EQ(code_of(rings), ErrorCode::crossing);
}

TEST(ArcContacts, Overlap) {
  EXPECT_EQ(code_of({circle({0, 0}, 1), circle({0, 0}, 1, 0.5)}), ErrorCode::overlap);
  EXPECT_EQ(code_of({stadium({0, 0}, {2, 0}, 1), circle({2, 0}, 1, 0.3)}), ErrorCode::overlap);
}

TEST(ArcContacts, SmoothJointsAreNothingSpecial) {
  test::Random random(5);
  for (int i = 0; i < 50; ++i) {
    const Rings rings = {test::smooth_biarcs(random, 200, 6)};
    ShapeReport report;
    const Shape shape = built(rings, &report);
    EXPECT_EQ(report.touching_vertices, 0U);
    EXPECT_GE(shape.points.size() + report.collinear_points, 400U);
  }
}

// ---------------------------------------------------------------------------------- roles

TEST(Winding, RingsOfOneOrientationAreOne) {
  const auto square = [](double low, double high, bool hole) {
    Ring ring{{{low, low}, {high, low}, {high, high}, {low, high}}, RingRole::winding};
    return hole ? reversed(ring) : ring;
  };
  ShapeReport report;
  Shape shape = built({square(0, 9, false), square(1, 8, false)}, &report);
  EXPECT_EQ(area(shape), 81);
  EXPECT_EQ(report.dropped_rings, 1U);
  shape = built({square(0, 9, false), square(1, 8, true)}, &report);
  EXPECT_EQ(area(shape), 81 - 49);
  EXPECT_EQ(report.dropped_rings, 0U);
  // 1, 2, 1, 0: the second and the third ring do not matter, the fourth one is a hole.
  shape = built({square(0, 9, false), square(1, 8, false), square(2, 7, true), square(3, 6, true)},
                &report);
  EXPECT_EQ(area(shape), 81 - 9);
  EXPECT_EQ(report.dropped_rings, 2U);
  ASSERT_EQ(shape.loop_count(), 2U);
  EXPECT_EQ(shape.sources[shape.loop_begin[1]].ring, 3U);
  // All the other way round, and in another order.
  shape = built({square(3, 6, false), square(2, 7, false), square(0, 9, true), square(1, 8, true)},
                &report);
  EXPECT_EQ(area(shape), 81 - 9);
  EXPECT_EQ(report.dropped_rings, 2U);
}

TEST(Winding, WithArcsAndTouching) {
  ShapeReport report;
  const Ring disk = with_role(circle({0, 0}, 1, 0.2), RingRole::winding);
  const Ring small = with_role(circle({0.5, 0}, 0.5, 1), RingRole::winding);
  EXPECT_NEAR(area(built({disk, small}, &report)), pi, 1e-14);
  EXPECT_EQ(report.dropped_rings, 1U);
  EXPECT_NEAR(area(built({disk, reversed(small)}, &report)), 0.75 * pi, 1e-14);
  EXPECT_EQ(report.dropped_rings, 0U);
  // A ring that winds twice about its inner part, which it touches in a vertex.
  Ring twice{{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {2, 1}, {1, 2}}, RingRole::winding};
  const Shape shape = built({twice, reversed(with_role(circle({1, 1.1}, 0.1), RingRole::winding))});
  EXPECT_NEAR(area(shape), 16, 1e-14);  // about the circle the winding number is 1
}

TEST(Winding, HoleAboveADroppedRing) {
  const auto box = [](Vec2 low, Vec2 high) {
    return Ring{{{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}},
                RingRole::winding};
  };
  const Shape shape =
      built({box({0, 0}, {9, 9}), box({1, 1}, {8, 2}), reversed(box({3, 4}, {5, 6}))});
  EXPECT_EQ(area(shape), 81 - 4);
  EXPECT_EQ(shape.hole_count(), 1U);
  EXPECT_EQ(shape.component_count(), 1U);
}

TEST(Roles, OuterRingsMayComeLate) {
  const Rings rings =
      test::rings_of_wkt("POLYGON ((1 1, 2 1, 2 2), (0 0, 9 0, 9 9, 0 9), (5 5, 6 5, 6 6))")
          .value();
  const Shape shape = built(rings);
  EXPECT_EQ(area(shape), 80);
  EXPECT_EQ(shape.hole_count(), 2U);
  // But not in another polygon.
  EXPECT_EQ(code_of(test::rings_of_wkt("MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9)), ((1 1, 2 1, 2 2), "
                                       "(20 0, 30 0, 30 9)))")
                        .value()),
            ErrorCode::nested_outer);
}

// ---------------------------------------------------------------------------------- at random

TEST(RandomArcShapes, AreBuiltAlikeUnderSymmetries) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const test::RandomShape random = test::random_arc_shape(seed);
    SCOPED_TRACE(random.kind + ", seed " + std::to_string(seed));
    ShapeReport report;
    const Shape shape = built(random.rings, &report);
    if (!random.rigid) continue;
    expect_contract(random.rings, shape);
    const auto& symmetries = test::symmetries();
    const test::Symmetry& symmetry = symmetries[seed % symmetries.size()];
    // Far from the origin, small shapes lose their digits.
    if (std::abs(symmetry.dx) > 1e3 * diagonal(bounding_box(shape))) continue;
    const Shape other = built(test::transformed(random.rings, symmetry));
    EXPECT_EQ(other.loop_count(), shape.loop_count());
    EXPECT_EQ(other.points.size(), shape.points.size());
    const double scale = symmetry.scale() * symmetry.scale();
    EXPECT_NEAR(area(other), scale * area(shape), 1e-7 * scale * area(shape)) << symmetry.name;
  }
}

/// The points that two arcs have in common, by their circles' centres.
std::vector<Vec2> common_points(const BulgeArc& a, const BulgeArc& b) {
  const auto center = [](const BulgeArc& arc) {
    const double height = (1 - arc.bulge * arc.bulge) / (4 * arc.bulge);
    return midpoint(arc.start, arc.end) + height * left_of(arc.chord());
  };
  const Vec2 c = center(a);
  const Vec2 d = center(b);
  const double r = distance(c, a.start);
  const double s = distance(d, b.start);
  const double between = distance(c, d);
  const double x = (between * between + r * r - s * s) / (2 * between);
  if (r * r < x * x) return {};
  const double y = std::sqrt(r * r - x * x);
  const Vec2 unit = (1 / between) * (d - c);
  std::vector<Vec2> result;
  for (const double sign : {1.0, -1.0}) {
    const Vec2 p = c + x * unit + (sign * y) * left_of(unit);
    const bool on_a = cross(a.chord(), p - a.start) * a.bulge < 0;
    const bool on_b = cross(b.chord(), p - b.start) * b.bulge < 0;
    if (on_a && on_b) result.push_back(p);
  }
  return result;
}

TEST(RandomArcShapes, CrossingsAreFoundAsByAllPairs) {
  int crossings = 0;
  int valid = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    test::Random random(seed);
    const auto blob = [&](double size) {
      const auto n = static_cast<std::size_t>(random.integer(2, 7));
      Ring ring = bulged_polygon(n, random.between(0.05, 0.95), size);
      const Vec2 offset{random.between(-1, 1), random.between(-1, 1)};
      const double angle = random.between(0, 6);
      for (Vec2& p : ring.points) p = offset + turned(p, std::cos(angle), std::sin(angle));
      return ring;
    };
    const Rings rings = {blob(random.between(0.1, 0.6)), blob(random.between(0.1, 0.6)),
                         blob(random.between(0.1, 0.6))};
    std::vector<Vec2> common;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      for (std::size_t j = i + 1; j < rings.size(); ++j) {
        for (std::size_t k = 0; k < rings[i].points.size(); ++k) {
          for (std::size_t l = 0; l < rings[j].points.size(); ++l) {
            const auto found = common_points(edge(rings[i], k), edge(rings[j], l));
            common.insert(common.end(), found.begin(), found.end());
          }
        }
      }
    }
    const Result<Shape> shape = build_shape(rings);
    EXPECT_EQ(shape.ok(), common.empty());
    if (shape) {
      ++valid;
      expect_contract(rings, *shape);
    } else {
      ++crossings;
      EXPECT_EQ(shape.error().code, ErrorCode::crossing);
      ASSERT_TRUE(shape.error().place.point);
      EXPECT_TRUE(std::any_of(common.begin(), common.end(), [&](Vec2 p) {
        return distance(p, *shape.error().place.point) < 1e-9;
      })) << to_string(shape.error());
    }
  }
  EXPECT_GT(crossings, 500);
  EXPECT_GT(valid, 500);
}

// Crossings: an error, or places to split edges at.

Result<Shape> noded(Rings rings, RingRole role, ShapeReport* report = nullptr) {
  for (Ring& ring : rings) ring.role = role;
  return build_shape(rings, {.node_crossings = true}, report);
}

TEST(ArcCrossings, TwoDisksByBothRules) {
  // Circles of radius 1 whose centres are 1 apart: their common part is a lens.
  const double lens = 2 * pi / 3 - std::sqrt(3.0) / 2;
  const Rings rings{circle({0, 0}, 1), circle({1, 0}, 1)};
  EXPECT_EQ(code_of(rings), ErrorCode::crossing);
  ShapeReport report;
  const auto both = noded(rings, RingRole::winding, &report);
  ASSERT_TRUE(both) << to_string(both.error());
  EXPECT_EQ(report.crossings, 2u);
  EXPECT_EQ(both->loop_count(), 1u);
  EXPECT_NEAR(area(*both), 2 * pi - lens, 1e-13);
  const auto either = noded(rings, RingRole::any);
  ASSERT_TRUE(either) << to_string(either.error());
  EXPECT_EQ(either->component_count(), 2u);  // two moons that touch in their tips
  EXPECT_NEAR(area(*either), 2 * (pi - lens), 1e-13);
}

TEST(ArcCrossings, PolygonsToo) {
  const Rings star = *test::rings_of_wkt("POLYGON((0 0, 3 5, 6 0, 0 3, 6 3, 0 0))");
  EXPECT_EQ(code_of(star), ErrorCode::crossing);
  ShapeReport report;
  const auto shape = noded(star, RingRole::winding, &report);
  ASSERT_TRUE(shape) << to_string(shape.error());
  EXPECT_GT(report.crossings, 0u);
  const auto axis = compute(*shape);
  ASSERT_TRUE(axis);
  EXPECT_TRUE(verify(*shape, *axis).passed);
}

TEST(ArcCrossings, AHoleAmongCrossingsHasItsComponent) {
  // Four bars around a square hole; at the hole's leftmost corner only edges inside end.
  Rings rings;
  const auto bar = [&](Vec2 low, Vec2 high) {
    const bool flat = high.x - low.x > high.y - low.y;  // half circles at the ends
    const std::vector<double> bulges =
        flat ? std::vector<double>{0, 1, 0, 1} : std::vector<double>{1, 0, 1, 0};
    rings.push_back({{low, {high.x, low.y}, high, {low.x, high.y}}, RingRole::any, bulges});
  };
  bar({0, 0}, {5, 1});
  bar({0, 4}, {5, 5});
  bar({0.25, -1}, {1.25, 6});
  bar({3.75, -1}, {4.75, 6});
  const auto shape = noded(rings, RingRole::winding);
  ASSERT_TRUE(shape) << to_string(shape.error());
  EXPECT_EQ(shape->component_count(), 1u);
  EXPECT_EQ(shape->hole_count(), 1u);
  const auto axis = compute(*shape);
  ASSERT_TRUE(axis);
  EXPECT_TRUE(verify(*shape, *axis).passed);
}

TEST(ArcCrossings, RandomDisksAreVerified) {
  test::Random random(5);
  for (int round = 0; round < 60; ++round) {
    Rings rings;
    const int count = static_cast<int>(random.integer(2, 12));
    for (int i = 0; i < count; ++i)
      rings.push_back(circle({random.between(0, 4), random.between(0, 4)}, random.between(0.2, 2),
                             random.between(0, pi)));
    for (const RingRole role : {RingRole::winding, RingRole::any}) {
      const auto shape = noded(rings, role);
      ASSERT_TRUE(shape) << round << ": " << to_string(shape.error());
      const auto axis = compute(*shape, {.threads = 1});
      ASSERT_TRUE(axis);
      const Certificate certificate = verify(*shape, *axis, {.threads = 1});
      EXPECT_TRUE(certificate.passed) << round << ": " << certificate.failures[0];
    }
  }
}

// Overlaps: edges that lie on each other count as often as they run there.

TEST(ArcOverlaps, StripsWithCommonArcsByBothRules) {
  // Disks whose boundaries share arcs: the same circle from other starts, and a half of it.
  const Ring half{{{-1, 0}, {1, 0}}, RingRole::any, {1, 0}};
  const Rings same{circle({0, 0}, 1), circle({0, 0}, 1, 0.3)};
  EXPECT_NEAR(area(*noded(same, RingRole::winding)), pi, 1e-13);
  EXPECT_EQ(noded(same, RingRole::any).error().code, ErrorCode::no_area);
  const Rings cut{circle({0, 0}, 1), half};
  ShapeReport report;
  const auto rest = noded(cut, RingRole::any, &report);
  ASSERT_TRUE(rest) << to_string(rest.error());
  EXPECT_NEAR(area(*rest), pi / 2, 1e-13);
  EXPECT_EQ(report.input_rings, 2u);
  const auto all = noded(cut, RingRole::winding);
  ASSERT_TRUE(all) << to_string(all.error());
  EXPECT_NEAR(area(*all), pi, 1e-13);
  EXPECT_EQ(all->loop_count(), 1u);
}

TEST(ArcOverlaps, OppositeOrientationsCancel) {
  const Rings square = *test::rings_of_wkt("POLYGON((0 0,4 0,4 4,0 4,0 0))");
  Ring back = square[0];
  std::reverse(back.points.begin(), back.points.end());
  EXPECT_EQ(noded({square[0], back}, RingRole::winding).error().code, ErrorCode::no_area);
  const Rings two = *test::rings_of_wkt(
      "MULTIPOLYGON(((0 0,4 0,4 4,0 4,0 0)),((4 1,8 1,8 3,4 3,4 1)),((9 9,9 9,9 9)))");
  const auto joined = noded(two, RingRole::winding);
  ASSERT_TRUE(joined) << to_string(joined.error());
  EXPECT_EQ(joined->loop_count(), 1u);
  EXPECT_EQ(joined->points.size(), 8u);
  EXPECT_DOUBLE_EQ(area(*joined), 24);
}

TEST(ArcOverlaps, RandomBlocksOnAGridHaveTheAreaOfTheirCells) {
  test::Random random(8);
  for (int round = 0; round < 100; ++round) {
    Rings rings;
    std::array<std::array<int, 8>, 8> cells{};
    const auto count = random.integer(2, 9);
    for (int k = 0; k < count; ++k) {
      const auto x = random.integer(0, 6), y = random.integer(0, 6);
      const auto right = random.integer(x + 1, 8), top = random.integer(y + 1, 8);
      const auto at = [](auto a, auto b) {
        return Vec2{static_cast<double>(a), static_cast<double>(b)};
      };
      rings.push_back({{at(x, y), at(right, y), at(right, top), at(x, top)}});
      for (auto i = x; i < right; ++i)
        for (auto j = y; j < top; ++j)
          ++cells[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
    double any = 0, odd = 0;
    for (const auto& column : cells)
      for (const int cell : column) any += cell > 0 ? 1 : 0, odd += cell % 2;
    const auto by_winding = noded(rings, RingRole::winding),
               by_parity = noded(rings, RingRole::any);
    ASSERT_TRUE(by_winding) << round << ": " << to_string(by_winding.error());
    EXPECT_NEAR(area(*by_winding), any, 1e-9) << round;
    if (odd > 0) {
      ASSERT_TRUE(by_parity) << round << ": " << to_string(by_parity.error());
      EXPECT_NEAR(area(*by_parity), odd, 1e-9) << round;
    } else {
      EXPECT_FALSE(by_parity);
    }
  }
}

// Bars as letters are built of: parts of their edges lie on each other, other bars end inside.
// Where an edge goes on straight there is no corner, though rounding moves the points that split
// it.
TEST(ArcOverlaps, UnionsOfBarsHaveTheCornersOfTheirCells) {
  constexpr int size = 40;
  test::Random random(12);
  int corners_in_all = 0;
  for (int round = 0; round < 200; ++round) {
    Rings rings;
    std::array<std::array<bool, size + 2>, size + 2> cells{};  // with an empty frame
    const auto add = [&](int x, int y, int right, int top) {
      const auto at = [](int a, int b) { return Vec2{10.0 * a, 10.0 * b}; };
      rings.push_back({{at(x, y), at(right, y), at(right, top), at(x, top)}});
      for (int i = x; i < right; ++i)
        for (int j = y; j < top; ++j)
          cells[static_cast<std::size_t>(i + 1)][static_cast<std::size_t>(j + 1)] = true;
    };
    const auto pick = [&](int low, int high) {
      return static_cast<int>(random.integer(low, high));
    };
    for (const int x : {pick(0, 8), pick(20, 32)}) add(x, 0, x + pick(5, 8), size);
    for (int k = pick(1, 3); k > 0; --k) {
      const int y = pick(0, 1) == 0 ? size - 6 : pick(0, size - 6);
      add(pick(0, 15), y, pick(20, size), y + 6);
    }
    int expected = 0;
    for (std::size_t i = 0; i <= size; ++i)
      for (std::size_t j = 0; j <= size; ++j) {
        const bool a = cells[i][j], b = cells[i + 1][j], c = cells[i][j + 1],
                   d = cells[i + 1][j + 1];
        const int count = a + b + c + d;
        expected += count == 2 && a == d ? 2 : count % 2;
      }
    const auto shape = noded(rings, RingRole::winding);
    ASSERT_TRUE(shape) << round << ": " << to_string(shape.error());
    int corners = 0;
    for (std::size_t loop = 0; loop < shape->loop_count(); ++loop) {
      const auto points = shape->loop(loop);
      for (std::size_t v = 0; v < points.size(); ++v) {
        const Vec2 from = points[v], at = points[(v + 1) % points.size()],
                   to = points[(v + 2) % points.size()];
        corners += cross(at - from, to - at) != 0;
      }
    }
    EXPECT_EQ(corners, expected) << round;
    corners_in_all += corners;
  }
  EXPECT_GT(corners_in_all, 2000);
}

// Shapes of few spacings of their coordinates.

TEST(ArcShape, SoSmallFarAwayIsAShapeOrATypedError) {
  constexpr double spacing = 0.125;  // of the coordinates
  int shapes = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    test::Random random(seed);
    const double size = spacing * random.power_of_ten(0, 5);
    const Vec2 far{random.between(-1e15, 1e15), 1e15};
    Rings rings = test::bent(random, {test::regular_polygon(5, size)});
    rings.push_back(circle({0, 0}, size * random.between(0.1, 0.8)));
    for (Ring& ring : rings)
      for (Vec2& p : ring.points) p = p + far;
    const auto shape = build_shape(rings);
    shapes += shape ? 1 : 0;
    if (!shape) {
      EXPECT_NE(shape.error().code, ErrorCode::internal) << seed;
    }
    if (size < 16 * spacing) {
      ASSERT_FALSE(shape) << seed;
      EXPECT_TRUE(shape.error().place.ring.has_value()) << seed;
    }
  }
  EXPECT_GT(shapes, 200);
}

// A vertex comes to lie on the arc that ends beside it, so that an arc leads there and a chord
// of 1.5 tolerances back: their bulges tell which one lies on which side, apices round by more. As
// hole of the exterior it is the tip of a needle.
TEST(ArcShape, SideBesideItsOwnChordByLessThanAnApexRounds) {
  const Rings corners[] = {
      {{{{-93, 33}, {-93.000000000001322, 32.999999999999375}, {0, 0}},
        RingRole::any,
        {0, -0.73228346456692917, 0}}},
      {{{{-43, -35}, {-42.999999999999517, -35.000000000001648}, {0, 0}},
        RingRole::any,
        {0, -0.80314960629921262, 0}}},
  };
  for (const Rings& rings : corners) {
    const Shape shape = built(rings);
    for (const bool exterior : {false, true}) {
      const auto axis = compute(shape, {.exterior = exterior});
      ASSERT_TRUE(axis.ok()) << to_string(axis.error());
      EXPECT_TRUE(verify(shape, *axis).passed) << exterior;
    }
  }
}

/// If edges almost touch, the result of merging does not depend on the orientation of the rings.
TEST(ArcShape, OfEdgesThatAllButTouchIsThatOfItsImages) {
  constexpr double x = 5.941298916885756e+70, y = 5.941298916885756e+57;
  const std::array<Ring, 3> rings{
      Ring{{{2, 1.7}, {8.5e-15, 1.7}, {0, 1.6999999999999915}, {0, 8.5e-15}},
           RingRole::any,
           {0, 1, 0, 0}},
      Ring{{{5.94129891688575e+70, -y}, {x, -y}, {x, y}, {-x, y}}, RingRole::any, {-1, 1, 0, 0}},
      Ring{{{0.3, 0.7000000000000016},
            {0.6740856904394494, 1.6273941428586014},
            {0.2999999999999926, 0.7000000000000094},
            {-0.6901897322561685, 0.5602706396835043}},
           RingRole::any,
           {-0.2, 0, 1, 0}}};
  for (const Ring& ring : rings) {
    const Shape shape = built({ring});
    for (const test::Symmetry& symmetry :
         {test::Symmetry{.name = "mirrored", .xx = -1},
          test::Symmetry{.name = "turned by a quarter", .xx = 0, .xy = -1, .yx = 1, .yy = 0}}) {
      const Shape image = built(test::transformed({ring}, symmetry));
      EXPECT_EQ(image.points.size(), shape.points.size()) << symmetry.name;
      EXPECT_EQ(image.loop_begin, shape.loop_begin) << symmetry.name;
    }
  }
}

/// A circle of arcs between vertices at random.
Ring random_circle(test::Random& random, Vec2 center, double radius) {
  std::vector<double> angles(static_cast<std::size_t>(random.integer(2, 5)));
  for (double& angle : angles) angle = random.between(0, 2 * pi);
  std::sort(angles.begin(), angles.end());
  Ring ring;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    ring.points.push_back(center + radius * Vec2{std::cos(angles[i]), std::sin(angles[i])});
    const double next = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2 * pi;
    ring.bulges.push_back(std::tan((next - angles[i]) / 4));
  }
  return ring;
}

/// Three circular holes that touch each other, up to rounding: their arcs merge alike, whichever
/// way their rings run.
TEST(ArcShape, OfCirclesThatTouchIsThatOfItsImages) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    test::Random random(seed);
    const double a = random.between(0.1, 0.4), b = random.between(0.1, 0.4),
                 c = random.between(0.1, 0.4), base = a + b;
    const double x = ((a + c) * (a + c) - (b + c) * (b + c) + base * base) / (2 * base);
    const Rings rings{
        test::rectangle(2, 2)[0], random_circle(random, {0.5, 0.5}, a),
        random_circle(random, {0.5 + base, 0.5}, b),
        random_circle(random, {0.5 + x, 0.5 + std::sqrt((a + c) * (a + c) - x * x)}, c)};
    const auto shape = build_shape(rings);
    for (const test::Symmetry& symmetry :
         {test::Symmetry{.name = "mirrored", .xx = -1},
          test::Symmetry{.name = "turned by a quarter", .xx = 0, .xy = -1, .yx = 1, .yy = 0},
          test::Symmetry{.name = "reversed", .reverse = true}}) {
      const auto image = build_shape(test::transformed(rings, symmetry));
      ASSERT_EQ(image.ok(), shape.ok()) << seed << ", " << symmetry.name;
      if (!shape) continue;
      EXPECT_EQ(image->points.size(), shape->points.size()) << seed << ", " << symmetry.name;
      EXPECT_EQ(image->loop_count(), shape->loop_count()) << seed << ", " << symmetry.name;
    }
  }
}

/// Arcs that have become one may continue the next one, in a loop made of rings that touch, too.
TEST(ArcShape, BuiltAgainMergesNothingMore) {
  const auto class_of = [](std::string_view name) {
    return *ranges::find(test::nasty_classes(), name, &test::NastyClass::name);
  };
  for (const Rings& rings : {test::nasty_shape(class_of("circles"), 20261130200000021, false),
                             test::nasty_shape(class_of("bars"), 20261130200000018, false),
                             test::random_arc_shape(117).rings}) {
    const Shape shape = built(rings);
    EXPECT_EQ(built(rings_of(shape)).points.size(), shape.points.size());
  }
}

// An arc that comes back along its neighbour, 1e-14 away: less than the tolerance of an exterior
// that is far larger.
TEST(ArcShape, TooFineForItsExteriorIsNamedInTheInput) {
  const Ring ring{{{1.136880928071773, 1.2473849762550373},
                   {0.24439116894908247, 1.6984526317803716},
                   {-0.6, 1.1510676555253343},
                   {0.24439116894908786, 1.6984526317802717}},
                  RingRole::any,
                  {1, 0.2679491924311227, -0.2679491924311224, 0}};
  const Shape shape = built({ring});
  EXPECT_TRUE(compute(shape).ok());
  const auto axis = compute(shape, {.exterior = true, .margin = 1000});
  ASSERT_FALSE(axis.ok());
  EXPECT_EQ(axis.error().code, ErrorCode::unsupported);
  EXPECT_EQ(axis.error().place.ring, 0U);
  EXPECT_NE(axis.error().text.find("choose a smaller margin"), std::string::npos);
}

// A short arc that crosses its neighbour, a long and nearly straight arc, by ten tolerances, so
// near to its end that rounding decides on which side of the chord that place is.
TEST(ArcShape, NeedlesWhoseSidesCrossNextToAnEndAreRefused) {
  EXPECT_EQ(code_of({{{{0, 0},
                       {0.97291981993296794, -0.23114286487279059},
                       {-2.2357970391813226e-13, -8.4544800190126767e-14}},
                      RingRole::any,
                      {6.7941813669230869e-11, -6.7941813669230869e-11, 0.88943549990654169}}}),
            ErrorCode::crossing);
}

// The arc passes through the end of the needle, so that a part of it leads back along the needle.
TEST(ArcShape, NeedlesOfNoWidthAreDropped) {
  const Ring ring{{{6.66133814775094e-16, 1.998401444325282e-15},
                   {1.0000000000000024, -2.2204460492503133e-16},
                   {0.9999999999999963, -5.551115123125783e-16},
                   {0.31221181986362817, -0.9999999999999999}},
                  RingRole::any,
                  {-0.13467593254061416, 0, 0, 0}};
  const Shape shape = built({ring});
  EXPECT_EQ(shape.points.size(), 3);
  EXPECT_EQ(shape.loop_count(), 1);
  const auto axis = compute(shape);
  ASSERT_TRUE(axis.ok()) << to_string(axis.error());
  EXPECT_TRUE(verify(shape, *axis).passed);
}

/// Discs that touch each other from inside and outside, each of two half circles, whose ends need
/// not be where they touch.
Rings touching_discs(test::Random& random) {
  Rings rings;
  Vec2 center;
  double radius = 1;
  const auto halvings = [&] { return std::ldexp(1, -static_cast<int>(random.integer(0, 2))); };
  for (std::int64_t left = random.integer(2, 22); left > 0; --left) {
    const Vec2 side = test::turned({1, 0}, pi / 2 * static_cast<double>(random.integer(0, 3)));
    const Vec2 toward{std::round(side.x), std::round(side.y)};
    if (rings.empty() || random.chance(0.2)) {
      center = {static_cast<double>(random.integer(-6, 6)),
                static_cast<double>(random.integer(-6, 6))};
      radius = halvings();
    } else {
      const double own = radius * halvings();
      center = center + (random.chance(0.5) ? radius + own : radius - own) * toward;
      radius = own;
    }
    const Vec2 arm = random.chance(0.5) ? Vec2{radius, 0} : Vec2{0, radius};
    rings.push_back({{center + arm, center - arm}, RingRole::any, {1, 1}});
  }
  return rings;
}

/// Vertices that rings share stay, and loops come in the order of the rings: so what is built
/// again is the same, in the same order.
TEST(ArcShape, OfTouchingDiscsIsBuiltAgainTheSame) {
  int built_shapes = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    test::Random random(seed);
    const auto shape = build_shape(touching_discs(random));
    if (!shape) continue;  // of discs that cross
    ++built_shapes;
    const Shape again = built(rings_of(*shape));
    ASSERT_EQ(again.points, shape->points) << seed;
    ASSERT_EQ(again.bulges, shape->bulges) << seed;
    ASSERT_EQ(again.loop_begin, shape->loop_begin) << seed;
  }
  EXPECT_GT(built_shapes, 200);
}

/// A circle of few arcs, with an edge of up to 200 spacings of its coordinates at a vertex.
Ring circle_with_needle(test::Random& random) {
  Ring ring = test::arcs_of_circle(random.chance(0.5) ? 3 : 5);
  const auto at = static_cast<std::size_t>(random.integer(0, 2));
  const auto off = [&] { return random.power_of_ten(-16, -13.3) * random.between(-1, 1); };
  ring.points.insert(ring.points.begin() + static_cast<std::ptrdiff_t>(at),
                     ring.points[at] + Vec2{off(), off()});
  const double bulge = 0.5 * static_cast<double>(random.integer(-2, 2));
  ring.bulges.insert(ring.bulges.begin() + static_cast<std::ptrdiff_t>(at), bulge);
  const Vec2 away = random.chance(0.5) ? Vec2{0, 0} : random.power_of_ten(0, 6) * Vec2{1, 0.3};
  const double angle = random.between(0, 6);
  for (Vec2& p : ring.points) p = test::turned(p, angle) + away;
  return ring;
}

/// Where an edge between arcs of one circle vanishes, they become one arc: at once, so that what is
/// built stays as it is.
TEST(ArcShape, OfACircleWithANeedleIsBuiltAgainTheSame) {
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    test::Random random(seed);
    const auto shape = build_shape(Rings{circle_with_needle(random)});
    refused += shape ? 0 : 1;
    if (!shape) continue;
    const Shape again = built(rings_of(*shape));
    ASSERT_EQ(again.points, shape->points) << seed;
    ASSERT_EQ(again.bulges, shape->bulges) << seed;
  }
  EXPECT_LT(refused, 20);  // whose needles cross their neighbours by more than the tolerance
}

}  // namespace
}  // namespace medial
