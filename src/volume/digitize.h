#pragma once

// Digitisation of the surface, the interior voxels, and their bounded sets.

#include <functional>
#include <vector>

#include "volume/grid.h"
#include "volume/topology.h"
#include "volume/voxel_set.h"

namespace medial::volume {

struct Digitized {
  VoxelSet surface;   ///< voxels whose closed cube the surface meets
  VoxelSet interior;  ///< voxels inside the solid that the surface does not meet
};

/// Digitises the surface, then the interior (report, Section V.B.3).
///
/// A voxel that the surface does not meet lies on one side of it, and two such voxels that share a
/// corner lie on the same side, because the segment between their centres stays in their cubes. So
/// no 26-connected path crosses the surface, and the parity of the crossings along a row's middle
/// line decides for whole runs of voxels. This is exact: exact predicates decide whether the line
/// crosses a face, and the position of the crossing within its run of surface voxels does not
/// matter.
///
/// Requires two empty layers of cells around the vertices. O(faces x layers / 8 + surface voxels).
/// Polls `stop`; once it is true, the result is meaningless.
Digitized digitize(const Grid& grid, const std::function<bool()>& stop);

/// A 26-connected set of interior voxels.
struct BoundedSet {
  std::uint64_t voxels = 0;
  std::uint32_t low = 0, high = 0;  ///< its first and last layer
  std::vector<CellRun> runs;        ///< by increasing x within y within z
};

/// The bounded sets of interior voxels, by their first voxel. O(rows + runs).
std::vector<BoundedSet> bounded_sets(const VoxelSet& interior);

}  // namespace medial::volume
