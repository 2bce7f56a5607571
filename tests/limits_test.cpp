// What is too large, too small or too thin is refused alike by compute() and verify(); all else is
// right.

#include "shape/limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "medial/medial.h"
#include "support/examine.h"
#include "support/generate.h"

namespace medial::test {
namespace {

Rings square(double size) { return rectangle(size, size); }

TEST(Limits, EverythingUpToThemIsVerified) {
  for (const double size : {smallest_coordinate, 1e-50, 1e50, largest_coordinate}) {
    const Outcome outcome = examine(square(size));
    EXPECT_EQ(outcome.verdict, Verdict::verified) << size << ": " << outcome.reasons[0];
  }
}

TEST(Limits, ComputeAndVerifyRefuseTheSameBeyondThem) {
  const MedialAxis unit = *compute(*build_shape(square(1)));
  for (const double size : {5e-324, 1e-300, 1e-149, 9e-101, 1.1e100, 1e149, 1e300, 1.7e308}) {
    const Shape shape = *build_shape(square(size));
    const auto axis = compute(shape);
    ASSERT_FALSE(axis.ok()) << size;
    EXPECT_EQ(axis.error().code, ErrorCode::unsupported) << size;
    EXPECT_EQ(axis.error().place.ring, 0U);
    EXPECT_EQ(axis.error().place.vertex, 1U);
    const Certificate certificate = verify(shape, unit);
    EXPECT_FALSE(certificate.passed) << size;
    ASSERT_EQ(certificate.failures.size(), 1U) << size;
    EXPECT_NE(certificate.failures[0].find("unsupported"), std::string::npos);
  }
}

TEST(Limits, ThinAndNearlyTouchingShapesAreVerifiedOrRefused) {
  for (int exponent = 1; exponent < 320; exponent += exponent < 20 ? 1 : 13) {
    const double h = std::pow(10, -exponent);
    const std::vector<Rings> shapes{
        {ring_of({{0, 0}, {1, 0}, {1, h}, {0, h}})},         // sliver
        {ring_of({{0, 0}, {1, 0}, {0.001, h}})},             // needle
        {ring_of({{0, 0}, {0.3, -h}, {1, 0}, {0.001, h}})},  // both ways
        {ring_of({{0, 0}, {0.3, -h}, {1, 0}, {1, 1}})},      // flat corner
        {ring_of({{0, 0}, {0.3, h}, {1, 0}, {1, 1}})},       // flat dent
        {ring_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), ring_of({{h, 0.3}, {0.5, 0.2}, {0.5, 0.8}})}};
    for (const Rings& rings : shapes) {
      const Outcome outcome = examine(rings);
      const auto expected = h < smallest_coordinate ? Verdict::refused : Verdict::verified;
      EXPECT_EQ(outcome.verdict, expected)
          << to_wkt(rings) << (outcome.reasons.empty() ? "" : outcome.reasons[0]);
      if (outcome.verdict == Verdict::refused) {
        EXPECT_EQ(outcome.code, ErrorCode::unsupported);
      }
    }
  }
}

TEST(Limits, ExteriorsOfTinyEdgesAreVerified) {
  for (const Method& method : {Method{method::Disks{}}, Method{method::Lee{}}}) {
    for (int exponent = 3; exponent < 99; exponent += 3) {
      const Shape shape = *build_shape(std::vector{
          ring_of({{65, 70}, {13, 70}, {76, 108}, {-6.5 * std::pow(10, exponent), 0}})});
      Options options{.method = method};
      options.exterior = true;
      const auto axis = compute(shape, options);
      ASSERT_TRUE(axis.ok()) << exponent << to_string(axis.error());
      EXPECT_TRUE(verify(shape, *axis).passed) << exponent;
    }
  }
}

/// Of polygons whose coordinates differ by more than 256 bits hold.
void expect_verified_axes(const Ring& ring) {
  const Shape shape = *build_shape(std::vector{ring});
  for (const Method& method : {Method{method::Disks{}}, Method{method::Lee{}}})
    for (const bool exterior : {false, true}) {
      Options options{.method = method};
      options.exterior = exterior;
      const auto axis = compute(shape, options);
      ASSERT_TRUE(axis.ok()) << exterior << to_string(axis.error());
      const Certificate certificate = verify(shape, *axis);
      EXPECT_TRUE(certificate.passed) << exterior << certificate.failures[0];
    }
}

// Found by fuzzing: 256 bits do not hold an x of 1e-97 beside a size of 85.
TEST(Limits, VerticesMayDifferByLessThan256BitsHold) {
  expect_verified_axes(ring_of(
      {{0, -85}, {0, -85.000000000002728}, {6.675e-05, -84.99999}, {-2.1213845982199024e-97, 0}}));
  expect_verified_axes(ring_of({{-3, -3.0168634718857032e-67},
                                {2.7415073928157658e-77, 0},
                                {0.5, 7.2484300726077141e-54},
                                {1.5987244757332046e-63, 7},
                                {-8.1014405677487472e-94, 5.5035642207270436e-98},
                                {-51, 0},
                                {-1, 0}}));
}

// Found by fuzzing: a slit along y = x, 1e-95 wide at its end, next to no vertex that is as near.
TEST(Limits, ACoordinateMayBeSmallerThan256BitsHold) {
  expect_verified_axes(
      ring_of({{26, 26}, {-122, -122}, {-122, 26}, {52, 52}, {9.3633527093843967e-96, 0}}));
}

// Whether a disk's foot lies on an edge that ends at a touched vertex is open in twice double's
// digits, so they do not show that the disk reaches over the edge.
TEST(Limits, ADiskBesideATouchedVertexKeepsClearOfTheEdgeThere) {
  expect_verified_axes(ring_of({{0, -1.3131066595707295e-70},
                                {1, -2.7473539658689896e-87},
                                {0.5, 2.011072621377463e-77},
                                {7.0000000000000036, 4.6808948553198412e-66},
                                {-1.0000000000000009, 2.4602764709257489e-41}}));
  expect_verified_axes(ring_of({{-4.9205594526970751e-60, -4.7146951226678281e-51},
                                {0, 7},
                                {-4.9828105405397205e-75, 7.0000000000000062},
                                {7.7320089856311945e-43, -1.2509612517923723e-52},
                                {-3.2940411484771161e-70, 1}}));
}

// Double puts a disk of 6e-21 at 1.5, next to sides that 256 bits hold to 1e-38 only.
TEST(Limits, ANeedleOfATinyBaseIsVerified) {
  const Shape shape =
      *build_shape(std::vector{ring_of({{0, -6.8373189140109183e-51},
                                        {7.440889645336302e-56, -5.9318765896075826e-21},
                                        {85, -3.0000000000000009},
                                        {2.0700714505490342e-38, 2.642543054720633e-17},
                                        {-3.9590548366369501e-92, -7.7272225946954137e-65}})});
  for (const Method& method : {Method{method::Disks{}}, Method{method::Lee{}}}) {
    const auto axis = compute(shape, {.method = method});
    ASSERT_TRUE(axis.ok()) << to_string(axis.error());
    const Certificate certificate = verify(shape, *axis);
    EXPECT_TRUE(certificate.passed) << certificate.failures[0];
  }
}

// 256 bits leave open by 1e-10 where the disk of 5e-56 is.
TEST(Limits, ADiskOf5em56BesideASizeOf85) {
  expect_verified_axes(ring_of({{4.2080864162421446e-67, -1.0000000000000004},
                                {85.000000000000071, -5.0119936214159465e-38},
                                {9.5408178832951628e-65, 0},
                                {4.3007768761476167e-27, 4.1097543501863732e-67},
                                {0, 85.000000000000014},
                                {0, 4.871333627475911e-56}}));
}

// Found by fuzzing: the edge below a needle ends beside its vertices, at less than 2^-128 of the
// way.
TEST(Limits, AnEventAtTheEndOfALongWay) {
  expect_verified_axes(ring_of({{14, 87},
                                {42, -63},
                                {42.000000000006366, -63.000000000008185},
                                {-86, 96},
                                {1.5177100720513508e+82, 0}}));
}

// At a corner a disk's radius grows by the cosine of half the turn along the bisector: next to an
// edge that is nearly parallel to one of the sides, 1 in its place took an open disk for certain.
TEST(Limits, DisksInACornerBesideANearlyParallelEdge) {
  expect_verified_axes(ring_of({{1.0000000000000009, 0},
                                {1.5589291292150784e-22, 0},
                                {0, 0.5},
                                {0, 4.2787955428212349e-58},
                                {-8.9433774804252014e-62, 7}}));
  expect_verified_axes(ring_of({{100.00000000000003, -69},
                                {-1.3235609106362873e-49, -99},
                                {-2.6162143303583957e-65, 0},
                                {-2.3704155237419353e-70, -1},
                                {2.5987350957523113e-22, 9.2405317324979121e-66},
                                {7.0000000000000044, 2.6904542793552223e-64}}));
  expect_verified_axes(ring_of({{32, 0},
                                {6.2178340061833699e-22, 1.0096040378410369e-50},
                                {0, 0.50000000000000044},
                                {1.0049951009051923e-55, -9.9118238899765686e-47},
                                {-4.7360514130410979e-53, 5.2288099100831597e-63},
                                {-1.0889111471496559e-56, 88}}));
}

// On the last hole, some 300 spacings wide, double took the foot of a bridge for one on the other
// side of the arc's middle, so that an edge passed the bridge.
TEST(Limits, HolesOfAFewHundredSpacings) {
  const double fillet = 1.929519843658356e-08, far = 10.999999980704802, top = 13.999999980704802;
  const Ring outline{.points = {{fillet, 0},
                                {far, 0},
                                {11, fillet},
                                {11, top},
                                {far, 14},
                                {fillet, 14},
                                {0, top},
                                {0, fillet}},
                     .bulges = {0, -0.41421356219898819, 0, 0.41421356217721922, 0,
                                0.41421356247697788, 0, 0.41421356219827676}};
  const auto lens = [](Vec2 a, double b) {
    return Ring{.points = {a, {b, a.y}}, .bulges = {0.7, 0.3}};
  };
  const Shape shape = *build_shape(
      std::vector{outline, lens({2.202087029662509, 12.794619595658666}, 2.204907216182074),
                  lens({4.5933468651405942, 1.3871748635653982}, 4.609191237266252),
                  lens({5.795748218464067, 5.6752520050544142}, 5.7957482184643103)});
  const auto axis = compute(shape);
  ASSERT_TRUE(axis.ok()) << to_string(axis.error());
  const Certificate certificate = verify(shape, *axis);
  EXPECT_TRUE(certificate.passed) << certificate.failures[0];
}

// With ties kept, two nodes have one disk in double, with both feet of their edge in one place.
TEST(Limits, AnEdgeOfNoLengthInAFlatCornerIsVerified) {
  const Shape shape =
      *build_shape(std::vector{ring_of({{-0.07, 0},
                                        {0, 0},
                                        {9.642004557593873e-13, 9.082039841780426e-23},
                                        {0.7240524425670826, 6.820026988841895e-11},
                                        {0, 0.3}})});
  const auto axis = compute(shape, {.exact = true});
  ASSERT_TRUE(axis.ok()) << to_string(axis.error());
  const Certificate certificate = verify(shape, *axis);
  EXPECT_TRUE(certificate.passed) << certificate.failures[0];
}

// The disk of a corner of 1e-12 touches the lines of three edges wherever it is.
TEST(Limits, AVeryFlatCornerBesideAFlatOne) {
  const Shape shape = *build_shape(std::vector{ring_of({{-0.007359907, -0.0050210733},
                                                        {0, 0},
                                                        {3.19400685694e-12, 2.17901449242e-12},
                                                        {0.00042522841357, 0.000290099213077},
                                                        {0, 0.01}})});
  const auto axis = compute(shape);
  ASSERT_TRUE(axis.ok()) << to_string(axis.error());
  const Certificate certificate = verify(shape, *axis);
  EXPECT_TRUE(certificate.passed) << certificate.failures[0];
}

// A fillet that is off by rounding: with ties kept, no edge leads on past its centre.
TEST(Limits, AFilletOffByRoundingHasOneLeaf) {
  const Shape shape = *build_shape(std::vector{
      Ring{.points = {{-4, -3}, {4, -3}, {4, 2.6346224407871359}, {3.6346224407871359, 3}, {-4, 3}},
           .bulges = {0, 0, 0.41421356273088761, 0, 0}}});
  for (const bool exact : {false, true}) {
    const auto axis = compute(shape, {.exact = exact});
    ASSERT_TRUE(axis.ok()) << to_string(axis.error());
    EXPECT_EQ(axis->edges.size(), 6U) << exact;
    const Certificate certificate = verify(shape, *axis);
    EXPECT_TRUE(certificate.passed) << certificate.failures[0];
  }
}

// An edge between two vertices so near to each other has a weight of 1e60.
TEST(Limits, TheAreaBesideAWaistIsANumber) {
  for (const double half : {1e-10, 1e-60, 1e-90}) {
    const Shape shape = *build_shape(std::vector{ring_of(
        {{0, -1}, {1.7, -half}, {1.7, -1}, {3, -1}, {3, 1}, {1.7, 1}, {1.7, half}, {0, 1}})});
    const auto axis = compute(shape);
    ASSERT_TRUE(axis.ok()) << half << to_string(axis.error());
    const Certificate certificate = verify(shape, *axis);
    EXPECT_TRUE(certificate.passed) << half << certificate.failures[0];
    EXPECT_NEAR(certificate.disks_area, area(shape), 1e-12);
  }
}

TEST(Limits, OneUlpWideShapesAreVerified) {
  const double next = std::nextafter(1.0, 2.0);
  for (const Rings& rings : {Rings{ring_of({{0, 1}, {1, 1}, {1, next}, {0, next}})},
                             Rings{ring_of({{1, 0}, {2, 0}, {2, 1}, {1, 1}}),
                                   ring_of({{next, 0.3}, {1.5, 0.2}, {1.5, 0.8}})}}) {
    const Outcome outcome = examine(rings);
    EXPECT_EQ(outcome.verdict, Verdict::verified) << outcome.reasons[0];
  }
}

/// Their coordinates are rounded to more than an edge's length: a ragged, but a valid boundary.
TEST(Limits, PolygonsFarFromTheOriginAreVerified) {
  for (const double shift : {1e6, 1e9, 1e12}) {
    std::vector<Vec2> points;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n;
      points.push_back({shift + std::cos(angle), shift + std::sin(angle)});
    }
    const Outcome outcome = examine(std::vector{ring_of(points)});
    EXPECT_EQ(outcome.verdict, Verdict::verified) << shift << ": " << outcome.reasons[0];
  }
}

/// A keyhole 1e13 from the origin, whose head is an arc of nearly a full circle: rounding has moved
/// its neck's sides across each other, by less than build_shape() can see.
TEST(Limits, ArcsThatCrossByLessThanRoundingAreNamed) {
  const auto shape =
      build_shape(Rings{{{{3166498081406.5195, 16016884625326.006},
                          {3166498083933.3721, 16016884625011.492},
                          {3166498083933.4209, 16016884625011.887}},
                         RingRole::any,
                         {0.9999219897534104, 12818.328835894043, 0.9999219897534104}}});
  ASSERT_TRUE(shape) << to_string(shape.error());
  const auto axis = compute(*shape);
  ASSERT_FALSE(axis);
  EXPECT_EQ(axis.error().code, ErrorCode::crossing);
  EXPECT_NE(axis.error().text.find("crosses the edge that starts at vertex 2 of ring 0"),
            std::string::npos)
      << axis.error().text;
  EXPECT_EQ(axis.error().place.vertex, 0u);
  ASSERT_TRUE(axis.error().place.point);
  EXPECT_NEAR(axis.error().place.point->x, 3166498083933.4, 1);
}

}  // namespace
}  // namespace medial::test
