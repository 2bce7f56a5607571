#include "volume/voxel_set.h"

#include <algorithm>
#include <bit>

namespace medial::volume {

VoxelSet::VoxelSet(const GridSize& size)
    : size_(size), blocks_({(size[0] + 7) / 8, (size[1] + 7) / 8, (size[2] + 7) / 8}) {
  slabs_.resize(blocks_[2]);
  for (Slab& slab : slabs_) slab.entries.assign(std::size_t{blocks_[0]} * blocks_[1], empty);
}

std::uint64_t VoxelSet::bytes_of_empty(const GridSize& size) {
  return std::uint64_t{(size[0] + 7) / 8} * ((size[1] + 7) / 8) * ((size[2] + 7) / 8) *
         sizeof(std::uint32_t);
}

std::uint8_t& VoxelSet::stored_row(std::uint32_t block, std::uint32_t y, std::uint32_t z) {
  Slab& slab = slabs_[z >> 3U];
  std::uint32_t& entry = slab.entries[(y >> 3U) * blocks_[0] + block];
  if (entry < first_stored) {
    const std::uint8_t fill = entry == full ? 0xff : 0;
    if (slab.unused.empty()) {
      entry = static_cast<std::uint32_t>(slab.blocks.size()) + first_stored;
      slab.blocks.emplace_back();
    } else {
      entry = slab.unused.back() + first_stored;
      slab.unused.pop_back();
    }
    slab.blocks[entry - first_stored].fill(fill);
  }
  return slab.blocks[entry - first_stored][(z & 7U) * 8 + (y & 7U)];
}

bool VoxelSet::insert(Cell cell) {
  if (contains(cell)) return false;
  std::uint8_t& bits = stored_row(cell.x >> 3U, cell.y, cell.z);
  bits = static_cast<std::uint8_t>(bits | 1U << (cell.x & 7U));
  return true;
}

bool VoxelSet::erase(Cell cell) {
  if (!contains(cell)) return false;
  std::uint8_t& bits = stored_row(cell.x >> 3U, cell.y, cell.z);
  bits = static_cast<std::uint8_t>(bits & ~(1U << (cell.x & 7U)));
  return true;
}

void VoxelSet::insert_run(std::uint32_t begin, std::uint32_t end, std::uint32_t y,
                          std::uint32_t z) {
  while (begin < end) {
    const std::uint32_t block = begin >> 3U;
    const std::uint32_t stop = std::min(end, (block + 1) * 8);
    const std::uint32_t bits = (0xffU << (begin & 7U)) & (0xffU >> ((block + 1) * 8 - stop));
    std::uint8_t& stored = stored_row(block, y, z);
    stored = static_cast<std::uint8_t>(stored | bits);
    begin = stop;
  }
}

void VoxelSet::subtract(const VoxelSet& other, std::uint32_t slab) {
  const Slab& there = other.slabs_[slab];
  for (std::uint32_t by = 0; by < blocks_[1]; ++by) {
    for (std::uint32_t bx = 0; bx < blocks_[0]; ++bx) {
      const std::uint32_t take = there.entries[by * blocks_[0] + bx];
      if (take == empty || slabs_[slab].entries[by * blocks_[0] + bx] == empty) continue;
      for (std::uint32_t row = 0; row < 64; ++row) {
        std::uint8_t& bits = stored_row(bx, by * 8 + row % 8, slab * 8 + row / 8);
        const std::uint32_t mask = take == full ? 0xffU : there.blocks[take - first_stored][row];
        bits = static_cast<std::uint8_t>(bits & ~mask);
      }
    }
  }
}

Neighbourhood VoxelSet::around(Cell cell) const {
  Neighbourhood found = 0;
  const std::uint32_t block = cell.x >> 3U, at = cell.x & 7U;
  int shift = 0;
  for (std::uint32_t z = cell.z - 1; z != cell.z + 2; ++z) {
    for (std::uint32_t y = cell.y - 1; y != cell.y + 2; ++y, shift += 3) {
      std::uint32_t bits = 0;
      if (at == 0) {
        bits = row(block - 1, y, z) >> 7U | static_cast<std::uint32_t>(row(block, y, z)) << 1U;
      } else {
        bits = row(block, y, z) >> (at - 1);
        if (at == 7) bits |= (row(block + 1, y, z) & 1U) << 2U;
      }
      found |= (bits & 7U) << shift;
    }
  }
  return found;
}

void VoxelSet::compress(std::uint32_t index) {
  Slab& slab = slabs_[index];
  std::vector<Block> kept;
  for (std::uint32_t& entry : slab.entries) {
    if (entry < first_stored) continue;
    const Block& block = slab.blocks[entry - first_stored];
    const auto all = [&](std::uint8_t value) {
      return std::all_of(block.begin(), block.end(), [=](std::uint8_t b) { return b == value; });
    };
    if (all(0)) {
      entry = empty;
    } else if (all(0xff)) {
      entry = full;
    } else {
      kept.push_back(block);
      entry = static_cast<std::uint32_t>(kept.size() - 1) + first_stored;
    }
  }
  kept.shrink_to_fit();
  slab.blocks = std::move(kept);
  slab.unused.clear();
}

std::uint64_t VoxelSet::count() const {
  std::uint64_t total = 0;
  for (const Slab& slab : slabs_) {
    for (const std::uint32_t entry : slab.entries) {
      if (entry == full) total += 512;
      if (entry < first_stored) continue;
      for (const std::uint8_t bits : slab.blocks[entry - first_stored])
        total += static_cast<std::uint64_t>(std::popcount(bits));
    }
  }
  return total;
}

std::uint64_t VoxelSet::bytes() const {
  std::uint64_t total = bytes_of_empty(size_);
  for (const Slab& slab : slabs_)
    total +=
        slab.blocks.capacity() * sizeof(Block) + slab.unused.capacity() * sizeof(std::uint32_t);
  return total;
}

}  // namespace medial::volume
