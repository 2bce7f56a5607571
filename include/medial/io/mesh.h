#pragma once

#include <string>

#include "medial/error.h"
#include "medial/volume.h"

namespace medial::io {

/// Reads the triangles of a mesh by the extension of `path`: .obj and .stl through Assimp, which
/// holds coordinates in single precision; .ply and .off, also compressed by gzip inside, in double
/// precision. Polygons are cut into triangles. Errors: unreadable, malformed, not_finite, empty,
/// unsupported (another format, faces of more than 1,024 corners, or a build without Assimp).
Result<TriangleMesh> read_mesh(const std::string& path);

/// Writes an axis of voxels by the extension of `path`; `-` is standard output and takes `format`
/// (an extension without its dot). .ply (binary) has vertices with radius and quality, and edges;
/// .vtk (legacy, text) points with radius and quality, and lines; .obj points and lines; .png shows
/// solid and axis from three sides, `width` pixels wide. Errors: unsupported, unwritable,
/// invalid_option (the width).
Status write_voxels(const std::string& path, const std::string& format, const VoxelAxis& axis,
                    const Solid& solid, double width = 1536);

}  // namespace medial::io
