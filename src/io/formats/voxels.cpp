// Axes of solids as points, lines and triangles: PLY, VTK, OBJ and binary glTF.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "io/formats/meshes.h"

namespace medial::io {

namespace {

/// What is written: the surface, where there is one, or the voxels.
struct Model {
  double resolution = 0;
  std::vector<Vec3> points;
  std::vector<double> radii;
  std::vector<double> qualities;  ///< of voxels only; -1 for bridges, which have no second foot
  std::span<const std::array<std::uint32_t, 3>> triangles;
  std::span<const std::array<std::uint32_t, 2>> lines;
};

Model model_of(const VoxelAxis& axis) {
  const AxisSurface& surface = axis.surface;
  if (!surface.vertices.empty())
    return {axis.resolution, surface.vertices, surface.radii, {}, surface.triangles, surface.lines};
  Model model{axis.resolution, {}, {}, {}, {}, axis.links};
  for (const Voxel& voxel : axis.voxels) {
    model.points.push_back(voxel.center);
    model.radii.push_back(voxel.radius);
    model.qualities.push_back(std::isfinite(voxel.quality) ? voxel.quality : -1);
  }
  return model;
}

template <class Number>
void put_binary(OutputStream& out, Number value) {
  std::array<char, sizeof(Number)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(Number));
  if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
  out.put(std::string_view(bytes.data(), bytes.size()));
}

template <class Number, std::size_t N>
void put_binary(OutputStream& out, const std::array<Number, N>& values) {
  for (const Number value : values) put_binary(out, value);
}

void write_ply(OutputStream& out, const Model& model) {
  const bool has_qualities = !model.qualities.empty();
  out.put(fmt::format(
      "ply\n"
      "format binary_little_endian 1.0\n"
      "comment medial voxels, resolution {}\n"
      "element vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n"
      "property double radius\n{}",
      model.resolution, model.points.size(), has_qualities ? "property double quality\n" : ""));
  if (!model.triangles.empty())
    out.put(fmt::format("element face {}\nproperty list uchar int vertex_indices\n",
                        model.triangles.size()));
  out.put(fmt::format("element edge {}\nproperty int vertex1\nproperty int vertex2\nend_header\n",
                      model.lines.size()));
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const Vec3 p = model.points[i];
    put_binary(out, std::array{p.x, p.y, p.z, model.radii[i]});
    if (has_qualities) put_binary(out, model.qualities[i]);
  }
  for (const auto& triangle : model.triangles) {
    out.put('\3');
    put_binary(out, triangle);
  }
  for (const auto& line : model.lines) put_binary(out, line);
}

/// Numbers, apart by blanks, as a line.
template <class... Numbers>
void put_numbers(OutputStream& out, std::string_view first, Numbers... numbers) {
  out.put(first);
  ((out.put(' '), out.put(numbers)), ...);
  out.put('\n');
}

void put_point(OutputStream& out, Vec3 p) {
  out.put(p.x);
  put_numbers(out, "", p.y, p.z);
}

void write_vtk(OutputStream& out, const Model& model) {
  const std::size_t points = model.points.size(), lines = model.lines.size(),
                    triangles = model.triangles.size();
  out.put(fmt::format(
      "# vtk DataFile Version 3.0\nmedial voxels, resolution {}\nASCII\nDATASET POLYDATA\n"
      "POINTS {} double\n",
      model.resolution, points));
  for (const Vec3 p : model.points) put_point(out, p);
  out.put(fmt::format("VERTICES {} {}\n", points, 2 * points));
  for (std::size_t i = 0; i < points; ++i) put_numbers(out, "1", i);
  if (lines > 0) out.put(fmt::format("LINES {} {}\n", lines, 3 * lines));
  for (const auto& [from, to] : model.lines) put_numbers(out, "2", from, to);
  if (triangles > 0) out.put(fmt::format("POLYGONS {} {}\n", triangles, 4 * triangles));
  for (const auto& [a, b, c] : model.triangles) put_numbers(out, "3", a, b, c);
  // Data of points only; VTK numbers cells by vertices first, then lines.
  const auto put_column = [&](std::string_view name, const std::vector<double>& values) {
    out.put(fmt::format("SCALARS {} double 1\nLOOKUP_TABLE default\n", name));
    for (const double value : values) {
      out.put(value);
      out.put('\n');
    }
  };
  out.put(fmt::format("POINT_DATA {}\n", points));
  put_column("radius", model.radii);
  if (!model.qualities.empty()) put_column("quality", model.qualities);
}

/// The radius of a triangle's vertex is its texture coordinate.
void write_obj(OutputStream& out, const Model& model) {
  out.put("# medial voxels: the links of the axis\n");
  for (const Vec3 p : model.points) put_numbers(out, "v", p.x, p.y, p.z);
  if (!model.triangles.empty())
    for (const double radius : model.radii) put_numbers(out, "vt", radius);
  for (const auto& [a, b, c] : model.triangles)
    out.put(fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", a + 1, b + 1, c + 1));
  for (const auto& [from, to] : model.lines)
    put_numbers(out, "l", from + std::uint64_t{1}, to + std::uint64_t{1});
}

/// The document of a glTF file with one buffer: positions, radii, then indices.
std::string gltf_of(const Model& model) {
  using nlohmann::json;
  constexpr int floats = 5126, integers = 5125, vertices = 34962, indices = 34963;
  constexpr int as_points = 0, as_lines = 1, as_triangles = 4;
  json root = {{"asset", {{"version", "2.0"}, {"generator", "medial voxels"}}},
               {"scene", 0},
               {"scenes", {{{"nodes", {0}}}}},
               {"nodes", {{{"mesh", 0}}}}};
  std::size_t size = 0;
  const auto add = [&](std::size_t count, std::size_t bytes, int type, const char* kind,
                       int target) {
    root["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", size}, {"byteLength", count * bytes}, {"target", target}});
    root["accessors"].push_back({{"bufferView", root["bufferViews"].size() - 1},
                                 {"componentType", type},
                                 {"count", count},
                                 {"type", kind}});
    size += count * bytes;
    return root["accessors"].size() - 1;
  };
  const json attributes = {{"POSITION", add(model.points.size(), 12, floats, "VEC3", vertices)},
                           {"_RADIUS", add(model.radii.size(), 4, floats, "SCALAR", vertices)}};
  std::array<float, 3> low, high;
  low.fill(std::numeric_limits<float>::infinity());
  high.fill(-std::numeric_limits<float>::infinity());
  for (const Vec3 p : model.points) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], static_cast<float>(p[static_cast<int>(k)]));
      high[k] = std::max(high[k], static_cast<float>(p[static_cast<int>(k)]));
    }
  }
  root["accessors"][0]["min"] = low;
  root["accessors"][0]["max"] = high;
  json& primitives = root["meshes"][0]["primitives"];
  const auto add_primitive = [&](std::size_t count, int mode) {
    if (count > 0)
      primitives.push_back({{"attributes", attributes},
                            {"mode", mode},
                            {"indices", add(count, 4, integers, "SCALAR", indices)}});
  };
  add_primitive(3 * model.triangles.size(), as_triangles);
  add_primitive(2 * model.lines.size(), as_lines);
  if (primitives.empty()) primitives.push_back({{"attributes", attributes}, {"mode", as_points}});
  root["buffers"] = {{{"byteLength", size}}};
  return root.dump();
}

void write_glb(OutputStream& out, const Model& model) {
  constexpr std::uint32_t magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
  std::string text = gltf_of(model);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t bytes =
      16 * model.points.size() + 12 * model.triangles.size() + 8 * model.lines.size();
  const auto put_word = [&](std::size_t word) {
    put_binary(out, static_cast<std::uint32_t>(word));
  };
  for (const std::size_t word : {std::size_t{magic}, std::size_t{2}, text.size() + bytes + 28,
                                 text.size(), std::size_t{json_chunk}})
    put_word(word);
  out.put(text);
  put_word(bytes);
  put_word(binary_chunk);
  for (const Vec3 p : model.points)
    for (const double value : {p.x, p.y, p.z}) put_binary(out, static_cast<float>(value));
  for (const double radius : model.radii) put_binary(out, static_cast<float>(radius));
  for (const auto& triangle : model.triangles) put_binary(out, triangle);
  for (const auto& line : model.lines) put_binary(out, line);
}

template <void (*put)(OutputStream&, const Model&)>
Status write_model(Target& target, const VoxelsOutput& output) {
  put(*target.out, model_of(output.axis));
  return success();
}

}  // namespace

Format ply_format() {
  Format format{".ply"};
  format.read_mesh = read_ply;
  return format.writes<VoxelsOutput>(write_model<write_ply>);
}

Format vtk_format() { return Format{".vtk"}.writes<VoxelsOutput>(write_model<write_vtk>); }

Format obj_format() { return Format{".obj"}.writes<VoxelsOutput>(write_model<write_obj>); }

Format glb_format() { return Format{".glb"}.writes<VoxelsOutput>(write_model<write_glb>); }

}  // namespace medial::io
