#pragma once

// The axis as a surface: sheets as triangles, curves as lines.

#include <vector>

#include "volume/control.h"
#include "volume/feet.h"
#include "volume/follow.h"
#include "volume/voxel_set.h"

namespace medial::volume {

/// The axis as a surface, in units of the grid. `kept` are the voxels of the axis before thinning,
/// including bridges, with the interior's topology; `voxels` are their properties.
///
/// A square between two voxels belongs to a sheet if the axis separates their centres: between
/// them, the nearest foot jumps by the angle or more. The cubes of `kept` collapse onto these
/// squares (volume/complex.h), so the surface has the homotopy type of the interior. Finally, its
/// points move to places equally far from the feet of the voxels around them.
AxisSurface surface_of(const Grid& grid, const VoxelSet& interior, const VoxelSet& kept,
                       std::vector<MedialVoxel> voxels, const FeetFinder& finder, Control& control);

}  // namespace medial::volume
