#include "volume/topology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace medial::volume {
namespace {

struct Masks {
  std::array<Neighbourhood, 27> near26 = {};  ///< of each place, the others that share a corner
  std::array<Neighbourhood, 27> near6 = {};   ///< that share a face
  Neighbourhood faces = 0;                    ///< the 6 neighbours of the middle
  Neighbourhood edges = 0;                    ///< its 18 neighbours
};

constexpr Masks make_masks() {
  Masks masks;
  for (int i = 0; i < 27; ++i) {
    const int x = i % 3, y = i / 3 % 3, z = i / 9;
    const int away = (x != 1) + (y != 1) + (z != 1);
    if (away == 1) masks.faces |= 1U << i;
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

/// Disjoint sets of runs.
class Unions {
 public:
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    ++parts_;
    return parent_.back();
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    if (i == j) return;
    parent_[std::max(i, j)] = std::min(i, j);
    --parts_;
  }
  std::uint64_t parts() const { return parts_; }

 private:
  std::vector<std::uint32_t> parent_;
  std::uint64_t parts_ = 0;
};

struct Run {
  std::uint32_t begin, end;  ///< x
  std::uint32_t label;
};

/// The runs of a row of the set, or of its complement.
void runs_of(const VoxelSet& set, std::uint32_t y, std::uint32_t z, bool complement,
             std::vector<Run>& runs) {
  runs.clear();
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
        runs.push_back({x, width, 0});
      } else {
        runs.back().end = x;
      }
    }
  }
}

/// The number of parts of a set, or of its complement; `reach` is how far apart in x runs of
/// neighbouring rows may lie, and rows that lie diagonally are neighbours too where it is 1.
std::uint64_t count_parts(const VoxelSet& set, bool complement, std::uint32_t reach) {
  const auto [width, height, depth] = set.size();
  Unions parts;
  std::vector<std::vector<Run>> below(height), here(height);
  const auto join_rows = [&](const std::vector<Run>& a, const std::vector<Run>& b) {
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
      if (a[i].begin < b[j].end + reach && b[j].begin < a[i].end + reach)
        parts.join(a[i].label, b[j].label);
      a[i].end < b[j].end ? ++i : ++j;
    }
  };
  for (std::uint32_t z = 0; z < depth; ++z) {
    for (std::uint32_t y = 0; y < height; ++y) {
      runs_of(set, y, z, complement, here[y]);
      for (Run& run : here[y]) run.label = parts.add();
      if (y > 0) join_rows(here[y], here[y - 1]);
      if (z == 0) continue;
      join_rows(here[y], below[y]);
      if (reach == 0) continue;
      if (y > 0) join_rows(here[y], below[y - 1]);
      if (y + 1 < height) join_rows(here[y], below[y + 1]);
    }
    std::swap(here, below);
  }
  return parts.parts();
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
  const Neighbourhood beside = outside & masks.faces;
  if (beside == 0) return false;
  return (beside & ~flood(beside & (~beside + 1), outside, masks.near6)) == 0;
}

VoxelTopology topology_of(const VoxelSet& set) {
  VoxelTopology topology;
  topology.components = count_parts(set, false, 1);
  // The complement has an unbounded part that the border belongs to.
  topology.cavities = count_parts(set, true, 0) - 1;
  topology.tunnels = static_cast<std::int64_t>(topology.components + topology.cavities) -
                     euler_characteristic(set);
  return topology;
}

}  // namespace medial::volume
