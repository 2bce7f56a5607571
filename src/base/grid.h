#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "medial/geometry.h"

namespace medial::raster {

/// The place of a pixel: its column along x and its row along y, from 0.
struct Pixel {
  std::uint32_t column = 0;
  std::uint32_t row = 0;
  friend constexpr bool operator==(Pixel, Pixel) = default;
  /// Orders by row, then by column.
  friend constexpr bool operator<(Pixel a, Pixel b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  }
};

/// The pixels first..last of a row, all in one set.
struct PixelRun {
  std::uint32_t row = 0, first = 0, last = 0;
  std::uint32_t set = 0;
};

/// A grid of square pixels in the plane, in units of the input.
struct Grid {
  Vec2 origin;      ///< centre of pixel (0, 0)
  double step = 1;  ///< side of a pixel
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;

  std::uint64_t size() const { return std::uint64_t{columns} * rows; }
  Vec2 center(Pixel p) const { return {origin.x + step * p.column, origin.y + step * p.row}; }
  /// The index of a pixel in row-major order.
  std::uint64_t index(Pixel p) const { return std::uint64_t{p.row} * columns + p.column; }
};

/// One bit per pixel of a grid. Every row begins at a whole word.
class BitMap {
 public:
  BitMap(std::uint32_t columns, std::uint32_t rows)
      : columns_(columns),
        rows_(rows),
        words_per_row_((columns + 63) / 64),
        words_(std::size_t{words_per_row_} * rows) {}

  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return rows_; }
  bool contains(std::int64_t column, std::int64_t row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_;
  }
  bool at(Pixel p) const { return (words_[word(p)] >> (p.column & 63)) & 1; }
  void set(Pixel p) { words_[word(p)] |= std::uint64_t{1} << (p.column & 63); }
  void clear(Pixel p) { words_[word(p)] &= ~(std::uint64_t{1} << (p.column & 63)); }
  /// Sets the bit. Returns whether it was set before.
  bool test_and_set(Pixel p) {
    std::uint64_t& w = words_[word(p)];
    const std::uint64_t bit = std::uint64_t{1} << (p.column & 63);
    const bool was = (w & bit) != 0;
    w |= bit;
    return was;
  }
  /// The words of a row, pixel 0 in the lowest bit of the first; bits beyond the last column are 0.
  std::span<const std::uint64_t> row(std::uint32_t r) const {
    return std::span(words_).subspan(std::size_t{r} * words_per_row_, words_per_row_);
  }
  std::span<std::uint64_t> row(std::uint32_t r) {
    return std::span(words_).subspan(std::size_t{r} * words_per_row_, words_per_row_);
  }
  std::uint32_t words_per_row() const { return words_per_row_; }

 private:
  std::size_t word(Pixel p) const { return std::size_t{p.row} * words_per_row_ + (p.column >> 6); }
  std::uint32_t columns_, rows_, words_per_row_;
  std::vector<std::uint64_t> words_;
};

}  // namespace medial::raster
