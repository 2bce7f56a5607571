// Delaunay triangulations, checked triangle by triangle with exact predicates.

#include "voronoi/delaunay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "base/predicates.h"
#include "base/spatial_order.h"
#include "support/generate.h"

namespace medial::test {
namespace {

using voronoi::Delaunay;
using voronoi::outside;

/// What is wrong at a half-edge, if anything. Where nothing is at any of them, all of it is right:
/// what is Delaunay and convex next to every edge is so everywhere.
std::string fault_at(const Delaunay& d, std::uint32_t h) {
  const std::uint32_t next = Delaunay::next(h), before = Delaunay::before(h), twin = d.twin(h);
  if (d.twin(twin) != h || d.start(twin) != d.start(next)) return "twins that differ";
  const std::uint32_t a = d.start(h), b = d.start(next), c = d.start(before);
  if (a == outside || b == outside) return "";
  const std::vector<Vec2>& p = d.points;
  if (c == outside) {
    const std::uint32_t along = d.start(Delaunay::before(d.twin(next)));
    const int turn = orientation(p[a], p[b], p[along]);
    return turn < 0 || (turn == 0 && strictly_between(p[a], p[b], p[along])) ? ""
                                                                             : "a hull with a dent";
  }
  if (orientation(p[a], p[b], p[c]) <= 0) return "a triangle that is turned over";
  const std::uint32_t beyond = d.start(Delaunay::before(twin));
  if (beyond != outside && in_circle(p[a], p[b], p[c], p[beyond]) > 0) return "a point in a circle";
  return "";
}

std::string fault_of_triangles(const std::vector<Vec2>& points) {
  const Delaunay d = voronoi::triangulate(points);
  if (d.triangles.size() != 2 * points.size() - 2) return "not all triangles";
  for (std::uint32_t t = 0; t < d.triangles.size(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i)
      if (std::string fault = fault_at(d, 4 * t + i); !fault.empty()) return fault;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    if (d.start(d.leaving[v]) != v) return "a half-edge that leaves another vertex";
    if (d.points[v] != points[d.input[v]]) return "another point";
  }
  return "";
}

/// All different.
std::vector<Vec2> some_points(std::size_t count, const std::function<Vec2()>& draw) {
  std::vector<Vec2> points(count);
  std::ranges::generate(points, draw);
  const auto less = [](Vec2 a, Vec2 b) { return lexicographic_less(a, b); };
  std::ranges::sort(points, less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

TEST(Delaunay, HoldsForPointsOfAllSizes) {
  Random random(1);
  const auto unit = [&] { return random.between(-1, 1); };
  for (int i = 0; i < 40; ++i) {
    const double far = random.power_of_ten(-300, 0), flat = random.power_of_ten(-18, 0);
    const double large = i % 4 == 0 ? random.power_of_ten(-120, 120) : 1;
    EXPECT_EQ(fault_of_triangles(some_points(500, [&] { return Vec2{unit(), unit()}; })), "");
    // Smaller and smaller towards the origin, down to where squares underflow.
    EXPECT_EQ(fault_of_triangles(some_points(500,
                                             [&] {
                                               const double size =
                                                   std::pow(far, random.between(0, 1));
                                               return Vec2{size * unit(), size * unit()};
                                             })),
              "");
    EXPECT_EQ(fault_of_triangles(some_points(500,
                                             [&] {
                                               return Vec2{unit(), flat * unit()};
                                             })),
              "");
    EXPECT_EQ(fault_of_triangles(some_points(500,
                                             [&] {
                                               return Vec2{large * unit(), large * unit()};
                                             })),
              "");
    EXPECT_EQ(fault_of_triangles(
                  some_points(500,
                              [&] {
                                const Vec2 middle{std::round(2 * unit()), std::round(2 * unit())};
                                return middle + flat * Vec2{unit(), unit()};
                              })),
              "");
  }
}

TEST(Delaunay, HoldsForPointsOnCirclesLinesAndGrids) {
  Random random(2);
  const auto unit = [&] { return random.between(-1, 1); };
  for (int i = 0; i < 20; ++i) {
    const double off = random.power_of_ten(-17, -10);
    EXPECT_EQ(fault_of_triangles(
                  some_points(300,
                              [&] {
                                const double angle = std::numbers::pi * unit();
                                const double radius = 1 + off * unit();
                                return Vec2{radius * std::cos(angle), radius * std::sin(angle)};
                              })),
              "");
    EXPECT_EQ(fault_of_triangles(
                  some_points(400,
                              [&] {
                                return Vec2{std::round(9 * unit()), std::round(9 * unit())};
                              })),
              "");
    EXPECT_EQ(fault_of_triangles(some_points(300,
                                             [&] {
                                               return Vec2{unit(), std::round(3 * unit())};
                                             })),
              "");
    EXPECT_EQ(fault_of_triangles(some_points(300,
                                             [&] {
                                               const double x = unit();
                                               return Vec2{x, x * x};
                                             })),
              "");
  }
  EXPECT_TRUE(voronoi::triangulate(std::vector<Vec2>{{0, 0}, {2, 2}, {1, 1}}).triangles.empty());
}

TEST(HilbertOrder, GoesFromNeighbourToNeighbour) {
  EXPECT_TRUE(hilbert_order({}).empty());
  EXPECT_EQ(hilbert_order(std::vector<Vec2>(3, Vec2{1e-100, 2})),
            (std::vector<std::uint32_t>{0, 1, 2}));
  Random random(3);
  constexpr std::size_t count = 4096;
  // Spread evenly, and the same in clusters that one cell each holds.
  for (const double scale : {1.0, 1e-9}) {
    std::vector<Vec2> points(count);
    for (std::size_t i = 0; i < count; ++i)
      points[i] = Vec2{scale < 1 ? static_cast<double>(i % 2) : 0, 0} +
                  scale * Vec2{random.between(0, 1), random.between(0, 1)};
    std::vector<std::uint32_t> order = hilbert_order(points);
    double way = 0;
    for (std::size_t i = 1; i < count; ++i)
      way += std::min(scale, distance(points[order[i - 1]], points[order[i]]));
    EXPECT_LT(way, 100 * scale);  // in random order about 2100
    std::ranges::sort(order);
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(order[i], i);
  }
}

}  // namespace
}  // namespace medial::test
