#pragma once

// The topology of sets of voxels: 26 neighbours in the set, 6 outside of it.

#include "medial/volume.h"
#include "volume/voxel_set.h"

namespace medial::volume {

/// The Betti numbers of the union of the set's closed cubes. Requires a set that is empty at the
/// border of the grid. O(blocks + rows' runs of voxels).
VoxelTopology topology_of(const VoxelSet& set);

/// Whether a voxel may be removed without changing the topology: its topological numbers, the
/// parts of the set among its neighbours and of the complement beside it, are both 1 (Bertrand and
/// Malandain 1994). `around` has the voxel and its neighbours.
bool is_simple(Neighbourhood around);

}  // namespace medial::volume
