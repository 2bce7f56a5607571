// Axes on a grid: sets of voxels, their topology, and the axes of solids that are known.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "base/vec3.h"
#include "medial/compute.h"
#include "medial/query.h"
#include "medial/volume.h"
#include "support/solids.h"
#include "volume/digitize.h"
#include "volume/feet.h"
#include "volume/topology.h"
#include "volume/voxel_set.h"

namespace medial {
namespace {

using test::operator+;
using volume::Cell;
using volume::VoxelSet;

Solid solid_of(const TriangleMesh& mesh) {
  auto solid = build_solid(mesh);
  EXPECT_TRUE(solid.ok()) << to_string(solid.error());
  return solid ? std::move(solid).value() : Solid{};
}

VoxelAxis axis_of(const Solid& solid, const VoxelOptions& options = {}) {
  auto axis = compute_voxels(solid, options);
  EXPECT_TRUE(axis.ok()) << to_string(axis.error());
  return axis ? std::move(axis).value() : VoxelAxis{};
}

VoxelOptions with(int voxels, Thinning thinning = Thinning::sheets) {
  VoxelOptions options;
  options.voxels = voxels;
  options.thinning = thinning;
  options.threads = 2;
  return options;
}

/// The solid in units of a grid, as compute_voxels() lays it.
volume::Grid grid_of(const Solid& solid, int voxels) {
  const VoxelAxis axis = axis_of(solid, with(voxels));
  volume::Grid grid;
  grid.step = axis.resolution;
  grid.origin = axis.origin;
  grid.size = axis.cells;
  grid.faces = solid.surface.faces;
  for (const Vec3 p : solid.surface.vertices)
    grid.vertices.push_back(1 / grid.step * (p - grid.origin));
  return grid;
}

VoxelSet set_of(const std::vector<Voxel>& voxels, const volume::GridSize& size) {
  VoxelSet set(size);
  for (const Voxel& voxel : voxels) set.insert({voxel.cell[0], voxel.cell[1], voxel.cell[2]});
  return set;
}

bool same(const VoxelAxis& a, const VoxelAxis& b) {
  const auto equal = [](const Voxel& u, const Voxel& v) {
    return u.cell == v.cell && u.center == v.center && u.radius == v.radius &&
           u.quality == v.quality && u.face == v.face;
  };
  return a.links == b.links && a.cells == b.cells && std::ranges::equal(a.voxels, b.voxels, equal);
}

// ---- Sets of voxels.

TEST(VoxelSet, HoldsWhatASetHolds) {
  const volume::GridSize size = {37, 20, 19};
  std::mt19937_64 random(1);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  VoxelSet set(size);
  std::set<std::uint64_t> expected;
  for (int i = 0; i < 20'000; ++i) {
    const Cell cell = {below(size[0]), below(size[1]), below(size[2])};
    const std::uint64_t rank = volume::rank_of(cell, size);
    EXPECT_EQ(volume::cell_of(rank, size), cell);
    if (i % 3 == 0) {
      EXPECT_EQ(set.erase(cell), expected.erase(rank) == 1);
    } else if (i % 100 == 1) {
      const std::uint32_t end = cell.x + below(size[0] - cell.x + 1);
      set.insert_run(cell.x, end, cell.y, cell.z);
      for (std::uint32_t x = cell.x; x < end; ++x)
        expected.insert(volume::rank_of({x, cell.y, cell.z}, size));
    } else {
      EXPECT_EQ(set.insert(cell), expected.insert(rank).second);
    }
    if (i % 5000 == 0)
      for (std::uint32_t slab = 0; slab < set.slab_count(); ++slab) set.compress(slab);
  }
  EXPECT_EQ(set.count(), expected.size());
  std::vector<std::uint64_t> ranks;
  volume::each_voxel(set, [&](Cell cell) { ranks.push_back(volume::rank_of(cell, size)); });
  EXPECT_TRUE(std::ranges::equal(ranks, expected));
  for (int i = 0; i < 2000; ++i) {
    const Cell cell = {1 + below(size[0] - 2), 1 + below(size[1] - 2), 1 + below(size[2] - 2)};
    const volume::Neighbourhood around = set.around(cell);
    for (int bit = 0; bit < 27; ++bit)
      EXPECT_EQ((around >> bit & 1U) != 0, set.contains(volume::neighbour(cell, bit)));
  }
}

TEST(VoxelSet, FullAndEmptyBlocksTakeNoStorage) {
  VoxelSet set({64, 64, 64});
  const std::uint64_t empty = set.bytes();
  for (std::uint32_t z = 0; z < 64; ++z)
    for (std::uint32_t y = 0; y < 64; ++y) set.insert_run(0, 64, y, z);
  for (std::uint32_t slab = 0; slab < set.slab_count(); ++slab) set.compress(slab);
  EXPECT_EQ(set.count(), 64U * 64 * 64);
  EXPECT_EQ(set.bytes(), empty);
}

TEST(VoxelTopology, OfKnownSets) {
  const auto of = [](int n, const std::function<bool(int, int, int)>& filled) {
    VoxelSet set({static_cast<std::uint32_t>(n + 2), static_cast<std::uint32_t>(n + 2),
                  static_cast<std::uint32_t>(n + 2)});
    for (int z = 0; z < n; ++z)
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
          if (filled(x, y, z))
            set.insert({static_cast<std::uint32_t>(x + 1), static_cast<std::uint32_t>(y + 1),
                        static_cast<std::uint32_t>(z + 1)});
    return volume::topology_of(set);
  };
  EXPECT_EQ(of(5, [](int, int, int) { return false; }), (VoxelTopology{0, 0, 0}));
  EXPECT_EQ(of(9, [](int, int, int) { return true; }), (VoxelTopology{1, 0, 0}));
  EXPECT_EQ(of(3, [](int x, int y, int z) { return x != 1 || y != 1 || z != 1; }),
            (VoxelTopology{1, 0, 1}));
  EXPECT_EQ(of(3, [](int x, int y, int) { return x != 1 || y != 1; }), (VoxelTopology{1, 1, 0}));
  // A cube's edges: 12 edges, 8 corners.
  EXPECT_EQ(of(3, [](int x, int y, int z) { return (x == 1) + (y == 1) + (z == 1) <= 1; }),
            (VoxelTopology{1, 5, 0}));
  // Cubes that share corners only are one part; so are the gaps between none.
  EXPECT_EQ(of(6, [](int x, int y, int z) { return x == y && y == z; }), (VoxelTopology{1, 0, 0}));
  EXPECT_EQ(of(7, [](int x, int y, int z) { return x % 2 == 0 && y % 2 == 0 && z % 2 == 0; }),
            (VoxelTopology{64, 0, 0}));
}

TEST(VoxelTopology, SimpleVoxelsAreThoseWhoseNeighboursAreOneContractiblePart) {
  // The cubes of the neighbours shrink onto what they share with the cube in the middle.
  std::mt19937_64 random(2);
  int simple = 0;
  for (int i = 0; i < 20'000; ++i) {
    auto bits = static_cast<volume::Neighbourhood>(random()) & ((1U << 27U) - 1);
    if (i % 2 == 0) bits &= static_cast<volume::Neighbourhood>(random());  // sparse
    if (i % 4 == 1) bits |= static_cast<volume::Neighbourhood>(random()) & ((1U << 27U) - 1);
    if (i % 8 == 2) bits &= static_cast<volume::Neighbourhood>(random());
    VoxelSet neighbours({5, 5, 5});
    for (int bit = 0; bit < 27; ++bit)
      if (bit != 13 && (bits >> bit & 1U) != 0)
        neighbours.insert(volume::neighbour({2, 2, 2}, bit));
    // Where all six neighbours across faces are there, the middle is enclosed.
    const bool expected = volume::topology_of(neighbours) == VoxelTopology{1, 0, 0};
    simple += expected;
    ASSERT_EQ(volume::is_simple(bits | volume::center_bit), expected) << bits;
  }
  EXPECT_GT(simple, 1000);
}

// ---- The grid.

TEST(Digitize, NoPathOverNeighboursPassesTheSurface) {
  for (const TriangleMesh& mesh : {test::turned(test::torus_mesh(2, 0.7, 40, 16)),
                                   test::turned(test::box_mesh({0, 0, 0}, {3, 2, 1})),
                                   test::sphere_mesh({}, 2, 2) + test::sphere_mesh({}, 1, 2)}) {
    const Solid solid = solid_of(mesh);
    const volume::Grid grid = grid_of(solid, 30);
    const volume::Digitized digitized = volume::digitize(grid, [] { return false; });
    std::uint64_t inside = 0;
    for (std::uint32_t z = 1; z + 1 < grid.size[2]; ++z) {
      for (std::uint32_t y = 1; y + 1 < grid.size[1]; ++y) {
        for (std::uint32_t x = 1; x + 1 < grid.size[0]; ++x) {
          const Cell cell = {x, y, z};
          if (digitized.surface.contains(cell)) {
            EXPECT_FALSE(digitized.interior.contains(cell));
            continue;
          }
          const bool here = digitized.interior.contains(cell);
          inside += here;
          // Neighbours that the surface misses as well lie on the same side.
          const auto free = ~digitized.surface.around(cell) & ((1U << 27U) - 1);
          const auto interior = digitized.interior.around(cell) & free;
          ASSERT_TRUE(here ? interior == free : interior == 0) << x << ' ' << y << ' ' << z;
        }
      }
    }
    EXPECT_GT(inside, 100U);
  }
}

TEST(Digitize, TakesExactlyTheVoxelsThatABoxMeets) {
  // A box from 2.25 to 2.25 + 10 cells: the cells 2 and 12 hold the surface.
  volume::Grid grid;
  grid.size = {16, 16, 16};
  const TriangleMesh mesh = test::box_mesh({2.25, 2.25, 2.25}, {12.25, 12.25, 12.25});
  grid.vertices = mesh.vertices;
  grid.faces = mesh.faces;
  const volume::Digitized digitized = volume::digitize(grid, [] { return false; });
  EXPECT_EQ(digitized.interior.count(), 9U * 9 * 9);
  EXPECT_EQ(digitized.surface.count(), 11U * 11 * 11 - 9 * 9 * 9);
  const auto sets = volume::bounded_sets(digitized.interior);
  ASSERT_EQ(sets.size(), 1U);
  EXPECT_EQ(sets[0].voxels, 729U);
  EXPECT_EQ(sets[0].low, 3U);
  EXPECT_EQ(sets[0].high, 11U);
}

TEST(Digitize, ANeckThatTheGridClosesPartsTheBoundedSets) {
  // Two cubes of 8 and a bar between them, of 1: less than two voxels wide.
  const Solid solid = solid_of(test::cubes_mesh(
      24, 8, 8, [](int x, int y, int z) { return x < 8 || x >= 16 || (y == 3 && z == 3); }));
  EXPECT_EQ(solid.topology, (VoxelTopology{1, 0, 0}));
  const VoxelAxis coarse = axis_of(solid, with(24));
  EXPECT_EQ(coarse.statistics.bounded_sets, 2U);
  EXPECT_EQ(coarse.interior, (VoxelTopology{2, 0, 0}));
  EXPECT_EQ(coarse.topology, coarse.interior);
  const VoxelAxis fine = axis_of(solid, with(24 * 5));
  EXPECT_EQ(fine.topology, (VoxelTopology{1, 0, 0}));
}

// ---- Axes.

struct Known {
  const char* name;
  TriangleMesh mesh;
  VoxelTopology topology;
};

std::vector<Known> known_solids() {
  return {
      {"box", test::turned(test::box_mesh({0, 0, 0}, {4, 3, 2})), {1, 0, 0}},
      {"straight box", test::box_mesh({0, 0, 0}, {4, 3, 2}), {1, 0, 0}},
      {"sphere", test::sphere_mesh({}, 1, 4), {1, 0, 0}},
      {"cylinder", test::turned(test::cylinder_mesh(1, 3, 40)), {1, 0, 0}},
      {"torus", test::turned(test::torus_mesh(2, 0.6, 60, 30)), {1, 1, 0}},
      {"shell", test::sphere_mesh({}, 2, 4) + test::sphere_mesh({0.2, 0, 0}, 1, 3), {1, 0, 1}},
      {"two parts",
       test::sphere_mesh({}, 1, 3) + test::box_mesh({2, -1, -1}, {3, 1, 1}),
       {2, 0, 0}},
      {"E", test::letter_mesh({"####", "#...", "###.", "#...", "####"}, 2), {1, 0, 0}},
      {"B", test::letter_mesh({"####", "#..#", "####", "#..#", "####"}, 1), {1, 2, 0}},
      {"tunnels through all sides of a cube",
       test::turned(test::cubes_mesh(
           3, 3, 3, [](int x, int y, int z) { return (x == 1) + (y == 1) + (z == 1) <= 1; })),
       {1, 5, 0}},
      {"a tunnel around a cavity",
       test::torus_mesh(3, 1.2, 40, 20) + test::torus_mesh(3, 0.4, 30, 10),
       {1, 2, 1}},
  };
}

TEST(Voxels, KeepPartsTunnelsAndCavities) {
  for (const Known& known : known_solids()) {
    const Solid solid = solid_of(known.mesh);
    EXPECT_EQ(solid.topology, known.topology) << known.name;
    for (const Thinning thinning : {Thinning::none, Thinning::sheets, Thinning::curves}) {
      const VoxelAxis axis = axis_of(solid, with(48, thinning));
      const std::string what = std::string(known.name) + " " + std::to_string(int(thinning));
      EXPECT_EQ(axis.interior, known.topology) << what;
      EXPECT_EQ(axis.topology, known.topology) << what;
      EXPECT_EQ(volume::topology_of(set_of(axis.voxels, axis.cells)), known.topology) << what;
      EXPECT_LT(axis.voxels.size(), axis.statistics.interior_voxels) << what;
    }
  }
}

TEST(Voxels, ThinningTakesAwayOnly) {
  for (const Known& known : known_solids()) {
    const Solid solid = solid_of(known.mesh);
    const VoxelAxis all = axis_of(solid, with(40, Thinning::none));
    const VoxelAxis sheets = axis_of(solid, with(40, Thinning::sheets));
    const VoxelAxis curves = axis_of(solid, with(40, Thinning::curves));
    const VoxelSet before = set_of(all.voxels, all.cells);
    for (const VoxelAxis* axis : {&sheets, &curves})
      for (const Voxel& v : axis->voxels)
        EXPECT_TRUE(before.contains({v.cell[0], v.cell[1], v.cell[2]}));
    EXPECT_LE(sheets.voxels.size(), all.voxels.size());
    EXPECT_LE(curves.voxels.size(), all.voxels.size());
  }
}

TEST(Voxels, LinksConnectWhatNeighboursConnect) {
  const Solid solid = solid_of(test::turned(test::torus_mesh(2, 0.6, 60, 30)));
  for (const Thinning thinning : {Thinning::none, Thinning::sheets, Thinning::curves}) {
    const VoxelAxis axis = axis_of(solid, with(40, thinning));
    EXPECT_TRUE(std::ranges::is_sorted(axis.links));
    std::vector<std::uint32_t> part(axis.voxels.size());
    for (std::uint32_t i = 0; i < part.size(); ++i) part[i] = i;
    const auto find = [&](std::uint32_t i) {
      while (part[i] != i) i = part[i] = part[part[i]];
      return i;
    };
    for (const auto& [a, b] : axis.links) {
      ASSERT_LT(a, b);
      ASSERT_LT(b, axis.voxels.size());
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LE(std::abs(int(axis.voxels[a].cell[k]) - int(axis.voxels[b].cell[k])), 1);
      part[find(a)] = find(b);
    }
    std::set<std::uint32_t> parts;
    for (std::uint32_t i = 0; i < part.size(); ++i) parts.insert(find(i));
    EXPECT_EQ(parts.size(), 1U);
  }
}

TEST(Voxels, AreOrderedAndTellTheirDistance) {
  const Vec3 low{0, 0, 0}, high{4, 3, 2};
  const VoxelAxis axis = axis_of(solid_of(test::box_mesh(low, high)), with(40));
  std::uint64_t last = 0;
  for (const Voxel& v : axis.voxels) {
    const std::uint64_t rank = volume::rank_of({v.cell[0], v.cell[1], v.cell[2]}, axis.cells) + 1;
    EXPECT_LT(last, rank);
    last = rank;
    double nearest = 1e9;
    for (int k = 0; k < 3; ++k)
      nearest = std::min({nearest, v.center[k] - low[k], high[k] - v.center[k]});
    EXPECT_NEAR(v.radius, nearest, 1e-12);
  }
}

/// How far from the centre, away from the nearest face, the axis of a box lies, at most: there the
/// ball that still touches that face touches another one.
double distance_to_box_axis(Vec3 p, Vec3 low, Vec3 high) {
  std::array<double, 6> d;
  for (int k = 0; k < 3; ++k) {
    d[static_cast<std::size_t>(2 * k)] = p[k] - low[k];
    d[static_cast<std::size_t>(2 * k + 1)] = high[k] - p[k];
  }
  const auto first = static_cast<std::size_t>(std::ranges::min_element(d) - d.begin());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 6; ++i) {
    if (i == first) continue;
    const double lag = d[i] - d[first];
    least = std::min(least, i / 2 == first / 2 ? lag / 2 : lag);
  }
  return least;
}

TEST(Voxels, OfABoxLieWithinAVoxelOfTheExactAxis) {
  // A second foot that is farther by q, on a face at a right angle, touches after q; on the
  // opposite face after q / 2. And q is at most one edge of a voxel, and a millionth.
  const Vec3 low{0, 0, 0}, high{4, 3, 2};
  const Solid solid = solid_of(test::box_mesh(low, high));
  for (const int n : {20, 37, 64}) {
    const VoxelAxis axis = axis_of(solid, with(n, Thinning::none));
    EXPECT_EQ(axis.statistics.bridge_voxels, 0U);
    for (const Voxel& v : axis.voxels)
      EXPECT_LE(distance_to_box_axis(v.center, low, high), axis.resolution * (1 + 2e-6));
    // The axis crosses a line of voxel centres along the axis nearest to its normal within half a
    // voxel of a centre; sideways the line lies within 1 / sqrt 2, and on the way there the sheet
    // rises by no more than 1 / 2 in each of the two other directions: together less than 2. What
    // lies nearer to the surface than that may lie in surface voxels, and their neighbours.
    const VoxelSet found = set_of(axis.voxels, axis.cells);
    const double h = axis.resolution;
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> share(0, 1);
    int tested = 0;
    for (int i = 0; i < 20'000; ++i) {
      Vec3 p{4 * share(random), 3 * share(random), 2 * share(random)};
      // On to the axis, away from the nearest face.
      int nearest = 0;
      double depth = 1e9;
      for (int side = 0; side < 6; ++side) {
        const double d = side % 2 == 0 ? p[side / 2] - low[side / 2] : high[side / 2] - p[side / 2];
        if (d < depth) depth = d, nearest = side;
      }
      p[nearest / 2] += (nearest % 2 == 0 ? 1 : -1) * distance_to_box_axis(p, low, high);
      if (depth + distance_to_box_axis(p, low, high) < 4 * h) continue;
      ++tested;
      double best = 1e9;
      for (const Voxel& v : axis.voxels)
        if (std::abs(v.center.x - p.x) < 2 * h) best = std::min(best, squared_norm(v.center - p));
      ASSERT_LE(std::sqrt(best), 2 * h) << p.x << ' ' << p.y << ' ' << p.z;
      if (tested == 400) break;
    }
    EXPECT_EQ(tested, 400);
  }
}

TEST(Voxels, OfASphereLieAtItsCentre) {
  // Medial voxels lie within tolerance / (2 sin(angle / 2)) of the exact axis of the mesh
  // (volume/feet.h), and that one, but for sheets to edges where faces meet at the angle or more,
  // within the deviation of the mesh from the sphere, over 1 - cos(angle / 2), of the centre.
  const double radius = 1, reach = 1 / (2 * std::sin(std::numbers::pi / 12));
  for (const int n : {24, 64}) {
    const VoxelAxis axis =
        axis_of(solid_of(test::sphere_mesh({1, 2, 3}, radius, 5)), with(n, Thinning::none));
    double sagitta = 0;
    const TriangleMesh mesh = test::sphere_mesh({}, radius, 5);
    for (const auto& [a, b, c] : mesh.faces)
      sagitta = std::max(
          sagitta,
          radius - norm(1.0 / 3 * (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c])));
    ASSERT_FALSE(axis.voxels.empty());
    const double bound =
        axis.resolution * (1 + 1e-6) * reach + sagitta / (1 - std::cos(std::numbers::pi / 12));
    for (const Voxel& v : axis.voxels) EXPECT_LE(distance(v.center, {1, 2, 3}), bound) << n;
  }
}

TEST(Voxels, OfACylinderLieNearItsAxisAndCones) {
  const double radius = 1, height = 3;
  const VoxelAxis axis =
      axis_of(solid_of(test::cylinder_mesh(radius, height, 200)), with(60, Thinning::none));
  const double h = axis.resolution, side = height / 2 - radius;
  const double bound = 2 * h;  // tolerance / (2 sin(angle / 2)) is 1.93
  double lowest = 1e9, highest = -1e9;
  for (const Voxel& v : axis.voxels) {
    const double off = std::hypot(v.center.x, v.center.y), z = std::abs(v.center.z);
    // The line, and the cones from its ends to the rims.
    const double to_line = std::hypot(off, std::max(z - side, 0.0));
    const double to_cone = std::abs((z - height / 2) + (radius - off)) / std::numbers::sqrt2;
    EXPECT_LE(std::min(to_line, to_cone), bound);
    if (to_cone > 2 * h) {
      EXPECT_LE(off, 2 * h);
    }
    if (off < 2 * h) lowest = std::min(lowest, v.center.z), highest = std::max(highest, v.center.z);
  }
  EXPECT_LE(lowest, -side + 2 * h);
  EXPECT_GE(highest, side - 2 * h);
}

TEST(Voxels, OfAnExtrudedLetterAgreeWithThePlane) {
  // Half-way up a tall prism the axis is the one in the plane.
  const std::vector<std::string> rows = {"#####", "#....", "####.", "#....", "#####"};
  const int tall = 12;
  const Solid solid = solid_of(test::letter_mesh(rows, tall));
  const Ring outline{{{0, 0},
                      {5, 0},
                      {5, 1},
                      {1, 1},
                      {1, 2},
                      {4, 2},
                      {4, 3},
                      {1, 3},
                      {1, 4},
                      {5, 4},
                      {5, 5},
                      {0, 5}}};
  const auto shape = build_shape({&outline, 1});
  ASSERT_TRUE(shape.ok());
  const auto plane = compute(*shape);
  ASSERT_TRUE(plane.ok());
  VoxelOptions options = with(0);
  options.voxels = 128;
  options.resolution = 0.09;
  options.angle = 10;
  options.thinning = Thinning::none;
  const VoxelAxis axis = axis_of(solid, options);
  const double h = axis.resolution;
  const AxisLocator locator(*plane);
  std::vector<Vec2> layer;
  for (const Voxel& v : axis.voxels) {
    if (std::abs(v.center.z - tall / 2.0) > h) continue;
    layer.push_back({v.center.x, v.center.y});
    // The feet lie at an angle of 90 degrees or more, but between an edge and a reflex vertex.
    EXPECT_LE(locator.nearest({v.center.x, v.center.y}).distance, 1.5 * h);
    EXPECT_NEAR(v.radius, clearance(*shape, {v.center.x, v.center.y}), 1e-9);
  }
  int covered = 0;
  for (const Edge& edge : plane->edges) {
    for (const Disk& disk : sample_by_step(*plane, edge, h)) {
      if (disk.radius < 3 * h) continue;
      double best = 1e9;
      for (const Vec2 p : layer) best = std::min(best, distance(p, disk.center));
      EXPECT_LE(best, 2 * h);
      ++covered;
    }
  }
  EXPECT_GT(covered, 50);
}

TEST(Voxels, FollowingMissesNoMedialVoxel) {
  for (const Known& known : known_solids()) {
    const Solid solid = solid_of(known.mesh);
    const int n = 32;
    const volume::Grid grid = grid_of(solid, n);
    const VoxelAxis axis = axis_of(solid, with(n, Thinning::none));
    const VoxelSet found = set_of(axis.voxels, axis.cells);
    const volume::FaceTree tree(grid.vertices, grid.faces);
    const volume::FeetFinder finder(grid, tree, false, 30, 1 + 1e-6);
    volume::FeetFinder::Scratch scratch;
    const volume::Digitized digitized = volume::digitize(grid, [] { return false; });
    std::uint64_t medial = 0, missed = 0;
    volume::each_voxel(digitized.interior, [&](Cell cell) {
      const bool is = finder.feet(volume::center_of(cell), 0, scratch).medial();
      medial += is;
      missed += is && !found.contains(cell);
    });
    EXPECT_EQ(medial, axis.statistics.medial_voxels + missed) << known.name;
    // Near the rims of sheets, where feet lie at about the angle, islands may be left: they do here
    // on the prism of 40 sides, turned.
    EXPECT_LE(missed, known.name == std::string("cylinder") ? medial / 30 : 0) << known.name;
  }
}

TEST(Voxels, FindWhatTheAngleParts) {
  // A knob of 2 x 2 x 3 on a cube of 12: on the axis between them the feet, on the knob's edges,
  // lie at less than 20 degrees in the end.
  const Solid solid = solid_of(test::cubes_mesh(12, 12, 15, [](int x, int y, int z) {
    return z < 12 || (x >= 5 && x < 7 && y >= 5 && y < 7);
  }));
  const VoxelAxis axis = axis_of(solid, with(60));
  EXPECT_EQ(axis.topology, (VoxelTopology{1, 0, 0}));
  double best = 1e9;
  std::size_t in_knob = 0;
  for (const Voxel& v : axis.voxels) {
    if (std::isinf(v.quality)) continue;
    in_knob += v.center.z > 12;
    best = std::min(best, distance(v.center, {6, 6, 14}));
  }
  EXPECT_LE(best, axis.resolution);
  EXPECT_GT(in_knob, 100U);
}

/// Next to edges at which the surface turns by 9 degrees, voxels at the surface have two feet at
/// more than 30 as well. None of them is where following starts.
TEST(Voxels, OfATorusOfFlatFacesLieOnItsCircle) {
  const Solid solid = solid_of(test::torus_mesh(2, 0.6, 120, 40));
  const VoxelAxis axis = axis_of(solid, with(64, Thinning::curves));
  EXPECT_EQ(axis.topology, (VoxelTopology{1, 1, 0}));
  double farthest = 0;
  for (const Voxel& v : axis.voxels)
    farthest = std::max(farthest, std::hypot(std::hypot(v.center.x, v.center.y) - 2, v.center.z));
  EXPECT_LE(farthest, axis.resolution);
}

TEST(Voxels, OfRandomSolidsKeepPartsTunnelsAndCavities) {
  std::mt19937_64 random(12);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  int as_the_solid = 0, total = 0;
  for (int i = 0; i < 30; ++i) {
    TriangleMesh mesh;
    const double shift = between(-0.2, 0.2);
    switch (i % 5) {
      case 0:  // two linked rings
        mesh = test::torus_mesh(2, between(0.3, 0.7), 30, 12) +
               test::mapped(test::torus_mesh(2, between(0.3, 0.7), 24, 10), [=](Vec3 p) {
                 return Vec3{p.x + 2 + shift, p.z, p.y};
               });
        break;
      case 1:  // shells in shells
        mesh = test::sphere_mesh({}, 2, 3) + test::sphere_mesh({shift, 0, 0}, 1.5, 3) +
               test::sphere_mesh({0, shift, 0}, between(0.5, 1), 2);
        break;
      case 2:  // a potato
        mesh = test::mapped(test::sphere_mesh({}, 1, 3), [=](Vec3 p) {
          return (1 + shift * std::sin(5 * p.x) * std::cos(4 * p.y + 1)) * p;
        });
        break;
      case 3:  // a thin plate
        mesh = test::mapped(test::sphere_mesh({}, 1, 3), [=](Vec3 p) {
          return Vec3{p.x, p.y, p.z * (0.25 + shift)};
        });
        break;
      default:  // a ring with a spike
        mesh = test::torus_mesh(2, 0.5, 20, 8);
        mesh.vertices[7] = (2 + shift) * mesh.vertices[7];
    }
    const Solid solid = solid_of(test::turned(mesh));
    VoxelOptions options =
        with(16 + static_cast<int>(random() % 40), static_cast<Thinning>(random() % 3));
    options.angle = between(3, 80);
    const VoxelAxis axis = axis_of(solid, options);
    EXPECT_EQ(axis.topology, axis.interior) << i;
    EXPECT_EQ(volume::topology_of(set_of(axis.voxels, axis.cells)), axis.interior) << i;
    ++total;
    as_the_solid += axis.interior == solid.topology;
  }
  EXPECT_GE(as_the_solid, total / 2);  // the other grids are too coarse
}

TEST(Voxels, BothSearchesAndAnyNumberOfThreadsAgree) {
  for (const Known& known : known_solids()) {
    const Solid solid = solid_of(known.mesh);
    VoxelOptions options = with(24);
    const VoxelAxis one = axis_of(solid, options);
    EXPECT_FALSE(one.voxels.empty()) << known.name;
    options.threads = 1;
    EXPECT_TRUE(same(one, axis_of(solid, options))) << known.name;
    options.threads = 5;
    EXPECT_TRUE(same(one, axis_of(solid, options))) << known.name;
    options.sorted_list = true;
    EXPECT_TRUE(same(one, axis_of(solid, options))) << known.name;
    options.threads = 1;
    EXPECT_TRUE(same(one, axis_of(solid, options))) << known.name;
  }
}

TEST(Voxels, SmallAnglesGiveTheAxisOfTheFaces) {
  // A prism of 12 sides has 12 sheets to its edges, each turned by 30 degrees.
  const Solid solid = solid_of(test::cylinder_mesh(1, 2, 12));
  VoxelOptions options = with(48);
  options.angle = 5;
  const std::size_t all = axis_of(solid, options).voxels.size();
  options.angle = 40;
  const std::size_t smooth = axis_of(solid, options).voxels.size();
  EXPECT_GT(all, smooth + smooth / 4);
}

TEST(Voxels, OfThinPlatesThereMayBeNone) {
  const Solid solid = solid_of(test::box_mesh({0, 0, 0}, {8, 8, 0.1}));
  const VoxelAxis axis = axis_of(solid, with(16));
  EXPECT_TRUE(axis.voxels.empty());
  EXPECT_EQ(axis.topology, (VoxelTopology{0, 0, 0}));
  EXPECT_EQ(axis.statistics.bounded_sets, 0U);
  // One layer of voxels inside is enough.
  EXPECT_EQ(axis_of(solid, with(400)).topology, (VoxelTopology{1, 0, 0}));
}

TEST(Voxels, RefuseWhatTheyCannotDo) {
  const Solid solid = solid_of(test::sphere_mesh({}, 1, 3));
  const auto code = [&](const std::function<void(VoxelOptions&)>& change) {
    VoxelOptions options = with(64);
    change(options);
    const auto axis = compute_voxels(solid, options);
    return axis.ok() ? ErrorCode::internal : axis.error().code;
  };
  EXPECT_EQ(code([](VoxelOptions& o) { o.voxels = 3; }), ErrorCode::invalid_option);
  EXPECT_EQ(code([](VoxelOptions& o) { o.voxels = 5000; }), ErrorCode::invalid_option);
  EXPECT_EQ(code([](VoxelOptions& o) { o.angle = std::nan(""); }), ErrorCode::invalid_option);
  EXPECT_EQ(code([](VoxelOptions& o) { o.resolution = -1; }), ErrorCode::invalid_option);
  EXPECT_EQ(code([](VoxelOptions& o) { o.threads = -1; }), ErrorCode::invalid_option);
  EXPECT_EQ(code([](VoxelOptions& o) { o.resolution = 1e-9; }), ErrorCode::too_large);
  EXPECT_EQ(code([](VoxelOptions& o) { o.memory = 100'000; }), ErrorCode::too_large);
  std::atomic<bool> stop = true;
  EXPECT_EQ(code([&](VoxelOptions& o) { o.cancel = &stop; }), ErrorCode::cancelled);
  EXPECT_EQ(compute_voxels(Solid{}).error().code, ErrorCode::empty);
  Solid broken = solid;
  broken.surface.faces[0][0] = 1U << 30U;
  EXPECT_EQ(compute_voxels(broken).error().code, ErrorCode::malformed);
}

TEST(Voxels, CanBeCancelledAtAnyTimeAndTellTheirProgress) {
  const Solid solid = solid_of(test::turned(test::torus_mesh(2, 0.6, 60, 30)));
  std::vector<double> told;
  VoxelOptions options = with(48);
  options.progress = [&](double share) { told.push_back(share); };
  const VoxelAxis axis = axis_of(solid, options);
  ASSERT_GT(told.size(), 3U);
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_EQ(told.back(), 1);
  for (std::size_t i = 0; i < told.size(); ++i) {
    std::atomic<bool> stop = false;
    std::size_t calls = 0;
    options.cancel = &stop;
    options.progress = [&](double) {
      if (calls++ == i) stop = true;
    };
    const auto cancelled = compute_voxels(solid, options);
    if (!cancelled) {
      EXPECT_EQ(cancelled.error().code, ErrorCode::cancelled);
    } else {
      EXPECT_TRUE(i + 1 == told.size() && same(*cancelled, axis));
    }
  }
}

}  // namespace
}  // namespace medial
