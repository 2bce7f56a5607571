#pragma once

// Sets of voxels of a grid, in blocks of 8 x 8 x 8; empty and full blocks take no storage.

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace medial::volume {

/// A voxel by its column, row and layer.
struct Cell {
  std::uint32_t x = 0, y = 0, z = 0;

  friend constexpr bool operator==(Cell, Cell) = default;
};

using GridSize = std::array<std::uint32_t, 3>;

/// The place of a voxel in the order of the result: by increasing x within y within z.
inline std::uint64_t rank_of(Cell cell, const GridSize& size) {
  return (std::uint64_t{cell.z} * size[1] + cell.y) * size[0] + cell.x;
}
inline Cell cell_of(std::uint64_t rank, const GridSize& size) {
  const std::uint64_t row = rank / size[0];
  return {static_cast<std::uint32_t>(rank % size[0]), static_cast<std::uint32_t>(row % size[1]),
          static_cast<std::uint32_t>(row / size[1])};
}

/// A voxel and its 26 neighbours as bits: bit (dx + 1) + 3 (dy + 1) + 9 (dz + 1).
using Neighbourhood = std::uint32_t;
constexpr Neighbourhood center_bit = 1U << 13U;
constexpr Neighbourhood all_bits = (1U << 27U) - 1;
constexpr int bit_of(int dx, int dy, int dz) { return (dx + 1) + 3 * (dy + 1) + 9 * (dz + 1); }

/// The neighbour that a bit of a Neighbourhood stands for. Requires one inside the grid.
inline Cell neighbour(Cell cell, int bit) {
  return {cell.x + static_cast<std::uint32_t>(bit % 3) - 1,
          cell.y + static_cast<std::uint32_t>(bit / 3 % 3) - 1,
          cell.z + static_cast<std::uint32_t>(bit / 9) - 1};
}

/// A set of voxels. Different layers of blocks (z / 8) may be changed by different threads at once.
class VoxelSet {
 public:
  VoxelSet() = default;
  explicit VoxelSet(const GridSize& size);

  const GridSize& size() const { return size_; }

  bool contains(Cell cell) const {
    return (row(cell.x >> 3U, cell.y, cell.z) >> (cell.x & 7U)) & 1U;
  }
  /// Adds a voxel; whether it was new.
  bool insert(Cell cell);
  /// Removes a voxel; whether it was there.
  bool erase(Cell cell);
  /// Adds the voxels from x = begin to end - 1 of a row.
  void insert_run(std::uint32_t begin, std::uint32_t end, std::uint32_t y, std::uint32_t z);

  /// Eight voxels of a row, lowest x in the lowest bit: x = 8 * block to 8 * block + 7.
  std::uint8_t row(std::uint32_t block, std::uint32_t y, std::uint32_t z) const {
    const Slab& slab = slabs_[z >> 3U];
    const std::uint32_t entry = slab.entries[(y >> 3U) * blocks_[0] + block];
    if (entry < first_stored) return entry == full ? 0xff : 0;
    return slab.blocks[entry - first_stored][(z & 7U) * 8 + (y & 7U)];
  }
  /// Removes from each group of eight what `mask` has: the row's voxels that are in `other`.
  void subtract(const VoxelSet& other, std::uint32_t slab);

  /// A voxel and its neighbours. Requires a voxel that does not lie at the border of the grid.
  Neighbourhood around(Cell cell) const;

  /// Makes blocks that became full or empty take no storage. Of the layers z / 8 == slab.
  void compress(std::uint32_t slab);
  std::uint32_t slab_count() const { return static_cast<std::uint32_t>(slabs_.size()); }

  std::uint64_t count() const;
  std::uint64_t bytes() const;
  /// What a set takes at least.
  static std::uint64_t bytes_of_empty(const GridSize& size);

 private:
  static constexpr std::uint32_t empty = 0, full = 1, first_stored = 2;
  using Block = std::array<std::uint8_t, 64>;  ///< a byte for each row, y within z

  struct Slab {
    std::vector<std::uint32_t> entries;  ///< empty, full, or the index of a block + first_stored
    std::vector<Block> blocks;
    std::vector<std::uint32_t> unused;  ///< of blocks
  };

  std::uint8_t& stored_row(std::uint32_t block, std::uint32_t y, std::uint32_t z);

  GridSize size_ = {};
  GridSize blocks_ = {};
  std::vector<Slab> slabs_;
};

/// Calls take(cell) for every voxel of a set, by increasing x within y within z.
template <class Take>
void each_voxel(const VoxelSet& set, Take take) {
  const GridSize& size = set.size();
  for (std::uint32_t z = 0; z < size[2]; ++z)
    for (std::uint32_t y = 0; y < size[1]; ++y)
      for (std::uint32_t block = 0; block * 8 < size[0]; ++block)
        for (std::uint32_t bits = set.row(block, y, z); bits != 0; bits &= bits - 1)
          take(Cell{block * 8 + static_cast<std::uint32_t>(std::countr_zero(bits)), y, z});
}

}  // namespace medial::volume
