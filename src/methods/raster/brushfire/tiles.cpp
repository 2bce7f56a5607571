#include "methods/raster/brushfire/tiles.h"

#include <algorithm>

namespace medial::brushfire {

Tiles::Tiles(const Image& image) : Tiles(image.width(), image.height()) {
  for (std::uint32_t y = 0; y < image.height(); ++y) {
    const std::span<const std::uint64_t> row = image.row(y);
    Tile* const tiles = tiles_.data() + index(0, y / 8);
    for (std::size_t column = 0; column < columns_; ++column) {
      const std::uint64_t pixels = row[column / 8] >> (8 * (column % 8)) & 0xff;
      tiles[column] |= pixels << (8 * (y % 8));
    }
  }
}

Image Tiles::image(std::uint32_t width, std::uint32_t height) const {
  Image image(width, height);
  for (std::uint32_t y = 0; y < height; ++y) {
    const std::span<std::uint64_t> row = image.row(y);
    const Tile* const tiles = tiles_.data() + index(0, y / 8);
    for (std::size_t column = 0; column < columns_; ++column) {
      const std::uint64_t pixels = tiles[column] >> (8 * (y % 8)) & 0xff;
      row[column / 8] |= pixels << (8 * (column % 8));
    }
  }
  return image;
}

}  // namespace medial::brushfire
