#pragma once

// Thinning: removes voxels one by one without changing the topology.

#include <cstdint>
#include <vector>

#include "volume/control.h"
#include "volume/follow.h"
#include "volume/voxel_set.h"

namespace medial::volume {

/// Removes simple voxels of `set` that are not in `kept`, from its border inwards. The result has
/// the topology of the set and contains `kept`. If `kept` has the set's topology, it is the result;
/// otherwise, the result also has bridges between its parts and skins over its holes. O(voxels of
/// the set).
VoxelSet peel(VoxelSet set, const VoxelSet& kept, Control& control);

/// Removes excess voxels from `set`, the worst first: by decreasing quality value (report, Section
/// III.D), ties by decreasing rank; for curves, by increasing radius. A voxel is removed if it is
/// simple and, for sheets, has a neighbour in the set across its sheet, so that sheets keep their
/// rims, or, for curves, is not an end (has two or more neighbours). Repeats until no voxel can be
/// removed.
///
/// The report removes only voxels that are worse than all their current neighbours. This leaves
/// thick places around bad voxels that cannot be removed; and its test for an end, more than two
/// neighbours, is made for curves in the plane.
void thin(VoxelSet& set, std::vector<MedialVoxel>& voxels, Thinning how, const GridSize& size,
          Control& control);

}  // namespace medial::volume
