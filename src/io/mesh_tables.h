#pragma once

#include "io/text_source.h"
#include "medial/volume.h"

namespace medial::io {

/// Reads a PLY file, text or binary of either byte order: the coordinates x, y, z of the element
/// `vertex` and the list `vertex_indices` (or `vertex_index`) of `face`; what else there is, is
/// passed over. Polygons are cut into triangles. Takes memory for what is there, whatever the
/// header says. Errors: malformed, not_finite, unreadable, unsupported, empty (no face).
Result<TriangleMesh> read_ply(TextSource& source);

/// Reads an OFF file, text, with or without colours and normals, which are passed over. Errors: as
/// read_ply(); unsupported are binary ones and those of other dimensions.
Result<TriangleMesh> read_off(TextSource& source);

}  // namespace medial::io
