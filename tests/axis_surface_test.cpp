// Axes of solids as triangles and lines: their topology, and the axes that are known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "base/vec3.h"
#include "medial/volume.h"
#include "support/solids.h"
#include "volume/closest.h"

namespace medial {
namespace {

using test::operator+;

struct Axis {
  AxisSurface surface;
  double step = 0;  ///< edge of a voxel
  VoxelTopology topology;
};

Axis axis_of(const TriangleMesh& mesh, int voxels, double angle = 30, int threads = 2) {
  const auto solid = build_solid(mesh);
  EXPECT_TRUE(solid.ok());
  VoxelOptions options;
  options.voxels = voxels;
  options.angle = angle;
  options.surface = true;
  options.threads = threads;
  auto axis = compute_voxels(*solid, options);
  EXPECT_TRUE(axis.ok());
  return {std::move(axis->surface), axis->resolution, axis->topology};
}

/// Points less edges and plus triangles.
std::int64_t euler_characteristic(const AxisSurface& surface) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  const auto add = [&](std::uint32_t a, std::uint32_t b) { edges.insert(std::minmax(a, b)); };
  for (const auto& [a, b, c] : surface.triangles) add(a, b), add(b, c), add(c, a);
  for (const auto& [a, b] : surface.lines) add(a, b);
  return static_cast<std::int64_t>(surface.vertices.size() + surface.triangles.size()) -
         static_cast<std::int64_t>(edges.size());
}

double length(const AxisSurface& surface) {
  double sum = 0;
  for (const auto& [a, b] : surface.lines)
    sum += distance(surface.vertices[a], surface.vertices[b]);
  return sum;
}

volume::Triangle triangle(const AxisSurface& surface, std::size_t i) {
  return volume::triangle_of(surface.vertices, surface.triangles[i]);
}

double area(const AxisSurface& surface) {
  double sum = 0;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& [a, b, c] = triangle(surface, i).corner;
    sum += 0.5 * norm(cross(b - a, c - a));
  }
  return sum;
}

/// From p to the nearest triangle.
double distance_to(const AxisSurface& surface, Vec3 p) {
  double least = 1e18;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    least = std::min(least, volume::closest_point(p, triangle(surface, i)).squared_distance);
  return std::sqrt(least);
}

TEST(AxisSurface, HasTheTopologyOfTheSolid) {
  const TriangleMesh meshes[] = {
      test::turned(test::box_mesh({0, 0, 0}, {4, 3, 2})),
      test::box_mesh({0, 0, 0}, {4, 3, 2}),
      test::sphere_mesh({}, 1, 4),
      test::turned(test::cylinder_mesh(1, 3, 40)),
      test::turned(test::torus_mesh(2, 0.6, 60, 30)),
      test::sphere_mesh({}, 2, 4) + test::sphere_mesh({0.2, 0, 0}, 1, 3),
      test::sphere_mesh({}, 1, 3) + test::box_mesh({2, -1, -1}, {3, 1, 1}),
      test::letter_mesh({"####", "#..#", "####", "#..#", "####"}, 1),
      test::turned(test::cubes_mesh(
          3, 3, 3, [](int x, int y, int z) { return (x == 1) + (y == 1) + (z == 1) <= 1; }))};
  for (const TriangleMesh& mesh : meshes) {
    const Axis axis = axis_of(mesh, 40);
    const auto& [parts, tunnels, cavities] = axis.topology;
    EXPECT_EQ(euler_characteristic(axis.surface),
              static_cast<std::int64_t>(parts + cavities) - tunnels)
        << &mesh - meshes;
  }
}

TEST(AxisSurface, OfABoxLiesOnItsSheets) {
  const Vec3 low{0, 0, 0}, high{4, 3, 2};
  const Axis axis = axis_of(test::box_mesh(low, high), 40);
  EXPECT_TRUE(axis.surface.lines.empty());
  const auto depths = [&](Vec3 p) {
    std::array<double, 6> d = {p.x, p.y, p.z, high.x - p.x, high.y - p.y, high.z - p.z};
    std::ranges::sort(d);
    return d;
  };
  double worst = 0, worst_radius = 0;
  for (std::size_t i = 0; i < axis.surface.vertices.size(); ++i) {
    const auto d = depths(axis.surface.vertices[i]);
    worst = std::max(worst, d[1] - d[0]);  // no less than the distance to the axis
    worst_radius = std::max(worst_radius, std::abs(axis.surface.radii[i] - d[0]));
  }
  EXPECT_LE(worst, 0.01 * axis.step);
  EXPECT_LE(worst_radius, 1e-9);
  // Points of the axis, deeper than it ends: their two nearest sides are equally far.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  double farthest = 0;
  for (int i = 0; i < 2000; ++i) {
    Vec3 p{4 * share(random), 3 * share(random), share(random) < 0.5 ? share(random) : 1};
    if (p.z < 1) p.x = p.z;  // on a sheet to an edge, or the one in the middle
    const auto d = depths(p);
    if (d[1] - d[0] > 1e-12 || d[0] < 2.5 * axis.step) continue;
    farthest = std::max(farthest, distance_to(axis.surface, p));
  }
  EXPECT_LE(farthest, 0.05 * axis.step);
}

TEST(AxisSurface, OfACylinderIsALineBetweenCones) {
  const double radius = 1, height = 4, side = height / 2 - radius;
  const Axis axis = axis_of(test::cylinder_mesh(radius, height, 200), 80);
  double worst = 0;
  for (const Vec3 p : axis.surface.vertices) {
    const double off = std::hypot(p.x, p.y), z = std::abs(p.z);
    const double to_line = std::hypot(off, std::max(z - side, 0.0));
    const double to_cone = std::abs((z - height / 2) + (radius - off)) / std::numbers::sqrt2;
    worst = std::max(worst, std::min(to_line, to_cone));
  }
  EXPECT_LE(worst, 0.1 * axis.step);
  EXPECT_NEAR(length(axis.surface), 2 * side, axis.step);
  // The cones end about a voxel and a half before the rims.
  const double cone = radius - 1.5 * axis.step;
  EXPECT_NEAR(area(axis.surface), 2 * std::numbers::pi * std::numbers::sqrt2 * cone * cone, 0.5);
}

TEST(AxisSurface, OfATorusIsACircle) {
  const double large = 2, small = 0.6;
  const Axis axis = axis_of(test::turned(test::torus_mesh(large, small, 120, 40)), 80);
  EXPECT_TRUE(axis.surface.triangles.empty());
  EXPECT_NEAR(length(axis.surface), 2 * std::numbers::pi * large, 0.25);
  double worst = 0;
  for (const double radius : axis.surface.radii) worst = std::max(worst, std::abs(radius - small));
  EXPECT_LE(worst, 0.5 * axis.step);
}

TEST(AxisSurface, DoesNotDependOnTheNumberOfThreads) {
  const TriangleMesh mesh = test::turned(test::cylinder_mesh(1, 3, 40));
  const Axis one = axis_of(mesh, 32, 30, 1), three = axis_of(mesh, 32, 30, 3);
  EXPECT_EQ(one.surface.vertices, three.surface.vertices);
  EXPECT_EQ(one.surface.radii, three.surface.radii);
  EXPECT_EQ(one.surface.triangles, three.surface.triangles);
  EXPECT_EQ(one.surface.lines, three.surface.lines);
}

TEST(AxisSurface, OfForceLinesNearsTheAxisOfABoxAsTheOrderGrows) {
  const auto solid = build_solid(test::box_mesh({0, 0, 0}, {4, 3, 2}));
  ASSERT_TRUE(solid.ok());
  VoxelOptions options;
  options.voxels = 20;
  double before = 1e9;
  for (const int order : {3, 6, 16}) {
    options.order = order;
    const auto axis = compute_voxels(*solid, options);
    ASSERT_TRUE(axis.ok());
    const AxisSurface& surface = axis->surface;
    double worst = 0, sum = 0;
    for (const Vec3 p : surface.vertices) {
      std::array<double, 6> d = {p.x, p.y, p.z, 4 - p.x, 3 - p.y, 2 - p.z};
      std::ranges::sort(d);
      worst = std::max(worst, d[1] - d[0]);  // no less than the distance to the axis
      sum += d[1] - d[0];
    }
    const double mean = sum / static_cast<double>(surface.vertices.size());
    EXPECT_LE(worst, 1.5 * axis->resolution) << order;
    EXPECT_LT(mean, before) << order;
    before = mean;
    // Sheets are triangles: the part of the 13 that is deeper than the starts, two voxels inside.
    const double h = 2 * axis->resolution, deep = 1 - h;
    const double all = 2 + std::numbers::sqrt2 * deep *
                               (2 * ((4 - 2 * h) + 2) + 2 * ((3 - 2 * h) + 1) + 2 * (2 - 2 * h));
    EXPECT_GT(area(surface), 0.75 * all) << order;
    EXPECT_LT(area(surface), 1.1 * all) << order;
    // Curves come from the eight vertices at least.
    EXPECT_GT(length(surface), 8.0) << order;
  }
  // A torus has no convex edge.
  const auto torus = build_solid(test::torus_mesh(2, 0.6, 40, 20));
  const auto none = compute_voxels(*torus, options);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().code, ErrorCode::unsupported);
}

}  // namespace
}  // namespace medial
