// Narrow slots, slits, wedges and rings: random shapes whose loops, or parts of one loop, come as
// near to each other as 1e-14 to 1e-6 of the size. Walls that gaps have cut out of one line stay in
// one line up to rounding. MEDIAL_PROPERTY_COUNT: half as many shapes (10,000 without it).

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

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

INSTANTIATE_TEST_SUITE_P(Random, NarrowGaps, testing::Range<std::uint64_t>(0, gap_shares));

}  // namespace
}  // namespace medial::test
