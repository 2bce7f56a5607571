#pragma once

// Removal of voxels one by one, each without a change of the topology.

#include <cstdint>
#include <vector>

#include "volume/control.h"
#include "volume/follow.h"
#include "volume/voxel_set.h"

namespace medial::volume {

/// Peels the voxels of `set` that are not in `kept` off it, from its border inwards, as long as
/// they are simple. What remains has the topology of the set and holds `kept`: it is `kept` itself
/// where that has the set's topology, and otherwise has bridges between its parts, and skins over
/// its holes. O(voxels of the set).
VoxelSet peel(VoxelSet set, const VoxelSet& kept, Control& control);

/// Removes excess voxels from `set`, the worst first: by decreasing quality value (report, Section
/// III.D), ties by decreasing rank; for curves by increasing radius. A voxel goes if it is simple
/// and, for sheets, has a neighbour in the set across its sheet, so that sheets keep their rims;
/// for curves, if it is no end: has two neighbours or more. Repeats until nothing goes.
///
/// The report removes only voxels worse than all their neighbours at the time. That leaves thick
/// places around voxels that cannot go and are bad; and its test of an end, more than two
/// neighbours, is for curves in the plane.
void thin(VoxelSet& set, std::vector<MedialVoxel>& voxels, Thinning how, const GridSize& size,
          Control& control);

}  // namespace medial::volume
