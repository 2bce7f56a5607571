// The tree that connects holes, against looking at every site.

#include "site/first_touch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/spatial_order.h"
#include "site/tangent_disk.h"
#include "support/generate.h"

namespace medial::test {
namespace {

std::vector<site::Site> random_sites(Random& random, std::size_t count) {
  std::vector<site::Site> sites;
  const auto point = [&] { return Vec2{random.between(-1, 1), random.between(-1, 1)}; };
  while (sites.size() < count) {
    const Vec2 a = point(), b = random.chance(0.2)
                                    ? point()
                                    : a + random.power_of_ten(-4, -1) * (point() - Vec2{0.1, 0});
    switch (random.integer(0, 2)) {
      case 0:
        sites.push_back(site::make_vertex(a));
        break;
      case 1:
        sites.push_back(site::make_segment(a, b));
        break;
      default:
        sites.push_back(
            site::make_arc(a, b, random.between(-site::largest_bulge, site::largest_bulge)));
    }
  }
  return sites;
}

TEST(FirstTouch, FindsWhatLookingAtEverySiteFinds) {
  Random random(1);
  for (const std::size_t count : {1U, 7U, 8U, 33U, 500U, 5000U}) {
    const std::vector<site::Site> sites = random_sites(random, count);
    std::vector<std::uint32_t> groups;
    for (std::size_t i = 0; i < count; ++i)
      groups.push_back(static_cast<std::uint32_t>(random.integer(0, 2)));
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0U);
    const site::FirstTouch tree(sites, all, groups);
    for (int i = 0; i < 200; ++i) {
      const Vec2 foot{random.between(-1, 1), random.between(-1, 1)};
      const double angle = random.between(0, 7), largest = random.power_of_ten(-3, 0);
      const Vec2 direction{std::cos(angle), std::sin(angle)};
      const auto first =
          static_cast<std::uint32_t>(random.integer(0, static_cast<std::int64_t>(count) - 1));
      const std::uint32_t last = first + 3, group = groups[first];
      double smallest = largest;
      for (std::uint32_t k = 0; k < count; ++k)
        if (groups[k] == group && (k < first || k > last))
          smallest = std::min(smallest, site::touching_radius(foot, direction, sites[k]));
      const auto touch = tree.find(foot, direction, largest, group, first, last);
      EXPECT_EQ(touch.has_value(), smallest < largest) << count << " sites";
      if (!touch) continue;
      EXPECT_NEAR(touch->radius, smallest, 1e-14);
      EXPECT_EQ(groups[touch->site], group);
      EXPECT_TRUE(touch->site < first || touch->site > last);
    }
  }
}

/// How many edges a disk may touch that grows from the origin along the x axis.
std::uint32_t touched(const std::vector<site::Site>& sites) {
  const std::vector<std::uint32_t> groups(sites.size());
  std::vector<std::uint32_t> all(sites.size());
  std::iota(all.begin(), all.end(), 0U);
  constexpr std::uint32_t nothing = ~std::uint32_t{0};
  const auto touch =
      site::FirstTouch(sites, all, groups).find({0, 0}, {1, 0}, 1, 0, nothing, nothing);
  return touch ? touch->count : 0;
}

TEST(FirstTouch, CountsTheEdgesThatMayBeTouched) {
  const auto segment = [](Vec2 a, Vec2 b) { return site::make_segment(a, b); };
  const auto above = segment({0.7, 0.4}, {0.2, 0.4}), below = segment({0.2, -0.4}, {0.7, -0.4});
  EXPECT_EQ(touched({above}), 1U);
  EXPECT_EQ(touched({above, site::reversed(above)}), 1U);
  EXPECT_EQ(touched({above, below}), 2U);
  EXPECT_EQ(touched({above, segment({0.2, -0.4 - 1e-12}, {0.7, -0.4 - 1e-12})}), 1U);
  EXPECT_EQ(touched({above, segment({0.2, -0.4 - 1e-16}, {0.7, -0.4 - 1e-16})}), 2U);
  // The end of two edges is touched.
  EXPECT_EQ(touched({segment({0.8, 0.1}, {0.5, 0}), segment({0.5, 0}, {0.8, -0.1})}), 2U);
  // A line nearly along the disk's tangent at the origin leaves the radius open.
  EXPECT_EQ(touched({segment({-0.0050125, -1}, {0.005, 1})}), site::FirstTouch::many);
}

TEST(ZOrder, IsAPermutationThatKeepsNeighboursTogether) {
  EXPECT_TRUE(z_order({}).empty());
  EXPECT_EQ(z_order(std::vector<Vec2>(3, Vec2{1e-100, 2})), (std::vector<std::uint32_t>{0, 1, 2}));
  Random random(2);
  std::vector<Vec2> points(4096);
  for (Vec2& point : points) point = {random.between(3, 4), random.between(-1e-3, 0)};
  std::vector<std::uint32_t> order = z_order(points);
  double way = 0;
  for (std::size_t i = 1; i < order.size(); ++i)
    way += distance(points[order[i - 1]], points[order[i]]);
  EXPECT_LT(way, 30);  // in random order about 1365
  std::sort(order.begin(), order.end());
  for (std::uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
}

}  // namespace
}  // namespace medial::test
