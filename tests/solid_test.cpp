// Meshes to solids: joining, orienting, nesting, mending and refusing; the predicates below.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/vec3.h"
#include "medial/volume.h"
#include "support/solids.h"
#include "volume/closest.h"
#include "volume/predicates.h"

namespace medial {
namespace {

using test::box_mesh;
using test::operator+;

Solid solid_from(const TriangleMesh& mesh) {
  auto solid = build_solid(mesh);
  EXPECT_TRUE(solid.ok()) << to_string(solid.error());
  return solid ? std::move(solid).value() : Solid{};
}

double signed_volume(const TriangleMesh& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.faces)
    six += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c]));
  return six / 6;
}

void expect_refused(const TriangleMesh& mesh, ErrorCode code) {
  const auto solid = build_solid(mesh);
  ASSERT_FALSE(solid.ok()) << name_of(code);
  EXPECT_EQ(solid.error().code, code) << to_string(solid.error());
}

TEST(SpacePredicates, AgreeWithIntegers) {
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> coordinate(-3, 3);
  int zeros = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::array<Vec3, 4> p;
    for (Vec3& q : p)
      q = {double(coordinate(random)), double(coordinate(random)), double(coordinate(random))};
    const Vec3 a = p[0] - p[3], b = p[1] - p[3], c = p[2] - p[3];
    const double volume = dot(a, cross(b, c));  // exact: small integers
    const int expected = (volume < 0) - (volume > 0);
    zeros += expected == 0;
    // The same far from the origin and scaled by thirds is decided by exact arithmetic.
    EXPECT_EQ(volume::orientation(p[0], p[1], p[2], p[3]), expected);
    for (Vec3& q : p) q = 0x1p-30 * q + Vec3{1, 2, 3};
    EXPECT_EQ(volume::orientation(p[0], p[1], p[2], p[3]), expected);
  }
  EXPECT_GT(zeros, 100);
}

TEST(SpacePredicates, TellsAPointThatMissesThePlaneByOneUnit) {
  const Vec3 a{0.1, 0.1, 0.1}, b{0.7, 0.3, 0.2}, c{0.2, 0.9, 0.4};
  const Vec3 on = a;  // in the plane
  EXPECT_EQ(volume::orientation(a, b, c, on), 0);
  const Vec3 above{on.x, on.y, std::nextafter(on.z, 1)};
  const Vec3 below{on.x, on.y, std::nextafter(on.z, 0)};
  EXPECT_EQ(volume::orientation(a, b, c, above), 1);
  EXPECT_EQ(volume::orientation(a, b, c, below), -1);
}

TEST(SpacePredicates, TrianglesThatTouchMeet) {
  const Vec3 floor[3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const Vec3 touching[3] = {{1, 1, 0}, {1, 1, 2}, {2, 1, 2}};
  const Vec3 above[3] = {{1, 1, 1e-300}, {1, 1, 2}, {2, 1, 2}};
  const Vec3 through[3] = {{1, 1, -1}, {1, 1, 2}, {2, 1, 2}};
  const Vec3 beside[3] = {{5, 5, -1}, {5, 5, 2}, {6, 5, 2}};
  const Vec3 within[3] = {{0.5, 0.5, 0}, {1, 0.5, 0}, {0.5, 1, 0}};
  const Vec3 in_plane[3] = {{3, 3, 0}, {4, 3, 0}, {3, 4, 0}};
  EXPECT_TRUE(volume::triangles_meet(floor, touching));
  EXPECT_TRUE(volume::triangles_meet(floor, through));
  EXPECT_TRUE(volume::triangles_meet(floor, within));
  EXPECT_TRUE(volume::triangles_meet(within, floor));
  EXPECT_FALSE(volume::triangles_meet(floor, above));
  EXPECT_FALSE(volume::triangles_meet(floor, beside));
  EXPECT_FALSE(volume::triangles_meet(floor, in_plane));
}

TEST(ClosestPoint, IsNoFartherThanAnyPointOfTheTriangle) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> coordinate(-1, 1), share(0, 1);
  for (int i = 0; i < 3000; ++i) {
    volume::Triangle t;
    for (Vec3& q : t.corner) q = {coordinate(random), coordinate(random), coordinate(random)};
    if (i % 10 == 0) t.corner[2] = 0.5 * (t.corner[0] + t.corner[1]);  // no area
    const Vec3 p{2 * coordinate(random), 2 * coordinate(random), 2 * coordinate(random)};
    const volume::Closest closest = volume::closest_point(p, t);
    EXPECT_NEAR(closest.squared_distance, squared_norm(closest.point - p), 1e-14);
    double sampled = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 200; ++k) {
      double u = share(random), v = share(random);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 q =
          t.corner[0] + u * (t.corner[1] - t.corner[0]) + v * (t.corner[2] - t.corner[0]);
      sampled = std::min(sampled, squared_norm(q - p));
    }
    EXPECT_LE(closest.squared_distance, sampled + 1e-12);
    EXPECT_GE(closest.squared_distance, sampled - 2 * std::sqrt(sampled));  // it is on the triangle
    EXPECT_LE(volume::closest_on_sides(closest.point, t).squared_distance, 4);
    if (!closest.inside) {
      EXPECT_NEAR(volume::closest_on_sides(p, t).squared_distance, closest.squared_distance, 1e-12);
    }
  }
}

TEST(Solid, ABoxIsOne) {
  const Solid solid = solid_from(box_mesh({0, 0, 0}, {1, 2, 3}));
  EXPECT_EQ(solid.topology, (VoxelTopology{1, 0, 0}));
  EXPECT_DOUBLE_EQ(signed_volume(solid.surface), 6);
  EXPECT_EQ(solid.report.reversed_faces, 0U);
}

TEST(Solid, TopologyOfKnownSolids) {
  EXPECT_EQ(solid_from(test::torus_mesh(2, 0.5, 20, 10)).topology, (VoxelTopology{1, 1, 0}));
  EXPECT_EQ(solid_from(test::sphere_mesh({}, 2, 2) + test::sphere_mesh({}, 1, 1)).topology,
            (VoxelTopology{1, 0, 1}));
  EXPECT_EQ(solid_from(box_mesh({0, 0, 0}, {9, 9, 9}) + box_mesh({1, 1, 1}, {8, 8, 8}) +
                       box_mesh({2, 2, 2}, {3, 3, 3}) + box_mesh({10, 0, 0}, {11, 1, 1}))
                .topology,
            (VoxelTopology{3, 0, 1}));
  EXPECT_EQ(
      solid_from(test::letter_mesh({"#####", "#...#", "#####", "#...#", "#####"}, 2)).topology,
      (VoxelTopology{1, 2, 0}));
}

TEST(Solid, JoinsCornersAndTurnsFaces) {
  TriangleMesh mesh =
      test::unjoined(box_mesh({0, 0, 0}, {1, 1, 1}) + box_mesh({-1, -1, -1}, {2, 2, 2}));
  for (std::size_t f = 0; f < mesh.faces.size(); f += 3)
    std::swap(mesh.faces[f][0], mesh.faces[f][1]);
  const Solid solid = solid_from(mesh);
  EXPECT_EQ(solid.surface.vertices.size(), 16U);
  EXPECT_EQ(solid.report.joined_vertices, mesh.vertices.size() - 16);
  EXPECT_DOUBLE_EQ(signed_volume(solid.surface), 26);  // the inner box is a cavity
  // The faces of the cavity point into it, so those of the inner box had to be turned but for the
  // ones turned before: 4 of its 12, and 4 of the 12 outer ones.
  EXPECT_EQ(solid.report.reversed_faces, 8U + 4U);
}

TEST(Solid, DropsFacesThatLostACorner) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.faces.insert(mesh.faces.begin(), {3, 3, 5});
  mesh.vertices.push_back({7, 7, 7});
  const Solid solid = solid_from(mesh);
  EXPECT_EQ(solid.report.dropped_faces, 1U);
  EXPECT_EQ(solid.report.unused_vertices, 1U);
  EXPECT_EQ(solid.source.front(), 1U);
}

TEST(Solid, PartsSurfacesThatTouchInAVertex) {
  const Solid solid = solid_from(box_mesh({0, 0, 0}, {1, 1, 1}) + box_mesh({1, 1, 1}, {2, 2, 2}));
  EXPECT_EQ(solid.report.parted_vertices, 1U);
  EXPECT_EQ(solid.surface.vertices.size(), 16U);
  EXPECT_EQ(solid.topology, (VoxelTopology{2, 0, 0}));
}

TEST(Solid, RefusesOpenSurfacesWithThePlace) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.faces.pop_back();  // 3 7 5
  const auto solid = build_solid(mesh);
  ASSERT_FALSE(solid.ok());
  EXPECT_EQ(solid.error().code, ErrorCode::open_surface);
  ASSERT_TRUE(solid.error().place.face && solid.error().place.point && solid.error().place.z);
  EXPECT_EQ(solid.error().place.point->x, 1);  // the middle of an edge of the face that is gone
  EXPECT_NE(to_string(solid.error()).find(", "), std::string::npos);
}

TEST(Solid, RefusesWhatIsNoSurface) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {2, 2, 2});
  expect_refused({}, ErrorCode::empty);
  expect_refused(box + box_mesh({2, 2, 0}, {3, 3, 2}), ErrorCode::non_manifold);  // a shared edge
  expect_refused(box + box, ErrorCode::non_manifold);
  expect_refused(box + box_mesh({1, 1, 1}, {3, 3, 3}), ErrorCode::crossing);
  expect_refused(box + box_mesh({0.5, 0.5, 2}, {1, 1, 3}), ErrorCode::crossing);  // stands on it
  expect_refused(box + box_mesh({2, 0.5, 0.5}, {3, 1, 1}), ErrorCode::crossing);  // leans on it
  // Two faces back to back.
  expect_refused({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}, ErrorCode::overlap);
  // A tetrahedron pressed flat.
  expect_refused(
      {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}}, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}},
      ErrorCode::overlap);
  expect_refused({{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}}, ErrorCode::no_area);
  TriangleMesh bad = box;
  bad.faces[4][2] = 8;
  expect_refused(bad, ErrorCode::malformed);
  bad = box;
  bad.vertices[3].y = std::numeric_limits<double>::quiet_NaN();
  expect_refused(bad, ErrorCode::not_finite);
  bad.vertices[3].y = 1e200;
  expect_refused(bad, ErrorCode::unsupported);
}

TEST(Solid, TurnedAndScaledMeshesStaySolids) {
  for (const double scale : {1e-60, 1e-3, 1.0, 1e6, 1e60}) {
    const Solid solid =
        solid_from(test::turned(test::torus_mesh(2, 0.5, 30, 12), scale, scale * Vec3{5, -3, 1}));
    EXPECT_EQ(solid.topology, (VoxelTopology{1, 1, 0})) << scale;
  }
}

}  // namespace
}  // namespace medial
