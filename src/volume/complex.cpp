#include "volume/complex.h"

#include <array>
#include <bit>
#include <optional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

namespace medial::volume {
namespace {

/// By the parities of a cell's coordinates: the bits of the places that differ from it only along
/// directions in which it extends, or only along the others.
constexpr std::array<Neighbourhood, 8> make_bits(bool faces) {
  std::array<Neighbourhood, 8> bits_of_parity = {};
  for (unsigned parity = 0; parity < 8; ++parity) {
    for (int bit = 0; bit < 27; ++bit) {
      const unsigned moved =
          (bit % 3 != 1 ? 1U : 0U) | (bit / 3 % 3 != 1 ? 2U : 0U) | (bit / 9 != 1 ? 4U : 0U);
      if (moved != 0 && (moved & (faces ? ~parity : parity)) == 0)
        bits_of_parity[parity] |= 1U << bit;
    }
  }
  return bits_of_parity;
}

constexpr std::array<Neighbourhood, 8> face_masks = make_bits(true);
constexpr std::array<Neighbourhood, 8> coface_masks = make_bits(false);

unsigned parity(Cell cell) { return (cell.x & 1U) | (cell.y & 1U) << 1U | (cell.z & 1U) << 2U; }

/// The one cell that this one is a face of, if there is one only.
std::optional<Cell> only_coface(const CubicalComplex& complex, Cell cell) {
  const Neighbourhood cofaces = complex.around(cell) & cofaces_of(cell);
  if (!std::has_single_bit(cofaces)) return std::nullopt;
  return neighbour(cell, std::countr_zero(cofaces));
}

/// Elementary collapses of cells that are not kept.
class Collapse {
 public:
  Collapse(CubicalComplex& complex, const CubicalComplex& kept, const Control& control)
      : complex_(complex), kept_(kept), control_(control) {}

  /// What lies farthest off the axis first.
  void run(const std::function<double(Cell)>& off_axis) {
    std::priority_queue<std::pair<double, std::uint64_t>> queue;
    const auto add = [&](Cell cell) {
      if (const auto coface = free_in(cell))
        queue.push({off_axis(*coface), rank_of(cell, complex_.size())});
    };
    each_voxel(complex_, add);
    while (!queue.empty()) {
      const Cell cell = cell_of(queue.top().second, complex_.size());
      queue.pop();
      remove(cell, add);
    }
  }

  /// From the border inwards, layer by layer. Returns the edges that belonged to no square for more
  /// than `longest` layers until curves were shortened to there.
  std::vector<Cell> layers(int longest) {
    std::vector<Cell> free, next, lasting;
    std::unordered_map<std::uint64_t, int> curve_since;  // the layer in which an edge became one
    const auto add = [&](Cell cell) { next.push_back(cell); };
    each_voxel(complex_, [&](Cell cell) {
      if (free_in(cell)) free.push_back(cell);
    });
    for (int layer = 0; !free.empty(); ++layer) {
      next.clear();
      for (const Cell cell : free) {
        const auto coface = remove(cell, add);
        if (!coface || dimension(*coface) != 1) continue;
        const auto since = curve_since.find(rank_of(*coface, complex_.size()));
        if (since != curve_since.end() && layer - since->second > longest)
          lasting.push_back(*coface);
      }
      for (const Cell cell : next)
        if (dimension(cell) == 1 && complex_.contains(cell) &&
            (complex_.around(cell) & cofaces_of(cell)) == 0)
          curve_since.try_emplace(rank_of(cell, complex_.size()), layer);
      std::swap(free, next);
    }
    return lasting;
  }

 private:
  /// What a cell may leave with.
  std::optional<Cell> free_in(Cell cell) const {
    if (!complex_.contains(cell) || kept_.contains(cell)) return std::nullopt;
    return only_coface(complex_, cell);
  }

  /// Removes a cell, if it is free, with what it is a face of, which it returns. Calls add() for
  /// the faces that are left of both.
  template <class Add>
  std::optional<Cell> remove(Cell cell, const Add& add) {
    constexpr std::size_t check_every = 1U << 16U;
    if (++steps_ % check_every == 0) control_.check(2 * complex_.bytes() + kept_.bytes());
    const auto coface = free_in(cell);
    if (!coface) return std::nullopt;
    complex_.erase(cell);
    complex_.erase(*coface);
    each_cell(*coface, faces_of(*coface) & complex_.around(*coface), add);
    return coface;
  }

  CubicalComplex& complex_;
  const CubicalComplex& kept_;
  const Control& control_;
  std::size_t steps_ = 0;
};

/// Removes one kept square that belongs to a single cube. Whether there was one.
bool open_cubes(const CubicalComplex& complex, CubicalComplex& kept) {
  bool opened = false;
  each_voxel(complex, [&](Cell cell) {
    if (opened || dimension(cell) != 3) return;
    each_cell(cell, faces_of(cell), [&](Cell face) {
      if (opened || dimension(face) != 2 || !only_coface(complex, face)) return;
      kept.erase(face);
      opened = true;
    });
  });
  return opened;
}

}  // namespace

Neighbourhood faces_of(Cell cell) { return face_masks[parity(cell)]; }
Neighbourhood cofaces_of(Cell cell) { return coface_masks[parity(cell)]; }

void insert_closed(CubicalComplex& complex, Cell cell) {
  complex.insert(cell);
  each_cell(cell, faces_of(cell), [&](Cell face) { complex.insert(face); });
}

CubicalComplex complex_of(const VoxelSet& voxels) {
  const GridSize& size = voxels.size();
  CubicalComplex complex({2 * size[0] + 1, 2 * size[1] + 1, 2 * size[2] + 1});
  each_voxel(voxels, [&](Cell voxel) { insert_closed(complex, cube_of(voxel)); });
  return complex;
}

void collapse(CubicalComplex& complex, CubicalComplex kept, int longest,
              const std::function<double(Cell)>& off_axis, const Control& control) {
  // Half the diagonal of a cube: from there on the axis is nearer to another edge.
  constexpr double farthest = 0.87;
  CubicalComplex rest = complex;
  for (const Cell edge : Collapse(rest, kept, control).layers(longest))
    if (off_axis(edge) < farthest) insert_closed(kept, edge);
  do {
    Collapse(complex, kept, control).run(off_axis);
  } while (open_cubes(complex, kept));
}

}  // namespace medial::volume
