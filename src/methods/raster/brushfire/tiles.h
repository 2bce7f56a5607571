#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "medial/raster.h"

namespace medial::brushfire {

/// Eight rows of eight pixels: pixel (x, y) is bit 8 y + x.
using Tile = std::uint64_t;

constexpr Tile west_column = 0x0101010101010101;
constexpr Tile east_column = west_column << 7;
constexpr Tile north_row = 0xff;
constexpr Tile south_row = north_row << 56;

/// Each pixel's neighbour to one side, as a tile: bit i is the neighbour of pixel i.
constexpr Tile from_north(Tile tile, Tile north) { return tile << 8 | north >> 56; }
constexpr Tile from_south(Tile tile, Tile south) { return tile >> 8 | south << 56; }
constexpr Tile from_west(Tile tile, Tile west) {
  return (tile & ~east_column) << 1 | (west & east_column) >> 7;
}
constexpr Tile from_east(Tile tile, Tile east) {
  return (tile & ~west_column) >> 1 | (east & west_column) << 7;
}

/// The eight neighbours of each pixel of a tile.
struct Neighbors {
  Tile n, ne, e, se, s, sw, w, nw;
};

/// An image as tiles, with a border of empty ones around.
class Tiles {
 public:
  /// Empty tiles for a width and height in pixels.
  Tiles(std::uint32_t width, std::uint32_t height)
      : columns_((width + 7) / 8), rows_((height + 7) / 8), tiles_(stride() * (rows_ + 2)) {}
  explicit Tiles(const Image& image);

  /// The tiles as an image of their size.
  Image image(std::uint32_t width, std::uint32_t height) const;

  std::size_t stride() const { return columns_ + 2; }
  std::size_t size() const { return tiles_.size(); }
  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  std::size_t index(std::size_t column, std::size_t row) const {
    return (row + 1) * stride() + column + 1;
  }
  Tile& operator[](std::size_t i) { return tiles_[i]; }
  Tile operator[](std::size_t i) const { return tiles_[i]; }

  /// Of a tile that is not one of the border.
  Neighbors neighbors(std::size_t i) const {
    const Tile* const above = tiles_.data() + i - stride();
    const Tile* const here = tiles_.data() + i;
    const Tile* const below = tiles_.data() + i + stride();
    const Tile n = from_north(here[0], above[0]);
    const Tile s = from_south(here[0], below[0]);
    return {n,
            from_east(n, from_north(here[1], above[1])),
            from_east(here[0], here[1]),
            from_east(s, from_south(here[1], below[1])),
            s,
            from_west(s, from_south(here[-1], below[-1])),
            from_west(here[0], here[-1]),
            from_west(n, from_north(here[-1], above[-1]))};
  }

 private:
  std::size_t columns_;
  std::size_t rows_;
  std::vector<Tile> tiles_;
};

}  // namespace medial::brushfire
