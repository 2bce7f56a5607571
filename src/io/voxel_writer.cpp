// Axes of voxels: PLY, VTK, OBJ and pictures.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

#include "io/format_name.h"
#include "io/guarded.h"
#include "io/output.h"
#include "io/place.h"
#include "io/voxel_picture.h"
#include "medial/io/mesh.h"

namespace medial::io {

namespace {

constexpr std::array<std::string_view, 4> voxel_formats{"ply", "vtk", "obj", "png"};

/// Of bridges, which have no second foot, files tell -1.
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

void put_row(OutputStream& out, std::initializer_list<double> values) {
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
    put_row(out, {voxel.center.x, voxel.center.y, voxel.center.z});
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
  for (const Voxel& voxel : axis.voxels) put_row(out, {voxel.radius});
  out.put("SCALARS quality double 1\nLOOKUP_TABLE default\n");
  for (const Voxel& voxel : axis.voxels) put_row(out, {finite_quality(voxel)});
}

void write_obj(OutputStream& out, const VoxelAxis& axis) {
  out.put("# medial voxels: the links of the axis\n");
  for (const Voxel& voxel : axis.voxels) {
    out.put("v ");
    put_row(out, {voxel.center.x, voxel.center.y, voxel.center.z});
  }
  for (const auto& [from, to] : axis.links) {
    out.put("l ");
    out.put(from + std::uint64_t{1});
    out.put(' ');
    out.put(to + std::uint64_t{1});
    out.put('\n');
  }
}

Status write_stream(const std::string& path, const std::string& format, const VoxelAxis& axis,
                    const Solid& solid, double width) {
  Result<OutputStream> out = OutputStream::open(path);
  if (!out) return out.error();
  if (format == "ply") {
    write_ply(*out, axis);
  } else if (format == "vtk") {
    write_vtk(*out, axis);
  } else if (format == "obj") {
    write_obj(*out, axis);
  } else if (Status drawn = write_voxel_picture(*out, axis, solid, width); !drawn) {
    return drawn;
  }
  return out->finish();
}

Status write_any(const std::string& path, const std::string& option, const VoxelAxis& axis,
                 const Solid& solid, double width) {
  const std::string format = format_name(path, option);
  if (std::ranges::find(voxel_formats, format) == voxel_formats.end()) {
    return Error{
        ErrorCode::unsupported,
        fmt::format("'{}' is no format for voxels; known are {}", format, known_voxel_formats()),
        {}};
  }
  if (is_stream(path)) return write_stream(path, format, axis, solid, width);
  Result<PendingFile> pending = PendingFile::create(path);
  if (!pending) return pending.error();
  if (Status written = write_stream(pending->path(), format, axis, solid, width); !written)
    return written;
  return pending->commit();
}

}  // namespace

std::string known_voxel_formats() { return fmt::format(".{}", fmt::join(voxel_formats, " .")); }

Status write_voxels(const std::string& path, const std::string& format, const VoxelAxis& axis,
                    const Solid& solid, double width) {
  return guarded(path, [&] { return write_any(path, format, axis, solid, width); });
}

}  // namespace medial::io
