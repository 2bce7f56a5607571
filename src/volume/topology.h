#pragma once

// The topology of sets of voxels: 26-connectivity in the set, 6-connectivity outside it.

#include <array>
#include <vector>

#include "base/disjoint_sets.h"
#include "medial/volume.h"
#include "volume/voxel_set.h"

namespace medial::volume {

/// Voxels from x = begin to end - 1 of a row.
struct CellRun {
  std::uint32_t begin = 0, end = 0, y = 0, z = 0;
};

/// The longest runs of a set of voxels, or of its complement, by increasing x within y within z;
/// and their parts.
struct ConnectedRuns {
  std::vector<CellRun> runs;
  DisjointSets parts;  ///< of runs
};

/// Voxels of the set are 26-connected, voxels of its complement 6-connected. O(rows + runs).
ConnectedRuns connected_runs(const VoxelSet& set, bool complement);

/// The Betti numbers of the union of the set's closed cubes. Requires a set that is empty at the
/// border of the grid. O(blocks + rows' runs of voxels).
VoxelTopology topology_of(const VoxelSet& set);

/// The two neighbours across the faces of a voxel along each axis, and all six.
inline constexpr std::array<Neighbourhood, 3> across_bits = {
    1U << bit_of(-1, 0, 0) | 1U << bit_of(1, 0, 0), 1U << bit_of(0, -1, 0) | 1U << bit_of(0, 1, 0),
    1U << bit_of(0, 0, -1) | 1U << bit_of(0, 0, 1)};
inline constexpr Neighbourhood face_bits = across_bits[0] | across_bits[1] | across_bits[2];

/// Whether a voxel can be removed without changing the topology: both of its topological numbers,
/// the numbers of components of the set among its neighbours and of the complement next to it, are
/// 1 (Bertrand and Malandain 1994). `around` holds the voxel and its neighbours.
bool is_simple(Neighbourhood around);

}  // namespace medial::volume
