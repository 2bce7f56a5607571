#pragma once

// Readers of triangle meshes.

#include "io/format.h"

namespace medial::io {

/// Reads a PLY file, text or binary of either byte order: the coordinates x, y, z of the element
/// `vertex` and the list `vertex_indices` (or `vertex_index`) of `face`; what else there is, is
/// passed over. Polygons are cut into triangles. Takes memory for what is there, whatever the
/// header says. Errors: malformed, not_finite, unreadable, unsupported, empty (no face).
Result<TriangleMesh> read_ply(const Input& input);

/// Reads OBJ and STL. Errors: malformed, empty (no face).
Result<TriangleMesh> read_by_assimp(const Input& input);

}  // namespace medial::io
