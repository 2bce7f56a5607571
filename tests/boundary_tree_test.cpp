// The nearest of few and of many sites, straight and bent, as found by measuring all.

#include "site/boundary_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace medial::site {
namespace {

std::vector<Site> random_sites(std::mt19937& random, std::size_t count, bool arcs) {
  std::uniform_real_distribution<double> place(-0.5, 0.5), step(-0.2, 0.2), bulge(-0.4, 0.4);
  std::vector<Site> sites;
  for (Vec2 p{place(random), place(random)}; sites.size() < count;) {
    const Vec2 next = p + Vec2{step(random), step(random)};
    const int kind = std::uniform_int_distribution<int>(0, 2)(random);
    if (kind == 0)
      sites.push_back(make_vertex(p));
    else
      sites.push_back(kind == 1 && arcs ? make_arc(p, next, bulge(random)) : make_segment(p, next));
    p = std::max(std::abs(next.x), std::abs(next.y)) < 1 ? next : Vec2{0, 0};
  }
  return sites;
}

TEST(BoundaryTree, FindsTheNearestOfFewAndOfMany) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1), within(0, 1.5);
  for (const bool arcs : {false, true}) {
    for (const std::uint32_t count : {1U, 8U, 15U, 16U, 17U, 33U, 300U}) {
      const std::vector<Site> sites = random_sites(random, count, arcs);
      const BoundaryTree tree(sites);
      for (int query = 0; query < 200; ++query) {
        const Vec2 c{place(random), place(random)};
        const double reach = within(random);
        std::uniform_int_distribution<std::uint32_t> index(0, count - 1);
        const auto [first, last] = std::minmax({index(random), index(random)});
        double nearest = reach * reach;
        std::vector<std::uint32_t> near, found;
        for (std::uint32_t i = first; i <= last; ++i) {
          const double squared = squared_distance(sites[i], c);
          if (squared < reach * reach) near.push_back(i);
          nearest = std::min(nearest, squared);
        }
        const BoundaryTree::Hit hit = tree.nearest(c, reach, first, last);
        EXPECT_EQ(bool(hit), !near.empty());
        EXPECT_EQ(hit.squared_distance, nearest) << count << " " << arcs;
        tree.within(c, reach, first, last, found);
        EXPECT_EQ(found, near);
      }
    }
  }
}

}  // namespace
}  // namespace medial::site
