// The invariants of the medial axis over random polygons. MEDIAL_PROPERTY_COUNT: how many of them
// (20,000 without it); MEDIAL_PROPERTY_SEED: which (another number, other polygons).

#include "support/property.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "support/random_shapes.h"

namespace medial::test {
namespace {

/// The polygons are dealt out to several tests, which can run side by side.
constexpr std::uint64_t shares = 8;

class Polygons : public testing::TestWithParam<std::uint64_t> {
 protected:
  /// Calls `check` with this share of `count` shapes; stops after the third that fails, and says
  /// how to reproduce each.
  static void for_all(std::uint64_t count,
                      const std::function<std::vector<std::string>(const RandomShape&)>& check) {
    const std::uint64_t base = first_seed();
    int failed = 0;
    for (std::uint64_t i = GetParam(); i < count && failed < 3; i += shares) {
      const RandomShape shape = random_shape(base + i);
      const std::vector<std::string> failures = check(shape);
      if (failures.empty()) continue;
      ++failed;
      std::string text;
      for (const std::string& failure : failures) text += "  " + failure + "\n";
      ADD_FAILURE() << "random_shape(" << base + i << "), " << shape.kind << ":\n"
                    << text << to_wkt(shape.rings);
    }
  }
};

TEST_P(Polygons, AreVerified) {
  for_all(shape_count(1), [](const RandomShape& shape) { return check_axis(shape.rings); });
}

TEST_P(Polygons, KeepTheirAxisUnderSymmetries) {
  for_all(shape_count(10, shares), check_symmetries);
}

TEST_P(Polygons, HaveOneAxisForAnyNumberOfThreads) {
  for_all(shape_count(20, shares),
          [](const RandomShape& shape) { return check_threads(shape.rings); });
}

INSTANTIATE_TEST_SUITE_P(Random, Polygons, testing::Range<std::uint64_t>(0, shares));

/// Large enough for every fork of the walk.
struct Large {
  const char* name;
  Rings (*rings)();
};
void PrintTo(const Large& large, std::ostream* out) { *out << large.name; }

class LargeShapes : public testing::TestWithParam<Large> {};

TEST_P(LargeShapes, HaveOneAxisForAnyNumberOfThreads) {
  EXPECT_EQ(check_threads(GetParam().rings()), std::vector<std::string>{});
}

TEST_P(LargeShapes, AreVerified) {
  EXPECT_EQ(check_axis(GetParam().rings()), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Fixed, LargeShapes,
                         testing::Values(Large{"Blob", [] { return blob(20000); }},
                                         Large{"Regular", [] { return regular_polygon(20000); }},
                                         Large{"Maze", [] { return maze(20000); }},
                                         Large{"Comb", [] { return comb(5000); }},
                                         Large{"Holes", [] { return hole_grid(60); }},
                                         Large{"Nested", [] { return nested_squares(10000); }},
                                         Large{"JaggedStar", [] { return jagged_star(10000); }},
                                         Large{"Spiral", [] { return spiral(10000, 20); }}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(Generators, GiveTheSameShapeForTheSameSeed) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    EXPECT_EQ(to_wkt(random_shape(seed).rings), to_wkt(random_shape(seed).rings)) << seed;
  }
  EXPECT_NE(to_wkt(random_shape(1).rings), to_wkt(random_shape(2).rings));
}

TEST(Generators, GiveTheNumbersOfSplitmix64) {
  // The published sequence for seed 1234567.
  Random random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317u);
  EXPECT_EQ(random.next(), 3203168211198807973u);
}

}  // namespace
}  // namespace medial::test
