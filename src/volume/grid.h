#pragma once

// The solid in units of the grid, in which the voxel (i, j, k) is the cube from (i, j, k) to
// (i + 1, j + 1, k + 1).

#include <vector>

#include "base/vec3.h"
#include "medial/volume.h"
#include "volume/face_tree.h"
#include "volume/voxel_set.h"

namespace medial::volume {

struct Grid {
  double step = 1;  ///< edge of a voxel, in units of the input
  Vec3 origin;      ///< low corner of the cell (0, 0, 0), in units of the input
  GridSize size = {};
  std::vector<Vec3> vertices;  ///< of the solid, in units of the grid
  std::vector<Face> faces;

  Triangle triangle(std::uint32_t face) const { return triangle_of(vertices, faces[face]); }
};

inline Vec3 center_of(Cell cell) { return {cell.x + 0.5, cell.y + 0.5, cell.z + 0.5}; }

}  // namespace medial::volume
