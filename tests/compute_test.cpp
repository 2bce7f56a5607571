// The guarantees of compute() about its options.

#include "medial/compute.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <vector>

#include "medial/verify.h"
#include "support/generate.h"
#include "support/random_shapes.h"

namespace medial::test {
namespace {

// Along a smooth boundary one search answers for the disks of many events, also where the way from
// each to the next is so short that they touch the same within the tolerance.
TEST(Compute, AsksForRunsOfEventsAtOnce) {
  const Shape shape = *build_shape(blob(20000));
  for (const double tolerance : {0.0, 1e-11}) {
    const auto axis = compute(shape, {.tolerance = tolerance});
    ASSERT_TRUE(axis.ok());
    EXPECT_LT(axis->statistics.queries, 15000U) << tolerance;
    EXPECT_TRUE(verify(shape, *axis).passed);
  }
}

TEST(Compute, IsCancelledBeforeItBegins) {
  const Shape shape = *build_shape(hole_grid(10));
  const std::atomic<bool> cancel = true;
  const auto axis = compute(shape, {.cancel = &cancel});
  ASSERT_FALSE(axis.ok());
  EXPECT_EQ(axis.error().code, ErrorCode::cancelled);
}

TEST(Compute, IsCancelledOnTheWay) {
  const Shape shape = *build_shape(maze(100000));
  for (const int threads : {1, 4}) {
    std::atomic<bool> cancel = false;
    std::atomic<int> calls = 0;
    const auto axis = compute(shape, {.threads = threads,
                                      .progress =
                                          [&](double) {
                                            ++calls;
                                            cancel = true;
                                          },
                                      .cancel = &cancel});
    ASSERT_FALSE(axis.ok());
    EXPECT_EQ(axis.error().code, ErrorCode::cancelled);
    EXPECT_GT(calls, 0);
  }
}

TEST(Compute, TellsItsProgress) {
  const Shape shape = *build_shape(maze(100000));
  std::mutex mutex;
  std::vector<double> shares;
  const auto axis = compute(shape, {.progress = [&](double share) {
                              const std::lock_guard lock(mutex);
                              shares.push_back(share);
                            }});
  ASSERT_TRUE(axis.ok());
  ASSERT_GT(shares.size(), 2U);
  EXPECT_EQ(shares.back(), 1);
  for (const double share : shares) {
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
  }
}

TEST(Compute, RefusesOptionsOutOfRange) {
  const Shape shape = *build_shape(rectangle(2, 1));
  for (const Options& options :
       std::vector<Options>{{.tolerance = -1},
                            {.tolerance = 0.1},
                            {.tolerance = std::nan("")},
                            {.threads = -1},
                            {.threads = 1025},
                            {.method = method::Ridge{}, .exact = true},
                            {.method = method::Brushfire{}, .exact = true},
                            {.method = method::Potential{}, .exact = true}}) {
    const auto axis = compute(shape, options);
    ASSERT_FALSE(axis.ok());
    EXPECT_EQ(axis.error().code, ErrorCode::invalid_option);
  }
}

/// Shapes that build_shape() never makes are no reason to crash.
TEST(Compute, RefusesHandMadeShapes) {
  const Shape shape = *build_shape(
      std::vector<Ring>{{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}}, {{{3, 3}, {6, 3}, {6, 6}, {3, 6}}}});
  ASSERT_TRUE(compute(shape).ok());
  const auto expect_malformed = [](const Shape& broken) {
    const auto axis = compute(broken);
    ASSERT_FALSE(axis.ok());
    EXPECT_EQ(axis.error().code, ErrorCode::malformed);
  };
  Shape broken = shape;
  broken.component[1] = 1;  // there is only component 0
  expect_malformed(broken);
  broken = shape;
  broken.hole[0] = true;  // nothing bounds the component
  expect_malformed(broken);
  broken = shape;
  broken.points[5] = broken.points[4];
  expect_malformed(broken);
}

/// Slots of 2e-10 of the size beside each other: of their walls, which lie in one line up to
/// rounding, a large disk cannot tell which it touches.
TEST(Compute, NarrowSlotsBesideEachOtherAreVerified) {
  const Shape shape = *build_shape(std::vector<Ring>{
      {{{0.0, -0.0},
        {0.4413905073457558, -0.12134809270866588},
        {0.32004241463709, -0.5627386000544217},
        {-0.12134809270866588, -0.4413905073457558}}},
      {{{0.2750581678794278, -0.07561962386287054},
        {0.3074792139147724, -0.173548855578783},
        {0.22955263311367805, -0.24114106411752895},
        {0.19713158707833345, -0.14321183240161653}}},
      {{{-0.015168511407395793, -0.05517381346803195},
        {0.04000530182963625, -0.07034232500680271},
        {-0.005500232936113461, -0.23586376526146113},
        {-0.0606740461731455, -0.2206952537226904}}},
      {{{-0.06067404622295797, -0.22069525390387784},
        {-0.005500232985925928, -0.23586376544264864},
        {-0.03583725611327994, -0.34621139209790014},
        {-0.09101106935031197, -0.3310428805591294}}},
  });
  const auto axis = compute(shape);
  ASSERT_TRUE(axis) << to_string(axis.error());
  EXPECT_TRUE(verify(shape, *axis).passed);
}

/// An L with rounded convex corners begins at its reflex vertex; beside it are two holes, so that
/// for some directions the disks that connect them touch that vertex.
/// A disk that grows in a wedge may go further than its box is wide before it touches anything.
TEST(Compute, WedgesLongerThanTheirBoxIsWideAreVerified) {
  const std::vector<Vec2> known{{6, -5}, {5, -3}, {8, -15}, {8, 0}};
  const auto axis = compute(*build_shape(Rings{ring_of(known)}));
  ASSERT_TRUE(axis.ok()) << to_string(axis.error());
  EXPECT_EQ(axis->nodes.size(), 6U);
  std::size_t valid = 0;
  for (std::uint64_t seed = 0; seed < shape_count(5); ++seed) {
    Random random(seed);
    const double narrow = 0x1p-12 * static_cast<double>(std::uint64_t{1} << (seed % 13));
    std::vector<Vec2> points(static_cast<std::size_t>(random.integer(4, 6)));
    for (Vec2& p : points)
      p = {narrow * static_cast<double>(random.integer(-8, 8)),
           static_cast<double>(random.integer(-8, 8))};
    const auto shape = build_shape(Rings{ring_of(points)});
    if (!shape) continue;  // it crosses itself
    ++valid;
    const auto found = compute(*shape);
    ASSERT_TRUE(found.ok()) << seed << to_string(found.error());
    ASSERT_TRUE(verify(*shape, *found).passed) << seed;
  }
  EXPECT_GT(valid, shape_count(100));
}

/// A vertex that all but touches an edge: a gap of less than rounding.
TEST(Compute, RadiiAreNotBelowZero) {
  const auto shape = *build_shape(Rings{ring_of({{3.8180434037188689, 4},
                                                 {3.1817028364323905, 3},
                                                 {-2.5453622691459126, -2},
                                                 {-2.5453622691459126, -6}})});
  const auto axis = compute(shape);
  ASSERT_TRUE(axis.ok()) << to_string(axis.error());
  for (const Node& node : axis->nodes) EXPECT_GE(node.disk.radius, 0);
  EXPECT_TRUE(verify(shape, *axis).passed);
}

TEST(Compute, HolesBesideTheOnlyVertexOfTheOuterLoop) {
  const double round = std::tan(std::numbers::pi / 8);
  const std::vector<Vec2> outer = {{4, 2},   {20, 2}, {22, 4}, {22, 8}, {20, 10}, {10, 10},
                                   {10, 20}, {8, 22}, {4, 22}, {2, 20}, {2, 4}};
  const std::vector<double> bulges = {0, round, 0, round, 0, 0, round, 0, round, 0, round};
  for (int degrees = 0; degrees < 360; degrees += 15) {
    const double angle = degrees * std::numbers::pi / 180;
    const auto turn = [&](std::vector<Vec2> points) {
      for (Vec2& p : points)
        p = {p.x * std::cos(angle) - p.y * std::sin(angle),
             p.x * std::sin(angle) + p.y * std::cos(angle)};
      return points;
    };
    const std::vector<Ring> rings = {Ring{turn(outer), RingRole::any, bulges},
                                     Ring{turn({{4, 10}, {4, 14}, {8, 14}, {8, 10}})},
                                     Ring{turn({{10, 4}, {10, 8}, {14, 8}, {14, 4}})}};
    const auto shape = build_shape(rings);
    ASSERT_TRUE(shape) << degrees << ": " << to_string(shape.error());
    const auto axis = compute(*shape);
    ASSERT_TRUE(axis) << degrees << ": " << to_string(axis.error());
    EXPECT_TRUE(verify(*shape, *axis).passed) << degrees;
  }
}

}  // namespace
}  // namespace medial::test
