#include "volume/thin.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "volume/topology.h"

namespace medial::volume {
namespace {

constexpr std::size_t check_every = 1U << 16U;

bool is_excess(const MedialVoxel& voxel, Neighbourhood around, Thinning how) {
  const bool two_neighbours = std::popcount(around & ~center_bit) >= 2;
  if (how == Thinning::sheets && voxel.across != MedialVoxel::no_axis)
    return (around & across_bits[voxel.across]) != 0;
  return two_neighbours;
}

}  // namespace

VoxelSet peel(VoxelSet set, const VoxelSet& kept, Control& control) {
  const GridSize size = set.size();
  VoxelSet queued(size);
  std::vector<Cell> layer, next;
  each_voxel(set, [&](Cell cell) {
    if (kept.contains(cell) || (set.around(cell) & face_bits) == face_bits) return;
    queued.insert(cell);
    layer.push_back(cell);
  });
  std::size_t steps = 0;
  while (!layer.empty()) {
    next.clear();
    for (const Cell cell : layer) {
      if (++steps % check_every == 0)
        control.check(set.bytes() + 3 * queued.bytes() + layer.capacity() * 2 * sizeof(Cell));
      queued.erase(cell);
      const Neighbourhood around = set.around(cell);
      if (!is_simple(around)) continue;
      set.erase(cell);
      Neighbourhood fresh = around & ~center_bit & ~kept.around(cell) & ~queued.around(cell);
      for (; fresh != 0; fresh &= fresh - 1) {
        const Cell other = neighbour(cell, std::countr_zero(fresh));
        queued.insert(other);
        next.push_back(other);
      }
    }
    std::swap(layer, next);
  }
  return set;
}

void thin(VoxelSet& set, std::vector<MedialVoxel>& voxels, Thinning how, const GridSize& size,
          Control& control) {
  if (how == Thinning::none) return;
  std::sort(voxels.begin(), voxels.end(), [how](const MedialVoxel& a, const MedialVoxel& b) {
    if (how == Thinning::curves && a.radius != b.radius) return a.radius < b.radius;
    return a.quality > b.quality || (a.quality == b.quality && a.rank > b.rank);
  });
  std::size_t steps = 0;
  for (bool changed = true; changed;) {
    changed = false;
    std::size_t left = 0;
    for (const MedialVoxel& voxel : voxels) {
      if (++steps % check_every == 0) control.check(0);
      const Cell cell = cell_of(voxel.rank, size);
      const Neighbourhood around = set.around(cell);
      if (is_excess(voxel, around, how) && is_simple(around)) {
        set.erase(cell);
        changed = true;
      } else {
        voxels[left++] = voxel;
      }
    }
    voxels.resize(left);
  }
}

}  // namespace medial::volume
