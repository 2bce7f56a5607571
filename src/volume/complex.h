#pragma once

// Cubical complexes: points, edges, squares and cubes of a grid, with their faces.

#include <bit>
#include <functional>

#include "volume/control.h"
#include "volume/voxel_set.h"

namespace medial::volume {

/// A closed complex as a set of cells of a grid that is twice as fine. A coordinate is odd along
/// the directions in which a cell extends. The voxel (x, y, z) is the cube (2x + 1, 2y + 1, 2z +
/// 1). The neighbours of a cell are its faces and the cells of which it is a face.
using CubicalComplex = VoxelSet;

/// The faces of a cell, and the cells of which it is a face, as bits of a Neighbourhood.
Neighbourhood faces_of(Cell cell);
Neighbourhood cofaces_of(Cell cell);

/// The dimension of a cell: 0 for a point, 3 for a cube.
inline std::uint32_t dimension(Cell cell) { return (cell.x & 1U) + (cell.y & 1U) + (cell.z & 1U); }
inline Cell cube_of(Cell voxel) { return {2 * voxel.x + 1, 2 * voxel.y + 1, 2 * voxel.z + 1}; }

/// Calls take(other) for the neighbours of a cell whose bits are set in a Neighbourhood.
template <class Take>
void each_cell(Cell cell, Neighbourhood bits, const Take& take) {
  for (; bits != 0; bits &= bits - 1) take(neighbour(cell, std::countr_zero(bits)));
}

/// Calls take(corner) for each of the points of a cell.
template <class Take>
void each_corner(Cell cell, const Take& take) {
  for (std::uint32_t x = cell.x - (cell.x & 1U); x <= cell.x + (cell.x & 1U); x += 2)
    for (std::uint32_t y = cell.y - (cell.y & 1U); y <= cell.y + (cell.y & 1U); y += 2)
      for (std::uint32_t z = cell.z - (cell.z & 1U); z <= cell.z + (cell.z & 1U); z += 2)
        take(Cell{x, y, z});
}

/// The closed cubes of a set of voxels.
CubicalComplex complex_of(const VoxelSet& voxels);
/// Adds a cell and its faces.
void insert_closed(CubicalComplex& complex, Cell cell);

/// Collapses a complex onto sheets and curves by elementary collapses, each of which removes a free
/// face together with the only cell that it is a face of. Cells farthest from the axis go first;
/// `off_axis` estimates the distance in edges of a voxel. Keeps the cells in `kept`, a closed part
/// of the complex, unless they enclose cubes; and keeps curves where the axis passes, up to about
/// two edges from open ends. Preserves the homotopy type. O(n log n).
void collapse(CubicalComplex& complex, CubicalComplex kept, int longest,
              const std::function<double(Cell)>& off_axis, const Control& control);

}  // namespace medial::volume
