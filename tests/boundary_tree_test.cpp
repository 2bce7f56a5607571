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

// Boxes along a row of holes lie in double precision at what disks all but touch that are far
// larger.
TEST(BoundaryTree, FindsTheNearestInRowsOfHolesFromFarAway) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> size(0.2, 0.7), turn(0, 1.5), place(0, 1);
  const Site cut = make_vertex({1e30, 1e30});
  constexpr std::uint32_t holes = 800;
  for (const bool are_equal : {true, false}) {
    const double angle = turn(random), spacing = 1e-5;
    const Vec2 along{std::cos(angle), std::sin(angle)}, up = left_of(along);
    std::vector<Site> sites;
    for (std::uint32_t i = 0; i < holes; ++i) {
      const double side = spacing * (are_equal ? 0.5 : size(random));
      const Vec2 a = (i * spacing) * along, b = a + side * along;
      for (const auto& [from, to] : {std::pair{a - side * up, a}, {a, b}, {b, b - side * up}}) {
        sites.push_back(make_vertex(from));
        sites.push_back(make_segment(from, to));
      }
      sites.push_back(cut);
    }
    const auto last = static_cast<std::uint32_t>(sites.size() - 1);
    const BoundaryTree tree(sites);
    for (int query = 0; query < 200; ++query) {
      const Vec2 foot = (holes * spacing * place(random)) * along;
      const double height = 0.9 * place(random);
      const Vec2 c = foot + (query % 3 == 0 ? -height : height) * up;
      double nearest = 4;
      for (const Site& site : sites) nearest = std::min(nearest, squared_distance(site, c));
      for (const double reach : {1.5, std::sqrt(nearest) * (1 + 1e-14), std::sqrt(nearest) + 1e-9})
        EXPECT_EQ(tree.nearest(c, reach, 0, last).squared_distance, nearest) << are_equal;
      EXPECT_FALSE(tree.nearest(c, std::sqrt(nearest) * (1 - 1e-14), 0, last));
    }
  }
}

}  // namespace
}  // namespace medial::site
