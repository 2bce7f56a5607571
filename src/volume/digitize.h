#pragma once

// The surface on the grid, the voxels inside it, and their bounded sets.

#include <functional>
#include <vector>

#include "volume/grid.h"
#include "volume/topology.h"
#include "volume/voxel_set.h"

namespace medial::volume {

struct Digitized {
  VoxelSet surface;   ///< voxels whose closed cube the surface meets
  VoxelSet interior;  ///< voxels of the solid's inside that the surface does not meet
};

/// Digitises the surface without its interior, then the interior (report, Section V.B.3).
///
/// A voxel that the surface misses lies on one side of it, and so do two such voxels that share a
/// corner: the segment between their centres stays in their cubes. So no path over 26 neighbours
/// passes the surface, and the parity of the crossings of a row's middle line decides for whole
/// runs of voxels. It is exact: whether the line crosses a face is decided by exact predicates,
/// and where in the run of surface voxels around it the crossing lies does not matter.
///
/// Requires two empty layers of cells around the vertices. O(faces x layers / 8 + surface voxels).
/// `stop` is asked now and then; once it is true, the result means nothing.
Digitized digitize(const Grid& grid, const std::function<bool()>& stop);

/// A set of interior voxels that are connected over 26 neighbours.
struct BoundedSet {
  std::uint64_t voxels = 0;
  std::uint32_t low = 0, high = 0;  ///< its first and last layer
  std::vector<CellRun> runs;        ///< by increasing x within y within z
};

/// The bounded sets of interior voxels, by their first voxel. O(rows + runs).
std::vector<BoundedSet> bounded_sets(const VoxelSet& interior);

}  // namespace medial::volume
