// Joints next to arcs that are almost smooth, and arcs that share a centre up to rounding: there
// double does not know which site a disk touches first, so compute() measures the axis.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "medial/medial.h"
#include "support/property.h"
#include "support/random_shapes.h"

namespace medial::test {
namespace {

void expect_verified(const Rings& rings, const Options& options = {.threads = 1}) {
  const auto shape = build_shape(rings);
  ASSERT_TRUE(shape) << to_string(shape.error());
  const auto axis = compute(*shape, options);
  ASSERT_TRUE(axis) << to_string(axis.error());
  const Certificate certificate = verify(*shape, *axis, {.threads = 1});
  EXPECT_TRUE(certificate.passed) << certificate.failures.front();
}

/// The sides of a slot lean by 1e-5, so that its end has the angle of a blunt joint: the edge
/// around the end's centre was off by 5e4 tolerances.
TEST(AlmostSmoothJoint, AtTheEndOfASlot) {
  expect_verified({{{{1.2483518959176966e-05, 9.883699877980862e-06},
                     {1.2483461548151041e-05, 9.883772390464996e-06},
                     {-0.620725748848253, 0.7840277705344926},
                     {-0.6207257488485679, 0.7840277705348901},
                     {-0.6207507158864863, 0.7840080031351342},
                     {-0.6207507158290753, 0.7840080030626216},
                     {-1.2483576370202891e-05, -9.883627365496728e-06},
                     {-1.2483518959176966e-05, -9.883699877980862e-06},
                     {9.883700637239881e-06, -1.2483519918152299e-05}},
                    RingRole::any,
                    {6.290388484181984e-11, 7.54731567220835e-11, 6.290388484181984e-11, 1,
                     6.290388484181984e-11, 7.54731567220835e-11, 6.290388484181984e-11,
                     0.41421356237309503, 0.41421356237309503}}});
}

TEST(AlmostSmoothJoint, OfAnEllipseThatIsAlmostACircle) {
  expect_verified(
      {{{{1, 0},
         {0.9999999953737583, 9.618982043086488e-05},
         {0.5000000000000001, 0.8660254037424682},
         {0.4999166948587981, 0.866073494646241},
         {-0.4999999999999998, 0.8660254037424683},
         {-0.5000833005149605, 0.8659773048258128},
         {-1, 1.2246467990880028e-16},
         {-0.9999999953737583, -9.618982043074238e-05},
         {-0.5000000000000004, -0.866025403742468},
         {-0.4999166948587984, -0.8660734946462407},
         {0.5000000000000001, -0.8660254037424682},
         {0.5000833005149607, -0.8659773048258127}},
        RingRole::any,
        {2.4047460010011313e-05, 0.26792341861244545, 2.4047455292206197e-05, 0.26792341860120145,
         2.404744997030368e-05, 0.26792341862369107, 2.4047460010072554e-05, 0.2679234186124454,
         2.4047455292417545e-05, 0.26792341860120167, 2.4047450258666403e-05, 0.267923418623691}}});
}

/// In 256 bits, too, the nodes near the end's centre would be one tie, but no disk touches all of
/// its sites: they stay apart.
TEST(AlmostSmoothJoint, KeepsNodesApartThatAreNoTie) {
  expect_verified({{{{0, -0.0015072444836314828},
                     {3.1711331316794496e-06, -0.0015072444836314828},
                     {3.2490414734021917, -0.001507244483666063},
                     {3.2490446445353234, -0.0015072444836314828},
                     {3.250551890903476, 1.884521543295864e-09},
                     {3.2490446445353234, 0.0015072444836314828},
                     {3.249044642824752, 0.0015072444836314828},
                     {1.0404687152840128e-07, 0.001507244483666063},
                     {0, 0.0015072444836314828}},
                    RingRole::any,
                    {-8.950588665704355e-07, -1.150908051088139e-08, -8.950588665704355e-07,
                     0.41421356237309503, 0.41421356237309503, -8.950588665704355e-07,
                     1.150908051088139e-08, -8.950588665704355e-07, 1}}});
}

/// An edge of a segment and an arc turns around the arc's centre between its ends.
TEST(AlmostSmoothJoint, AnEdgeIsFollowedAroundACentre) {
  expect_verified({{{{3.5999891102161214, -0.5358847478752341},
                     {2.559890391216008, 1.2799420497869194},
                     {2.559888752278117, 1.2799422155353122},
                     {2.559877310038211, 1.2799433726739795},
                     {2.559875671104781, 1.2799435384124007},
                     {1.3141362871161526, -0.6394254132057451},
                     {3.599989107618804, -0.5358847535437652}},
                    RingRole::any,
                    {0.5141633980394037, 1.4375772973366794e-06, 0, 1.437572344906194e-06,
                     0.610274043988717, 0.6102740439819697, 0}}});
}

/// A leaf in the centre of a circle with a narrow mouth: the feet of its disk are next to each
/// other, and the circle lies between them, not nothing.
TEST(AlmostSmoothJoint, ALeafOfACircleWithAMouth) {
  expect_verified({{{{-2.4431192860099356, 13.082339464491074},
                     {-2.4431141564090124, 13.082346304656033},
                     {-2.756880712329952, 13.317660534223098},
                     {-2.443124416280034, 13.082332624828004},
                     {-2.4431244162742978, 13.082332624835653}},
                    RingRole::any,
                    {-2.65888232707275e-06, 0.9999782005087425, 0.9999782005087556, 0.0,
                     -2.6588793520789677e-06}}});
  expect_verified(
      {{{{-100.00000063384665, -99.08161819883856},
         {-100.00000063368068, -99.08161819883856},
         {-99.99999924200904, -99.0816181988375},
         {-100, -98.9183818007732}},
        RingRole::any,
        {-4.5179405089314495e-11, 4.2627492664025436e-06, 0.9999953564939822, 0.999996117009265}}});
}

TEST(AlmostSmoothJoint, IsLeftToDisksByLee) {
  Options options{.method = method::Lee{}, .threads = 1};
  expect_verified({{{{5.259379083290482e-07, 0},
                     {9.709375034496542, 0},
                     {9.70937556043445, 5.259379083290482e-07},
                     {9.70937556043445, 1.9999994740620917},
                     {9.709375034496542, 2},
                     {5.259379083290482e-07, 2},
                     {0, 1.9999994740620917},
                     {0, 5.259379083290482e-07}},
                    RingRole::any,
                    {0, 0.41421356237309503, -1.9623042275087043e-06, 0.41421356237309503, 0.0,
                     0.41421356237309503, 0.0, 0.41421356237309503}},
                   {{{-14.971756557945056, 1}, {24.68113211837951, 1}}, RingRole::any, {1, 1}}},
                  options);
  expect_verified(
      {{{{1.7255733299437158e-06, -1.2639084357113017e-06},
         {1.7305477568730934e-06, -1.2571170114288479e-06},
         {0.5909056021891328, 0.8067406971694208},
         {0.5909056071635597, 0.8067407039608451},
         {0.5909021560168999, 0.8067432317777165},
         {0.5909021560151311, 0.8067432317753016},
         {-1.7255649420381543e-06, 1.2639198874476151e-06},
         {-1.7255733299437158e-06, 1.2639084357113017e-06},
         {-1.2639084433829342e-06, -1.7255733311284443e-06}},
        RingRole::any,
        {0, 0.0, 0.0, 0.9999926724812477, 0.0, 0.0, 0.0, 0.41421356237309503, 0.41421356237309503}},
       {{{-1.704556961278642, -1.5966381489715642},
         {2.295460842868872, -1.7966390391789402},
         {2.295460842868872, 2.4033796551759496},
         {-1.704556961278642, 2.4033796551759496}},
        RingRole::any,
        {0, 0.0, 0.0, 0}}},
      options);
}

/// A row of circles that are joined by necks from 1e-9 to 1e-2 of their radius. Each of them
/// consists of two arcs, above and below, of one circle up to rounding.
Ring row_of_circles(Random& random) {
  const auto count = static_cast<std::size_t>(random.integer(2, 6));
  std::vector<double> radius(count), neck(count + 1);
  for (double& r : radius) r = random.chance(0.5) ? 1 : random.between(0.3, 2);
  for (std::size_t i = 1; i < count; ++i)
    neck[i] = std::min(radius[i - 1], radius[i]) * random.power_of_ten(-9, -2);
  Ring below, ring;
  double x = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double r = radius[i], first = std::asin(neck[i] / r), last = std::asin(neck[i + 1] / r);
    below.points.push_back({x, -neck[i]});
    below.bulges.push_back(std::tan(0.25 * (std::numbers::pi - first - last)));
    x += r * (std::cos(first) + std::cos(last));
  }
  ring = below;
  for (std::size_t i = count; i-- > 0;) {
    const Vec2 end = i + 1 < count ? below.points[i + 1] : Vec2{x, 0};
    ring.points.push_back({end.x, -end.y});
    ring.bulges.push_back(below.bulges[i]);
  }
  return ring;
}

TEST(CirclesInARow, AreVerified) {
  const std::uint64_t count = shape_count(300, 20);
  for (std::uint64_t seed = 20261130000000; seed < 20261130000000 + count; ++seed) {
    Random random(seed);
    SCOPED_TRACE(seed);
    expect_verified({row_of_circles(random)});
  }
}

}  // namespace
}  // namespace medial::test
