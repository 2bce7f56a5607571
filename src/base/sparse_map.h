#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "base/grid.h"

namespace medial::raster {

/// Values for some pixels of a grid; all other pixels have `absent`. Stores tiles of 8 x 8 pixels,
/// only where a value was set, plus four bytes for each tile of the grid.
template <class Value>
class SparseMap {
 public:
  SparseMap(std::uint32_t columns, std::uint32_t rows, Value absent)
      : absent_(absent),
        tiles_per_row_((columns + 7) / 8),
        directory_(std::size_t{tiles_per_row_} * ((rows + 7) / 8), 0) {}

  Value at(Pixel p) const {
    const std::uint32_t tile = directory_[tile_of(p)];
    return tile == 0 ? absent_ : tiles_[tile - 1][place_of(p)];
  }
  /// The value, for assignment.
  Value& operator[](Pixel p) {
    std::uint32_t& tile = directory_[tile_of(p)];
    if (tile == 0) {
      tiles_.emplace_back().fill(absent_);
      tile = static_cast<std::uint32_t>(tiles_.size());
    }
    return tiles_[tile - 1][place_of(p)];
  }

 private:
  std::size_t tile_of(Pixel p) const {
    return std::size_t{p.row >> 3} * tiles_per_row_ + (p.column >> 3);
  }
  static std::size_t place_of(Pixel p) { return (p.row & 7) * 8 + (p.column & 7); }

  Value absent_;
  std::uint32_t tiles_per_row_;
  std::vector<std::uint32_t> directory_;  ///< the tile's index plus one; 0: no tile
  std::deque<std::array<Value, 64>> tiles_;
};

}  // namespace medial::raster
