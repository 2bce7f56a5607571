// Axes of voxels as points and lines: PLY, VTK and OBJ.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

#include "io/formats/meshes.h"

namespace medial::io {

namespace {

/// -1 for bridges, which have no second foot.
double finite_quality(const Voxel& voxel) {
  return std::isfinite(voxel.quality) ? voxel.quality : -1;
}

template <class Number>
void put_binary(OutputStream& out, Number value) {
  std::array<char, sizeof(Number)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(Number));
  if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
  out.put(std::string_view(bytes.data(), bytes.size()));
}

void write_ply(OutputStream& out, const VoxelAxis& axis) {
  out.put(
      fmt::format("ply\n"
                  "format binary_little_endian 1.0\n"
                  "comment medial voxels, resolution {}\n"
                  "element vertex {}\n"
                  "property double x\nproperty double y\nproperty double z\n"
                  "property double radius\nproperty double quality\n"
                  "element edge {}\n"
                  "property int vertex1\nproperty int vertex2\n"
                  "end_header\n",
                  axis.resolution, axis.voxels.size(), axis.links.size()));
  for (const Voxel& voxel : axis.voxels)
    for (const double value :
         {voxel.center.x, voxel.center.y, voxel.center.z, voxel.radius, finite_quality(voxel)})
      put_binary(out, value);
  for (const auto& link : axis.links)
    for (const std::uint32_t end : link) put_binary(out, end);
}

void put_numbers(OutputStream& out, std::initializer_list<double> values) {
  bool first = true;
  for (const double value : values) {
    if (!first) out.put(' ');
    first = false;
    out.put(value);
  }
  out.put('\n');
}

void write_vtk(OutputStream& out, const VoxelAxis& axis) {
  out.put(fmt::format(
      "# vtk DataFile Version 3.0\nmedial voxels, resolution {}\nASCII\nDATASET POLYDATA\n"
      "POINTS {} double\n",
      axis.resolution, axis.voxels.size()));
  for (const Voxel& voxel : axis.voxels)
    put_numbers(out, {voxel.center.x, voxel.center.y, voxel.center.z});
  const std::size_t voxels = axis.voxels.size(), links = axis.links.size();
  out.put(fmt::format("VERTICES {} {}\n", voxels, 2 * voxels));
  for (std::size_t i = 0; i < voxels; ++i) {
    out.put("1 ");
    out.put(i);
    out.put('\n');
  }
  if (links > 0) out.put(fmt::format("LINES {} {}\n", links, 3 * links));
  for (const auto& [from, to] : axis.links) {
    out.put("2 ");
    out.put(from);
    out.put(' ');
    out.put(to);
    out.put('\n');
  }
  // Data of points only; VTK numbers cells by vertices first, then lines.
  out.put(fmt::format("POINT_DATA {}\nSCALARS radius double 1\nLOOKUP_TABLE default\n", voxels));
  for (const Voxel& voxel : axis.voxels) put_numbers(out, {voxel.radius});
  out.put("SCALARS quality double 1\nLOOKUP_TABLE default\n");
  for (const Voxel& voxel : axis.voxels) put_numbers(out, {finite_quality(voxel)});
}

void write_obj(OutputStream& out, const VoxelAxis& axis) {
  out.put("# medial voxels: the links of the axis\n");
  for (const Voxel& voxel : axis.voxels) {
    out.put("v ");
    put_numbers(out, {voxel.center.x, voxel.center.y, voxel.center.z});
  }
  for (const auto& [from, to] : axis.links) {
    out.put("l ");
    out.put(from + std::uint64_t{1});
    out.put(' ');
    out.put(to + std::uint64_t{1});
    out.put('\n');
  }
}

template <void (*put)(OutputStream&, const VoxelAxis&)>
Status write_voxel_table(Target& target, const VoxelsOutput& output) {
  put(*target.out, output.axis);
  return success();
}

}  // namespace

Format ply_format() {
  Format format{".ply"};
  format.read_mesh = read_ply;
  return format.writes<VoxelsOutput>(write_voxel_table<write_ply>);
}

Format vtk_format() { return Format{".vtk"}.writes<VoxelsOutput>(write_voxel_table<write_vtk>); }

Format obj_format() { return Format{".obj"}.writes<VoxelsOutput>(write_voxel_table<write_obj>); }

}  // namespace medial::io
