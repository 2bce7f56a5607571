// Meshes from files, axes of voxels to files.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "base/vec3.h"
#include "medial/io/read.h"
#include "medial/io/write.h"
#include "support/environment.h"
#include "support/scratch_folder.h"
#include "support/solids.h"

namespace medial {
namespace {

namespace fs = std::filesystem;

using MeshFiles = test::ScratchFolder;

/// The formats that this build reads.
#ifdef MEDIAL_MESH
const std::vector<std::string> formats = {"obj", "stl", "ply", "off"};
#else
const std::vector<std::string> formats = {"ply", "off"};
#endif

/// The mesh as text in each format that is read.
std::string text_of(const TriangleMesh& mesh, const std::string& format) {
  std::ostringstream out;
  if (format == "stl") {
    out << "solid medial\n";
    for (const auto& face : mesh.faces) {
      out << "facet normal 0 0 0\nouter loop\n";
      for (const std::uint32_t v : face)
        out << "vertex " << mesh.vertices[v].x << ' ' << mesh.vertices[v].y << ' '
            << mesh.vertices[v].z << '\n';
      out << "endloop\nendfacet\n";
    }
    out << "endsolid medial\n";
    return out.str();
  }
  if (format == "ply")
    out << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.size()
        << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
        << mesh.faces.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  if (format == "off") out << "OFF\n" << mesh.vertices.size() << ' ' << mesh.faces.size() << " 0\n";
  const bool obj = format == "obj";
  for (const Vec3 p : mesh.vertices)
    out << (obj ? "v " : "") << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const auto& [a, b, c] : mesh.faces)
    out << (obj ? "f " : "3 ") << a + obj << ' ' << b + obj << ' ' << c + obj << '\n';
  return out.str();
}

TEST_F(MeshFiles, OfEveryFormatAreRead) {
  const TriangleMesh mesh = test::cubes_mesh(2, 1, 1, [](int, int, int) { return true; });
  for (const std::string& format : formats) {
    auto read = io::read_mesh(write("two_cubes." + format, text_of(mesh, format)));
    ASSERT_TRUE(read.ok()) << to_string(read.error());
    EXPECT_EQ(read->faces.size(), 20U) << format;
    const auto solid = build_solid(std::move(read).value());
    ASSERT_TRUE(solid.ok()) << format << ": " << to_string(solid.error());
    EXPECT_EQ(solid->surface.vertices.size(), 12U) << format;
    EXPECT_EQ(solid->topology, (VoxelTopology{1, 0, 0})) << format;
    double high = 0;
    for (const Vec3 p : solid->surface.vertices) high = std::max(high, p.x);
    EXPECT_EQ(high, 2) << format;
  }
}

TEST_F(MeshFiles, ThatAreNoneAreRefused) {
  const auto code = [](const std::string& path) {
    const auto mesh = io::read_mesh(path);
    EXPECT_FALSE(mesh.ok()) << path;
    if (mesh.ok()) return ErrorCode::internal;
    EXPECT_EQ(mesh.error().place.file, path);
    return mesh.error().code;
  };
  EXPECT_EQ(code(path("missing.obj")), ErrorCode::unreadable);
  EXPECT_EQ(code(write("mesh.xyz", "0 0 0\n")), ErrorCode::unsupported);
  EXPECT_EQ(code(write("no.ply", "plywood")), ErrorCode::malformed);
  EXPECT_EQ(code(write("no.off", "OFF\n3 1 0\n0 0\n")), ErrorCode::malformed);
  for (const std::string name : {"empty.obj", "empty.stl", "empty.ply", "empty.off"})
    (void)code(write(name, ""));
}

/// A binary PLY file with coordinates of either precision, and a property beside them.
template <class Real>
std::string binary_ply(const TriangleMesh& mesh, std::endian order) {
  const bool little = order == std::endian::little;
  std::ostringstream head;
  head << "ply\nformat binary_" << (little ? "little" : "big")
       << "_endian 1.0\ncomment none\nelement vertex " << mesh.vertices.size();
  for (const char axis : {'x', 'y', 'z'})
    head << "\nproperty " << (sizeof(Real) == 8 ? "double " : "float ") << axis;
  head << "\nproperty short weight\nelement face " << mesh.faces.size()
       << "\nproperty list uchar uint vertex_index\nend_header\n";
  std::string text = head.str();
  const auto put = [&](auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (order != std::endian::native) std::reverse(bytes, bytes + sizeof value);
    text.append(bytes, sizeof value);
  };
  for (const Vec3 p : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) put(static_cast<Real>(p[axis]));
    put(std::int16_t{-3});
  }
  for (const auto& face : mesh.faces) {
    put(std::uint8_t{3});
    for (const std::uint32_t corner : face) put(corner);
  }
  return text;
}

TEST_F(MeshFiles, InBinaryPlyKeepTheirDigits) {
  const TriangleMesh mesh = test::box_mesh({0.1, 0.2, 0.3}, {1, 2, 1.0 / 3});
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const auto exact = io::read_mesh(write("double.ply", binary_ply<double>(mesh, order)));
    ASSERT_TRUE(exact.ok()) << to_string(exact.error());
    EXPECT_EQ(exact->vertices, mesh.vertices);
    EXPECT_EQ(exact->faces, mesh.faces);
    const auto rounded = io::read_mesh(write("single.ply", binary_ply<float>(mesh, order)));
    ASSERT_TRUE(rounded.ok()) << to_string(rounded.error());
    EXPECT_EQ(rounded->faces, mesh.faces);
    EXPECT_EQ(rounded->vertices[0].x, double(float(mesh.vertices[0].x)));
  }
}

TEST_F(MeshFiles, OfPolygonsAreCutIntoTriangles) {
  // A prism over an L: two polygons that are not convex, and six of four corners.
  const std::vector<Vec2> outline = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
  std::ostringstream vertices, faces;
  for (const int z : {0, 1})
    for (const Vec2 p : outline) vertices << p.x << ' ' << p.y << ' ' << z << " 255 0 0 # red\n";
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t next = (k + 1) % 6;
    faces << "4 " << k << ' ' << next << ' ' << next + 6 << ' ' << k + 6 << "  0.5 0.5 0.5\n";
  }
  faces << "6 5 4 3 2 1 0\n6 6 7 8 9 10 11\n";
  for (const std::string head : {"COFF\n# a prism\n12 8 18\n", "OFF 12 8 0\n"}) {
    const auto mesh = io::read_mesh(write("prism.off", head + vertices.str() + faces.str()));
    ASSERT_TRUE(mesh.ok()) << to_string(mesh.error());
    EXPECT_EQ(mesh->faces.size(), 20U);
    const auto solid = build_solid(*mesh);
    ASSERT_TRUE(solid.ok()) << to_string(solid.error());
    double six = 0;
    for (const auto& [a, b, c] : solid->surface.faces)
      six += dot(solid->surface.vertices[a],
                 cross(solid->surface.vertices[b], solid->surface.vertices[c]));
    EXPECT_EQ(six, 6 * 4.0);
  }
}

TEST_F(MeshFiles, OfLargeFacesAreCutInTheSquareOfTheirCorners) {
  // A spiral of 1,024 corners has two ears at a time; a star polygon crosses itself everywhere.
  constexpr int corners = 1024, half = corners / 2;
  const auto text = [&](auto point) {
    std::ostringstream out;
    out << "OFF " << corners << " 1 0\n";
    for (int k = 0; k < corners; ++k) {
      const Vec2 p = point(k);
      out << p.x << ' ' << p.y << " 1\n";
    }
    out << corners;
    for (int k = 0; k < corners; ++k) out << ' ' << k;
    return out.str();
  };
  const auto on_spiral = [](double turn, double radius) {
    return Vec2{radius * std::cos(turn), radius * std::sin(turn)};
  };
  const auto spiral =
      io::read_mesh(write("spiral.off", text([&](int k) {
                            const double turn = 0.2 * (k < half ? k : corners - 1 - k);
                            return on_spiral(turn, 1 + turn + (k < half ? 0.0 : 2.0));
                          })));
  ASSERT_TRUE(spiral.ok()) << to_string(spiral.error());
  EXPECT_EQ(spiral->faces.size(), corners - 2U);
  // Triangles that all turn one way and together have the polygon's area lie side by side.
  double area = 0, size = 0;
  for (const auto& [a, b, c] : spiral->faces) {
    const Vec3 normal =
        cross(spiral->vertices[b] - spiral->vertices[a], spiral->vertices[c] - spiral->vertices[a]);
    area += normal.z / 2;
    size += std::abs(normal.z) / 2;
  }
  double expected = 0;
  for (std::size_t k = 0; k < corners; ++k)
    expected += cross(spiral->vertices[k], spiral->vertices[(k + 1) % corners]).z / 2;
  EXPECT_NEAR(area, expected, 1e-9 * size);
  EXPECT_NEAR(size, std::abs(area), 1e-9 * size);

  const auto star = io::read_mesh(
      write("star.off", text([&](int k) { return on_spiral(k * 511 * 6.283185307 / 1024, 1); })));
  ASSERT_TRUE(star.ok()) << to_string(star.error());
  EXPECT_EQ(star->faces.size(), corners - 2U);

  // Coordinates that nothing can be decided on in time.
  const auto huge = io::read_mesh(write(
      "huge.off", text([&](int k) { return on_spiral(k * 0.006, k % 2 == 0 ? 1e308 : 1e-300); })));
  ASSERT_FALSE(huge.ok());
  EXPECT_EQ(huge.error().code, ErrorCode::unsupported);
}

TEST_F(MeshFiles, ThatAreDamagedAreReadOrRefused) {
  // Cut off anywhere, with counts and bytes changed: a mesh, or an error that is not our fault.
  const TriangleMesh mesh = test::box_mesh({0, 0, 0}, {4, 3, 2});
  std::mt19937_64 random(11);
  int refused = 0, read = 0;
  const auto try_to_read = [&](const std::string& name, const std::string& text) {
    const auto result = io::read_mesh(write(name, text));
    ++(result.ok() ? read : refused);
    if (result.ok()) {
      (void)build_solid(*result);
      return;
    }
    EXPECT_NE(result.error().code, ErrorCode::internal) << to_string(result.error());
    EXPECT_NE(result.error().code, ErrorCode::out_of_memory) << to_string(result.error());
  };
  const std::vector<std::pair<std::string, std::string>> files = {
      {"mesh.off", text_of(mesh, "off")},
      {"mesh.ply", text_of(mesh, "ply")},
      {"mesh.ply", binary_ply<float>(mesh, std::endian::little)},
      {"mesh.ply", binary_ply<double>(mesh, std::endian::big)},
      {"mesh.obj", text_of(mesh, "obj")},
      {"mesh.stl", text_of(mesh, "stl")}};
  for (const auto& [name, text] : files) {
    const bool own = name != "mesh.obj" && name != "mesh.stl";  // not through Assimp, which is slow
    for (std::size_t length = 0; length < text.size(); length += own ? 1 : 37)
      try_to_read(name, text.substr(0, length));
    for (int i = 0; i < (own ? 300 : 30); ++i) {
      std::string changed = text;
      for (auto n = 1 + random() % 8; n > 0; --n)
        changed[random() % changed.size()] = static_cast<char>(random());
      try_to_read(name, changed);
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(read, 10);
  // A file that claims too many elements takes no memory.
  std::string large = text_of(mesh, "ply");
  large.replace(large.find("face 12"), 7, "face 2000000000");
  EXPECT_EQ(io::read_mesh(write("large.ply", large)).error().code, ErrorCode::malformed);
  EXPECT_EQ(io::read_mesh(write("large.off", "OFF\n2000000000 2000000000 0\n")).error().code,
            ErrorCode::malformed);
  for (const std::string number : {"nan", "-inf", "1e999"}) {
    std::string text = text_of(mesh, "off");
    text.replace(text.find("4 "), 1, number);
    EXPECT_EQ(io::read_mesh(write("number.off", text)).error().code, ErrorCode::not_finite);
  }
}

TEST_F(MeshFiles, HoldTheAxis) {
  const auto solid = build_solid(test::box_mesh({0, 0, 0}, {4, 3, 2}));
  ASSERT_TRUE(solid.ok());
  VoxelOptions options;
  options.voxels = 20;
  const auto axis = compute_voxels(*solid, options);
  ASSERT_TRUE(axis.ok());
  const std::size_t voxels = axis->voxels.size(), links = axis->links.size();
  ASSERT_GT(voxels, 50U);
  for (const std::string format : {"ply", "vtk", "obj", "png"}) {
    const Status written = io::write_voxels(path("axis." + format), "", *axis, *solid, 300);
    ASSERT_TRUE(written.ok()) << to_string(written.error());
  }
  const std::string ply = content("axis.ply");
  const std::size_t body = ply.find("end_header\n") + 11;
  EXPECT_EQ(ply.size() - body, voxels * 5 * 8 + links * 2 * 4);
  double first[5];
  std::memcpy(first, ply.data() + body, sizeof first);
  EXPECT_EQ(first[0], axis->voxels[0].center.x);
  EXPECT_EQ(first[3], axis->voxels[0].radius);

  std::istringstream obj(content("axis.obj"));
  std::size_t points = 0, lines = 0;
  for (std::string line; std::getline(obj, line);) {
    points += line.starts_with("v ");
    lines += line.starts_with("l ");
  }
  EXPECT_EQ(points, voxels);
  EXPECT_EQ(lines, links);

  const std::string vtk = content("axis.vtk");
  EXPECT_NE(vtk.find("POINTS " + std::to_string(voxels) + " double"), std::string::npos);
  EXPECT_NE(vtk.find("LINES " + std::to_string(links) + ' ' + std::to_string(3 * links)),
            std::string::npos);
  EXPECT_NE(vtk.find("SCALARS radius double 1"), std::string::npos);
  EXPECT_EQ(content("axis.png").substr(1, 3), "PNG");

  EXPECT_EQ(io::write_voxels(path("axis.txt"), "", *axis, *solid).error().code,
            ErrorCode::unsupported);
  EXPECT_EQ(io::write_voxels(path("axis.png"), "", *axis, *solid, 1e9).error().code,
            ErrorCode::invalid_option);
  EXPECT_EQ(io::write_voxels(path("no/axis.ply"), "", *axis, *solid).error().code,
            ErrorCode::unwritable);
}

TEST_F(MeshFiles, HoldTheSurface) {
  const auto solid = build_solid(test::box_mesh({0, 0, 0}, {4, 3, 2}));
  ASSERT_TRUE(solid.ok());
  VoxelOptions options;
  options.voxels = 20;
  options.surface = true;
  const auto axis = compute_voxels(*solid, options);
  ASSERT_TRUE(axis.ok());
  const AxisSurface& surface = axis->surface;
  const std::size_t points = surface.vertices.size(), triangles = surface.triangles.size(),
                    lines = surface.lines.size();
  ASSERT_GT(triangles, 50U);
  for (const std::string format : {"ply", "vtk", "obj", "glb", "png"}) {
    const Status written = io::write_voxels(path("axis." + format), "", *axis, *solid, 300);
    ASSERT_TRUE(written.ok()) << to_string(written.error());
  }
  // Files written as triangles are read as triangles.
  const auto read = io::read_mesh(path("axis.ply"));
  ASSERT_TRUE(read.ok()) << to_string(read.error());
  EXPECT_EQ(read->vertices, surface.vertices);
  EXPECT_EQ(read->faces, surface.triangles);

  const std::string obj = content("axis.obj"), vtk = content("axis.vtk"), glb = content("axis.glb");
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(obj, '/')), 3 * triangles);
  EXPECT_NE(vtk.find("POLYGONS " + std::to_string(triangles)), std::string::npos);
  // Binary glTF: a header of 12 bytes, then chunks, each with its size and kind before it.
  std::uint32_t words[5];
  ASSERT_GT(glb.size(), sizeof words);
  std::memcpy(words, glb.data(), sizeof words);
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(words[1], 2U);
  EXPECT_EQ(words[2], glb.size());
  EXPECT_EQ(words[3] % 4, 0U);
  EXPECT_EQ(glb.size(), 28 + words[3] + 16 * points + 12 * triangles + 8 * lines);
  float first[3];
  std::memcpy(first, glb.data() + 28 + words[3], sizeof first);
  EXPECT_EQ(first[0], static_cast<float>(surface.vertices[0].x));
  EXPECT_EQ(content("axis.png").substr(1, 3), "PNG");
}

TEST_F(MeshFiles, OfTheDataFolderHaveTheirTopology) {
  const fs::path spot = test::data_folder() / "in_place/D_3d/spot.obj";
  if (!fs::exists(spot)) GTEST_SKIP() << "no such data here";
  if (formats[0] != "obj") GTEST_SKIP() << "built without Assimp";
  auto mesh = io::read_mesh(spot.string());
  ASSERT_TRUE(mesh.ok()) << to_string(mesh.error());
  const auto solid = build_solid(std::move(mesh).value());
  ASSERT_TRUE(solid.ok()) << to_string(solid.error());
  EXPECT_EQ(solid->surface.faces.size(), 5856U);
  EXPECT_EQ(solid->surface.vertices.size(), 2930U);
  VoxelOptions options;
  options.voxels = 64;
  const auto axis = compute_voxels(*solid, options);
  ASSERT_TRUE(axis.ok());
  EXPECT_EQ(axis->topology, (VoxelTopology{1, 0, 0}));
  EXPECT_EQ(axis->interior, axis->topology);
}

}  // namespace
}  // namespace medial
