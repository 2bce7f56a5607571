// Narrow slots, slits, wedges and rings: random shapes whose loops, or parts of one loop, come as
// near to each other as 1e-14 to 1e-6 of the size. Walls that gaps have cut out of one line stay in
// one line up to rounding. MEDIAL_PROPERTY_COUNT: half as many shapes (10,000 without it).

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "base/arc.h"
#include "support/environment.h"
#include "support/nasty.h"
#include "support/property.h"

namespace medial::test {
namespace {

Rings narrow_shape(std::uint64_t seed) {
  Random random(seed);
  return narrow_gaps(random);
}

constexpr std::uint64_t gap_shares = 4;

class NarrowGaps : public testing::TestWithParam<std::uint64_t> {};

TEST_P(NarrowGaps, AreVerified) {
  const std::uint64_t count = test::shape_count(2);
  std::uint64_t valid = 0, unsupported = 0;
  for (std::uint64_t seed = GetParam(); seed < count; seed += gap_shares) {
    const Rings rings = narrow_shape(seed);
    const std::vector<std::string> failures = check_axis(rings);
    // Gaps so narrow that rounding has closed them.
    if (!failures.empty() && failures[0].starts_with("refused")) continue;
    ++valid;
    // Some tolerances wide, and named: not wrong. Counted below.
    if (!failures.empty() && failures[0].ends_with("[unsupported]")) {
      ++unsupported;
      continue;
    }
    EXPECT_EQ(failures, std::vector<std::string>{}) << "seed " << seed << ":\n" << to_wkt(rings);
  }
  EXPECT_GT(2 * valid, count / gap_shares);
  EXPECT_LE(unsupported, 1 + valid / 1000);
}

/// A hole's leftmost vertex next to a circle, whose quarters are sites of their own: the disk that
/// connects the two touches the right one.
TEST(NarrowGap, BesideEachQuarterOfACircle) {
  const Ring circle{{{1, 0}, {-1, 0}}, RingRole::any, {1, 1}};
  for (const double gap : {1e-6, 1e-8, 1e-10, 1e-12}) {
    for (int degrees = 95; degrees < 270; degrees += 10) {
      const double angle = degrees * std::numbers::pi / 180;
      const Vec2 tip = (1 - gap) * Vec2{std::cos(angle), std::sin(angle)};
      const Ring hole{{tip, {0, 0.25}, {0, -0.25}}, RingRole::any, {}};
      EXPECT_EQ(check_axis({circle, hole}), std::vector<std::string>{})
          << "gap " << gap << " at " << degrees << " degrees";
    }
  }
}

/// An arc and a segment that part at an angle and cross again where they are less than the
/// tolerance apart: the shape is the sliver behind. Where they are further apart, they cross.
TEST(NarrowGap, EdgesThatCrossBehindACusp) {
  for (const double slope : {1e-13, 1e-11, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5}) {
    const Ring ring{{{-2, -1}, {-1, -1}, {0, 0}, {-1, -slope}, {-2, 0}},
                    RingRole::any,
                    {0, 1 - std::numbers::sqrt2, 0, 0, 0}};
    const std::vector<std::string> failures = check_axis({ring});
    if (slope < 2e-7)
      EXPECT_EQ(failures, std::vector<std::string>{}) << slope;
    else
      EXPECT_TRUE(!failures.empty() && failures[0].ends_with("[crossing]")) << slope;
  }
}

/// A needle's short side is an arc of some tolerances, which crosses the sides beside it by less
/// than the tolerance, or the shape is refused: its rounded coordinates decide.
TEST(NarrowGap, NeedlesThatEndInAnArc) {
  struct Needle {
    double side, tilt, bulge;  ///< the short side, in 4e-15, and its angle to the upright
    std::array<double, 2> others;
  };
  constexpr std::array<Needle, 8> needles{{{16.3, -1.40725, -0.1865, {0, 0.00668}},
                                           {8.92, 1.24225, -0.3416, {0, 0}},
                                           {5.41, 1.00586, -1, {0.00256, 0}},
                                           {3.61, 1.23372, -0.7732, {0, 0}},
                                           {4.22, -0.798549, -1, {0, 0}},
                                           {11.4, -1.37586, -0.4006, {0, 0}},
                                           {2.16, 0, 1, {0, -1.375e-14}},
                                           {1.2, 0, 0.1961, {-1.018e-14, 0}}}};
  int accepted = 0;
  for (const Needle& needle : needles) {
    for (int pose = 0; pose < 8; ++pose) {
      const auto posed = [&](Vec2 p) {
        return turned(p, std::cos(0.7 * pose), std::sin(0.7 * pose));
      };
      const double side = 4e-15 * needle.side;
      const Ring ring{{{0, 0},
                       posed({1, 0}),
                       posed(side * Vec2{-std::sin(needle.tilt), std::cos(needle.tilt)})},
                      RingRole::any,
                      {needle.others[0], needle.others[1], needle.bulge}};
      const std::vector<std::string> failures = check_axis({ring});
      accepted += failures.empty() ? 1 : 0;
      const bool refused = !failures.empty() && (failures[0].ends_with("[crossing]") ||
                                                 failures[0].ends_with("[overlap]"));
      EXPECT_TRUE(failures.empty() || refused)
          << needle.side << " pose " << pose << ": " << failures[0];
    }
  }
  EXPECT_GE(accepted, 24);
}

/// Crescents between two almost equal, almost full circles: the middles of half circles decide
/// which arc lies inside at a tip, and a chord's length does not give these to all digits.
TEST(NarrowGap, OfCrescentsOfAlmostFullCircles) {
  struct Crescent {
    Vec2 tip;
    double outer, inner;
  };
  for (const Crescent& crescent :
       {Crescent{
            {2.5023580635925422e-05, 0.000212992315731372}, 674819.6475585127, -674819.6475611577},
        Crescent{{1, 0}, 22025.18275097196, -22025.18275097258},
        // Other directions: the arcs lie together from a tip to beyond their lowest points.
        Crescent{{0, 1}, 22025.18275097196, -22025.18275097258},
        Crescent{{-1, 0}, 22025.18275097196, -22025.18275097258},
        Crescent{{0, -1}, 22025.18275097196, -22025.18275097258},
        Crescent{{1, 0}, 6278.434989622477, -6278.434989621985}}) {
    const Ring ring{{{0, 0}, crescent.tip}, RingRole::any, {crescent.outer, crescent.inner}};
    EXPECT_EQ(check_axis({ring}), std::vector<std::string>{}) << crescent.outer;
  }
}

/// A hole's vertex, from which a disk connects it to others, is next to another one: what such a
/// disk seems to touch first in double it does not touch.
TEST(NarrowGap, BetweenVerticesOfTwoHoles) {
  for (const double y : {1 - 0x1p-52, 1 - 0x1p-50, 1 - 0x1p-40, 1 - 0x1p-30}) {
    const Rings rings{rectangle(5, 5)[0],
                      triangle({4, 2}, {3, 1}, {3, 2})[0],
                      {{{3, y}, {1, 4}, {2, 4}, {2, 3}}, RingRole::any, {}}};
    EXPECT_EQ(check_axis(rings), std::vector<std::string>{}) << y;
  }
}

INSTANTIATE_TEST_SUITE_P(Random, NarrowGaps, testing::Range<std::uint64_t>(0, gap_shares));

}  // namespace
}  // namespace medial::test
