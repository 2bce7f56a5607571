#pragma once

#include "io/output.h"
#include "medial/volume.h"

namespace medial::io {

/// Draws a solid, faintly, and the voxels of its axis, coloured by radius, from three sides.
/// Errors: invalid_option (the width), unwritable.
Status write_voxel_picture(OutputStream& out, const VoxelAxis& axis, const Solid& solid,
                           double width);

}  // namespace medial::io
