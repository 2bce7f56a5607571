// Likeness: nothing for images of a shape, and more for other shapes.
#include <gtest/gtest.h>

#include "medial/compute.h"
#include "medial/features.h"
#include "support/computed.h"
#include "support/random_shapes.h"

namespace medial {
namespace {

const std::uint64_t match_count = test::shape_count(100);

using test::RandomShape;
using test::Rings;

ShapeSignature sign(const Rings& rings) {
  const auto shape = build_shape(rings);
  EXPECT_TRUE(shape.ok());
  const auto axis = compute(*shape);
  EXPECT_TRUE(axis.ok());
  return signature_of(*axis, describe(*axis));
}

TEST(Match, ImagesOfAShapeAreTheSame) {
  std::size_t checked = 0;
  for (std::uint64_t seed = 0; seed < match_count; ++seed) {
    const RandomShape random = test::random_any(seed);
    if (!random.rigid) continue;  // contacts and needles are others once coordinates are rounded
    const ShapeSignature one = sign(random.rings);
    EXPECT_EQ(dissimilarity(one, one), 0);
    for (const std::size_t i : {1U, 3U, 6U, 7U, 8U}) {  // turned, scaled, mirrored, written again
      SCOPED_TRACE(random.kind + " " + std::to_string(seed) + " " + test::symmetries()[i].name);
      // The places of pairs are taken along the axis in the order of its edges.
      EXPECT_LE(dissimilarity(one, sign(test::symmetric(random.rings, i))), 0.03);
      ++checked;
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(checked, 0U);
}

TEST(Match, SpecksAreLeftOut) {
  Rings rings = test::rectangle(10, 10);
  rings.push_back(test::circle({3, 3}, 0.2));
  rings.push_back(test::circle({6, 6}, 2));
  rings.push_back(test::circle({13, 3}, 0.2));
  const auto shape = build_shape(rings);
  ASSERT_TRUE(shape.ok());
  ASSERT_EQ(shape->loop_count(), 4U);
  const Shape kept = without_specks(*shape);
  EXPECT_EQ(kept.loop_count(), 2U);
  EXPECT_EQ(kept.component_count(), 1U);
  EXPECT_EQ(kept.hole_count(), 1U);
  const auto axis = compute(kept);
  ASSERT_TRUE(axis.ok());
  EXPECT_EQ(describe(*axis).cycles, 1U);
}

TEST(Match, TellsShapesApart) {
  const ShapeSignature star = sign(test::blob(500));
  const ShapeSignature bar = sign(test::rectangle(10, 1));
  const ShapeSignature longer = sign(test::rectangle(11, 1));
  const ShapeSignature cross = sign(test::cross_shape(1));
  EXPECT_LT(dissimilarity(bar, longer), 0.3 * dissimilarity(bar, cross));
  EXPECT_LT(dissimilarity(bar, longer), 0.3 * dissimilarity(bar, star));
  EXPECT_EQ(dissimilarity(bar, cross), dissimilarity(cross, bar));
}

TEST(Match, NeedlesAreComparedToo) {
  const ShapeSignature bar = sign(test::rectangle(1, 1e-9));
  const ShapeSignature thinner = sign(test::rectangle(1, 1e-10));
  const ShapeSignature wedge = sign({test::ring_of({{0, 0}, {1, 0}, {0.5, 1e-10}})});
  const ShapeSignature square = sign(test::rectangle(1, 1));
  for (const ShapeSignature& one : {bar, thinner, wedge}) EXPECT_EQ(dissimilarity(one, one), 0);
  EXPECT_GT(dissimilarity(bar, thinner), 0);
  EXPECT_LT(dissimilarity(bar, thinner), dissimilarity(bar, wedge));
  EXPECT_LT(dissimilarity(bar, wedge), dissimilarity(square, wedge));
}

TEST(Match, SizesDoNotMatter) {
  for (const double size : {1e-90, 1e90}) {
    SCOPED_TRACE(size);
    EXPECT_LE(dissimilarity(sign(test::rectangle(3, 1)), sign(test::rectangle(3 * size, size))),
              1e-9);
  }
}

TEST(Match, FullDisksAreToldApart) {
  // Their axes are points, without a length to count by.
  const auto disks = [](int count) {
    test::Rings rings;
    for (int i = 0; i < count; ++i) {
      Ring& ring = rings.emplace_back();
      ring.points = {{3.0 * i - 1, 0}, {3.0 * i + 1, 0}};
      ring.bulges = {1, 1};
    }
    return sign(rings);
  };
  EXPECT_GT(dissimilarity(disks(1), disks(3)), 0.5);
  EXPECT_GT(dissimilarity(disks(3), disks(12)), 0.5);
}

TEST(Match, NoiseHardlyCounts) {
  // A bar with small teeth all along one side is nearer to the bar than a bar a third shorter.
  Ring teeth;
  teeth.points = {{0, 0}, {10, 0}, {10, 1}};
  for (int i = 40; i > 0; --i) {
    teeth.points.push_back({0.25 * i - 0.125, 1.03});
    teeth.points.push_back({0.25 * (i - 1), 1});
  }
  const ShapeSignature bar = sign(test::rectangle(10, 1));
  EXPECT_LT(dissimilarity(bar, sign({teeth})), dissimilarity(bar, sign(test::rectangle(6.7, 1))));
}

}  // namespace
}  // namespace medial
