// Meshes from files, axes of voxels to files.

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "medial/io/mesh.h"
#include "support/solids.h"

namespace medial {
namespace {

namespace fs = std::filesystem;

class MeshFiles : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("medial_mesh_") + test->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    const fs::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }
  std::string read(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  fs::path folder_;
};

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
  for (const std::string format : {"obj", "stl", "ply", "off"}) {
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
  const std::string ply = read("axis.ply");
  const std::size_t body = ply.find("end_header\n") + 11;
  EXPECT_EQ(ply.size() - body, voxels * 5 * 8 + links * 2 * 4);
  double first[5];
  std::memcpy(first, ply.data() + body, sizeof first);
  EXPECT_EQ(first[0], axis->voxels[0].center.x);
  EXPECT_EQ(first[3], axis->voxels[0].radius);

  std::istringstream obj(read("axis.obj"));
  std::size_t points = 0, lines = 0;
  for (std::string line; std::getline(obj, line);) {
    points += line.starts_with("v ");
    lines += line.starts_with("l ");
  }
  EXPECT_EQ(points, voxels);
  EXPECT_EQ(lines, links);

  const std::string vtk = read("axis.vtk");
  EXPECT_NE(vtk.find("POINTS " + std::to_string(voxels) + " double"), std::string::npos);
  EXPECT_NE(vtk.find("LINES " + std::to_string(links) + ' ' + std::to_string(3 * links)),
            std::string::npos);
  EXPECT_NE(vtk.find("SCALARS radius double 1"), std::string::npos);
  EXPECT_EQ(read("axis.png").substr(1, 3), "PNG");

  EXPECT_EQ(io::write_voxels(path("axis.txt"), "", *axis, *solid).error().code,
            ErrorCode::unsupported);
  EXPECT_EQ(io::write_voxels(path("axis.png"), "", *axis, *solid, 1e9).error().code,
            ErrorCode::invalid_option);
  EXPECT_EQ(io::write_voxels(path("no/axis.ply"), "", *axis, *solid).error().code,
            ErrorCode::unwritable);
}

TEST_F(MeshFiles, OfTheDataFolderHaveTheirTopology) {
  const fs::path spot = fs::path(MEDIAL_SOURCE_DIR) / "../shared/data/in_place/D_3d/spot.obj";
  if (!fs::exists(spot)) GTEST_SKIP() << "no such data here";
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
