// The nearest of few and of many sites, straight and bent, as found by measuring all.

#include "site/boundary_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <tuple>
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

// Points at the distances 5 and 13 of the origin, which integers state exactly, in many blocks.
TEST(BoundaryTree, OfEqualDistancesFindsTheFirstAndNoneAtTheReach) {
  constexpr double unit = 0x1p-6;
  const std::vector<Vec2> near{{3, 4}, {-4, 3}, {0, -5}, {5, 0}}, far{{5, 12}, {-12, 5}, {0, 13}};
  for (const std::size_t first : {0U, 5U, 40U, 99U, 300U}) {
    std::vector<Site> sites;
    for (std::size_t i = 0; i < 400; ++i) {
      const bool is_near = i >= first && (i - first) % 50 == 0;
      const std::vector<Vec2>& some = is_near ? near : far;
      sites.push_back(make_vertex(unit * some[i % some.size()]));
    }
    const BoundaryTree tree(sites);
    EXPECT_EQ(tree.nearest({0, 0}, 1).site, first);
    EXPECT_EQ(tree.nearest({0, 0}, 1).squared_distance, 25 * unit * unit);
    EXPECT_FALSE(tree.nearest({0, 0}, 5 * unit));
    EXPECT_EQ(tree.nearest({0, 0}, std::nextafter(5 * unit, 1)).site, first);
    std::vector<std::uint32_t> found;
    tree.within({0, 0}, 5 * unit, 0, 399, found);
    EXPECT_TRUE(found.empty());
    tree.within({0, 0}, 13 * unit, 0, 399, found);
    ASSERT_EQ(found.size(), (399 - first) / 50 + 1);
    EXPECT_EQ(found.front(), first);
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

/// Sites along a spiral with so many corners in a turn, or along slots of this slant, with cuts.
std::vector<Site> windings(std::size_t corners, double slant, double bulge) {
  std::vector<Site> sites;
  constexpr std::size_t count = 900;
  Vec2 before;
  for (std::size_t i = 0; i < count; ++i) {
    const auto share = static_cast<double>(i) / count;
    Vec2 p;
    if (corners > 0) {
      const double angle = 0.3 + 2 * std::numbers::pi * static_cast<double>(i % corners) /
                                     static_cast<double>(corners);
      p = (0.1 + 0.8 * share) * Vec2{std::cos(angle), std::sin(angle)};
    } else {
      const double height = i / 2 % 2 == 0 ? -0.7 : 0.7;
      p = {0.8 * share - 0.4 + slant * height, height};
    }
    if (i % 50 == 49) sites.push_back(make_vertex({1e30, 1e30}));
    if (i > 0 && i % 3 == 0) sites.push_back(make_vertex(before));
    if (i > 0) sites.push_back(bulge == 0 ? make_segment(before, p) : make_arc(before, p, bulge));
    before = p;
  }
  return sites;
}

// Boxes of a boundary that winds around itself lie upon each other: sites are ordered in the plane.
// Around slots, only those along the axes do.
TEST(BoundaryTree, FindsTheNearestOfWindings) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> place(-1, 1);
  for (const auto& [corners, slant, bulge] :
       {std::tuple{4, 0.0, 0.0}, {3, 0.0, 0.05}, {60, 0.0, 0.0}, {0, 1.0, 0.0}, {0, 0.5, -0.01}}) {
    const std::vector<Site> sites = windings(static_cast<std::size_t>(corners), slant, bulge);
    const BoundaryTree tree(sites);
    std::uniform_int_distribution<std::size_t> index(0, sites.size() - 1);
    std::vector<std::uint32_t> near, found;
    for (int query = 0; query < 300; ++query) {
      const bool on_site = query % 3 == 0;  // then its lowest copy is asked for
      const Site& some = sites[index(random)];
      const Vec2 c = on_site && is_inside(some) ? some.point : Vec2{place(random), place(random)};
      const double reach = query % 2 == 0 ? 0.01 : 0.5;
      const auto [from, to] = std::minmax({index(random), index(random)});
      const auto first = static_cast<std::uint32_t>(from), last = static_cast<std::uint32_t>(to);
      double least = reach * reach;
      near.clear();
      for (std::uint32_t i = 0; i < sites.size(); ++i) {
        const double squared = squared_distance(sites[i], c);
        if (!(squared < reach * reach)) continue;
        near.push_back(i);
        if (i >= first && i <= last) least = std::min(least, squared);
      }
      const auto hit = tree.nearest(c, reach, first, last);
      EXPECT_EQ(hit.squared_distance, least);
      for (const std::uint32_t i : near) {
        if (i >= first && i <= last && squared_distance(sites[i], c) == least) {
          EXPECT_EQ(hit.site, i);
          break;
        }
      }
      EXPECT_NEAR(tree.nearest_facing(c, reach, first, last).squared_distance, least, 1e-13);
      if (least > 0) {
        EXPECT_FALSE(tree.nearest(c, std::sqrt(least) * (1 - 1e-14), first, last));
      }
      EXPECT_TRUE(tree.few_within(c, reach, near.size(), found));
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, near);
      if (!near.empty()) {
        EXPECT_FALSE(tree.few_within(c, reach, near.size() - 1, found));
        const auto nearest = *std::min_element(near.begin(), near.end(), [&](auto a, auto b) {
          return squared_distance(sites[a], c) < squared_distance(sites[b], c);
        });
        EXPECT_EQ(tree.nearest(c, reach).site, nearest);
      }
      tree.within(c, reach, first, last, found);
      near.erase(std::upper_bound(near.begin(), near.end(), last), near.end());
      near.erase(near.begin(), std::lower_bound(near.begin(), near.end(), first));
      EXPECT_EQ(found, near);
    }
  }
}

}  // namespace
}  // namespace medial::site
