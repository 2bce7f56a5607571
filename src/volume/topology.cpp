#include "volume/topology.h"

#include <algorithm>
#include <array>
#include <bit>

namespace medial::volume {
namespace {

struct Masks {
  std::array<Neighbourhood, 27> near26 = {};  ///< of each place, the others that share a corner
  std::array<Neighbourhood, 27> near6 = {};   ///< that share a face
  Neighbourhood edges = 0;                    ///< its 18 neighbours
};

constexpr Masks make_masks() {
  Masks masks;
  for (int i = 0; i < 27; ++i) {
    const int x = i % 3, y = i / 3 % 3, z = i / 9;
    const int away = (x != 1) + (y != 1) + (z != 1);
    if (away == 1 || away == 2) masks.edges |= 1U << i;
    for (int j = 0; j < 27; ++j) {
      const int dx = j % 3 - x, dy = j / 3 % 3 - y, dz = j / 9 - z;
      if (i == j || dx * dx > 1 || dy * dy > 1 || dz * dz > 1) continue;
      masks.near26[static_cast<std::size_t>(i)] |= 1U << j;
      if (dx * dx + dy * dy + dz * dz == 1) masks.near6[static_cast<std::size_t>(i)] |= 1U << j;
    }
  }
  return masks;
}

constexpr Masks masks = make_masks();

/// What of `within` can be reached from `start`, itself in it.
Neighbourhood flood(Neighbourhood start, Neighbourhood within,
                    const std::array<Neighbourhood, 27>& near) {
  Neighbourhood reached = start, fresh = start;
  while (fresh != 0) {
    Neighbourhood next = 0;
    for (; fresh != 0; fresh &= fresh - 1)
      next |= near[static_cast<std::size_t>(std::countr_zero(fresh))];
    fresh = next & within & ~reached;
    reached |= fresh;
  }
  return reached;
}

/// Cells of the cubical complex whose lowest vertex is the one between eight voxels, counted with
/// the sign of their dimension: bit x + 2 y + 4 z of the index is the voxel on that side.
constexpr std::array<std::int8_t, 256> make_euler() {
  std::array<std::int8_t, 256> euler = {};
  for (unsigned i = 0; i < 256; ++i) {
    int sum = i != 0;               // the vertex
    sum -= (i & 0b10101010U) != 0;  // edges in the direction of +x, +y, +z
    sum -= (i & 0b11001100U) != 0;
    sum -= (i & 0b11110000U) != 0;
    sum += (i & 0b10001000U) != 0;  // faces across z, y, x
    sum += (i & 0b10100000U) != 0;
    sum += (i & 0b11000000U) != 0;
    sum -= (i & 0b10000000U) != 0;  // the cube
    euler[i] = static_cast<std::int8_t>(sum);
  }
  return euler;
}

constexpr std::array<std::int8_t, 256> euler_of = make_euler();

/// Appends the runs of a row of the set, or of its complement.
void add_runs(const VoxelSet& set, std::uint32_t y, std::uint32_t z, bool complement,
              std::vector<CellRun>& runs) {
  const std::uint32_t width = set.size()[0];
  bool inside = false;
  for (std::uint32_t block = 0; block * 8 < width; ++block) {
    std::uint32_t bits = set.row(block, y, z);
    if (complement) bits = ~bits & 0xffU;
    if (bits == (inside ? 0xffU : 0U)) continue;
    for (std::uint32_t x = block * 8; x < std::min(width, block * 8 + 8); ++x, bits >>= 1U) {
      if (((bits & 1U) != 0) == inside) continue;
      inside = !inside;
      if (inside) {
        runs.push_back({x, width, y, z});
      } else {
        runs.back().end = x;
      }
    }
  }
}

std::int64_t euler_characteristic(const VoxelSet& set) {
  const auto [width, height, depth] = set.size();
  std::int64_t sum = 0;
  for (std::uint32_t z = 1; z < depth; ++z) {
    for (std::uint32_t y = 1; y < height; ++y) {
      // The four rows around the row of vertices, each with its last voxel of the block before.
      std::array<std::uint32_t, 4> before = {};
      for (std::uint32_t block = 0; block * 8 < width; ++block) {
        std::array<std::uint32_t, 4> rows;
        for (std::uint32_t k = 0; k < 4; ++k)
          rows[k] = std::uint32_t{set.row(block, y - 1 + k % 2, z - 1 + k / 2)} << 1U | before[k];
        if ((rows[0] | rows[1] | rows[2] | rows[3]) != 0) {
          for (std::uint32_t x = 0; x < 8; ++x) {
            const std::uint32_t index = (rows[0] >> x & 3U) | (rows[1] >> x & 3U) << 2U |
                                        (rows[2] >> x & 3U) << 4U | (rows[3] >> x & 3U) << 6U;
            sum += euler_of[index];
          }
        }
        for (std::uint32_t k = 0; k < 4; ++k) before[k] = rows[k] >> 8U;
      }
      // A last block without a gap behind it is closed by the border, which is empty.
    }
  }
  return sum;
}

}  // namespace

bool is_simple(Neighbourhood around) {
  const Neighbourhood set = around & ~center_bit;
  if (set == 0) return false;
  if (flood(set & (~set + 1), set, masks.near26) != set) return false;
  const Neighbourhood outside = ~around & masks.edges;
  const Neighbourhood beside = outside & face_bits;
  if (beside == 0) return false;
  return (beside & ~flood(beside & (~beside + 1), outside, masks.near6)) == 0;
}

ConnectedRuns connected_runs(const VoxelSet& set, bool complement) {
  const auto [width, height, depth] = set.size();
  ConnectedRuns found;
  std::vector<CellRun>& runs = found.runs;
  DisjointSets& parts = found.parts;
  // Runs of the complement touch where they share a face, those of the set where they share a
  // corner: then they may be one apart in x, and rows that lie diagonally are neighbours, too.
  const std::uint32_t apart = complement ? 0 : 1;
  const auto join_rows = [&](std::uint32_t i, std::uint32_t i_end, std::uint32_t j,
                             std::uint32_t j_end) {
    while (i < i_end && j < j_end) {
      if (runs[i].begin < runs[j].end + apart && runs[j].begin < runs[i].end + apart)
        parts.join(i, j);
      runs[i].end < runs[j].end ? ++i : ++j;
    }
  };
  // Where the runs of each row of a layer begin.
  std::vector<std::uint32_t> below(height + 1, 0), here(height + 1, 0);
  for (std::uint32_t z = 0; z < depth; ++z) {
    for (std::uint32_t y = 0; y < height; ++y) {
      const std::uint32_t begin = here[y] = static_cast<std::uint32_t>(runs.size());
      add_runs(set, y, z, complement, runs);
      const auto end = static_cast<std::uint32_t>(runs.size());
      for (std::uint32_t i = begin; i < end; ++i) parts.add();
      if (y > 0) join_rows(begin, end, here[y - 1], begin);
      if (z == 0) continue;
      for (std::uint32_t row = y - std::min(y, apart); row < std::min(y + apart + 1, height); ++row)
        join_rows(begin, end, below[row], below[row + 1]);
    }
    here[height] = static_cast<std::uint32_t>(runs.size());
    std::swap(here, below);
  }
  return found;
}

VoxelTopology topology_of(const VoxelSet& set) {
  VoxelTopology topology;
  topology.components = connected_runs(set, false).parts.count();
  // The complement has an unbounded part that the border belongs to.
  topology.cavities = connected_runs(set, true).parts.count() - 1;
  topology.tunnels = static_cast<std::int64_t>(topology.components + topology.cavities) -
                     euler_characteristic(set);
  return topology;
}

}  // namespace medial::volume
