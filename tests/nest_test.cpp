// Bays paired with peninsulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "medial/features.h"

namespace medial {
namespace {

Shape shape_of(std::vector<Vec2> points) {
  Ring ring;
  ring.points = std::move(points);
  return *build_shape(std::vector<Ring>{ring});
}
/// A block with a slot from above that narrows from 24 to 16, and a T whose stem is 14 to 20 wide.
Shape slotted() {
  return shape_of({{0, 0}, {60, 0}, {60, 40}, {42, 40}, {38, 12}, {22, 12}, {18, 40}, {0, 40}});
}
Shape tee() {
  return shape_of({{0, 0}, {14, 0}, {17, 30}, {45, 33}, {45, 47}, {-28, 47}, {-28, 33}, {-3, 30}});
}

/// Both shapes as one make a shape: nothing crosses, and the areas add up.
void expect_apart(const Shape& fixed, const Shape& moved) {
  std::vector<Ring> rings = rings_of(fixed);
  for (Ring& ring : rings_of(moved)) rings.push_back(ring);
  const auto both = build_shape(rings);
  ASSERT_TRUE(both.ok());
  EXPECT_NEAR(area(*both), area(fixed) + area(moved), 1e-6);
}

TEST(Nest, APegGoesIntoItsSlot) {
  const Shape block = slotted(), peg = tee();
  for (const bool swapped : {false, true}) {
    const Shape &fixed = swapped ? peg : block, &moving = swapped ? block : peg;
    const auto found = nest(fixed, moving);
    ASSERT_TRUE(found.ok());
    ASSERT_FALSE(found->empty());
    // The stem is 30 long and 17 wide, and goes in all but a little.
    EXPECT_GT(found->front().saved, 700);
    EXPECT_TRUE(std::is_sorted(found->begin(), found->end(),
                               [](const auto& a, const auto& b) { return a.saved > b.saved; }));
    for (const Placement& at : *found) {
      EXPECT_GT(at.gap, 0);
      expect_apart(fixed, *placed(moving, at));
    }
  }
}

/// Tips can cross with no vertex of one inside the other.
TEST(Nest, TipsDoNotCross) {
  const Shape star = shape_of({{5.5348351132940143, 0},
                               {0.9328116144643559, 0.53855903671420513},
                               {0.76068198969608969, 1.317539854556212},
                               {0, 3.9824677247567033},
                               {-2.4150291602544218, 4.1829532073210611},
                               {-1.7949216845707761, 1.0362985177612338},
                               {-2.1113672570623505, 0},
                               {-4.7567690165456975, -2.7463218721755278},
                               {-1.929464164580728, -3.3419299644372549},
                               {0, -3.5271674201661121},
                               {0.50953768162406776, -0.88254515294373981},
                               {3.6890372884022109, -2.129866671509586}});
  const Shape other = shape_of({{4.3245174254401189, 0},
                                {3.3608195314679619, 3.3608195314679614},
                                {0, 1.1037935690037004},
                                {-2.7059733914598869, 2.7059733914598869},
                                {-2.7733861424137012, 0},
                                {-0.71032918602674866, -0.71032918602674844},
                                {0, -4.49081635441551},
                                {1.3516559626394442, -1.3516559626394449}});
  const auto found = nest(star, other);
  ASSERT_TRUE(found.ok());
  ASSERT_FALSE(found->empty());
  for (const Placement& at : *found) expect_apart(star, *placed(other, at));
}

TEST(Nest, KeepsAGapAndDoesNotMirrorUnasked) {
  const auto found = nest(slotted(), tee(), 1, false, 1);
  ASSERT_TRUE(found.ok());
  ASSERT_EQ(found->size(), 1U);
  EXPECT_GE(found->front().gap, 1);
  EXPECT_FALSE(found->front().mirrored);
}

/// Branches around holes and between them are no peninsulas: with and without holes the same legs
/// go into the same bays.
TEST(Nest, HolesDoNotHidePeninsulas) {
  const std::vector<Vec2> outline{{0, 0},   {2, 0},  {2, 4}, {8, 4}, {8, 0},  {10, 0},
                                  {10, 10}, {8, 10}, {8, 6}, {2, 6}, {2, 10}, {0, 10}};
  std::vector<Ring> rings(3);
  rings[0].points = outline;
  rings[1].points = {{3.2, 4.4}, {3.2, 5.4}, {4.2, 5.4}, {4.2, 4.4}};
  rings[2].points = {{6.2, 4.4}, {6.2, 5.4}, {7.2, 5.4}, {7.2, 4.4}};
  const Shape holed = *build_shape(rings);
  const auto plain = nest(shape_of(outline), shape_of(outline)), found = nest(holed, holed);
  ASSERT_TRUE(plain.ok() && found.ok());
  ASSERT_FALSE(plain->empty() || found->empty());
  EXPECT_GT(found->front().saved, 16);  // of the 24 of a bay
  EXPECT_NEAR(found->front().saved, plain->front().saved, 0.05 * plain->front().saved);
  expect_apart(holed, *placed(holed, found->front()));
}

TEST(Nest, RefusesWhatCannotBe) {
  for (const double gap : {-1.0, std::nan(""), HUGE_VAL})
    EXPECT_EQ(nest(slotted(), tee(), gap).error().code, ErrorCode::invalid_option) << gap;
  std::vector<Ring> rings(2);
  rings[0].points = {{0, 0}, {1, 0}, {0, 1}};
  rings[1].points = {{5, 0}, {6, 0}, {5, 1}};
  const Shape two = *build_shape(rings);
  EXPECT_EQ(nest(two, tee()).error().place.feature, 0U);
  EXPECT_EQ(nest(tee(), two).error().place.feature, 1U);
  Placement far;
  far.move = {1e120, 0};
  EXPECT_FALSE(placed(tee(), far).ok());  // all of it is one point there
}

TEST(Nest, ConvexShapesHaveNoBays) {
  const Shape square = shape_of({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  const auto found = nest(square, square);
  ASSERT_TRUE(found.ok());
  EXPECT_TRUE(found->empty());
}

TEST(Nest, APlacementMirrorsTurnsAndMoves) {
  const Shape shape = shape_of({{0, 0}, {4, 0}, {0, 1}});
  const Shape moved = *placed(shape, {.angle = std::acos(0.0), .mirrored = true, .move = {5, 5}});
  EXPECT_NEAR(area(moved), area(shape), 1e-12);
  const Box box = bounding_box(moved);
  EXPECT_NEAR(box.low.x, 4, 1e-12);
  EXPECT_NEAR(box.low.y, 1, 1e-12);
}

}  // namespace
}  // namespace medial
