#pragma once

// Words in a picture that cover neither each other nor, where there is room, the lines.

#include <cstdint>
#include <string>
#include <vector>

#include "io/pictures/canvas.h"

namespace medial::io {

class Labels {
 public:
  /// `size`: of the letters, in units of the picture.
  Labels(Canvas& canvas, double size);

  /// Lines from place to place of the picture, which labels should not cover.
  void avoid(Vec2 from, Vec2 to);
  /// Draws words at a place of the picture, or beside it: where they cover least. False: there is
  /// no room between the labels before.
  bool put(Vec2 at, const std::string& words, const Color& color);

 private:
  /// How many cells with lines a box covers.
  std::uint32_t covered(const Box& box) const;
  bool is_free(const Box& box) const;
  std::size_t cell_at(Vec2 p) const;

  Canvas& canvas_;
  double size_, cell_;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<bool> lines_;  ///< of each cell: whether there is one
  std::vector<Box> taken_;
};

}  // namespace medial::io
