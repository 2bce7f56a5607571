#pragma once

// The corridors of a spanning tree of a square grid as a polygon: mazes of tests and of papers.

#include <array>
#include <cstddef>
#include <vector>

#include "medial/geometry.h"

namespace medial::test {

/// Which sides of a cell are open: below, right, above, left.
using OpenSides = std::array<bool, 4>;

/// The walls of corridors 6 wide in cells of 10, `side` times `side`, counter-clockwise.
inline std::vector<Vec2> walls_of(const std::vector<OpenSides>& open, std::size_t side) {
  enum : std::size_t { below, right, above, left };
  // Follow the wall on the right-hand side, that is with the corridor on the left. A closed side is
  // walked along; an open one is the mouth of a passage, whose wall is followed to the next cell.
  std::vector<Vec2> points;
  std::size_t cell = 0, at = below;
  bool through_passage = false;
  do {
    const bool is_open = open[cell][at];
    if (is_open == through_passage) {
      const double x = 10 * static_cast<double>(cell % side);
      const double y = 10 * static_cast<double>(cell / side);
      points.push_back(
          {x + (at == right || at == above ? 8 : 2), y + (at == above || at == left ? 8 : 2)});
    }
    if (is_open) cell = std::array{cell - side, cell + 1, cell + side, cell - 1}[at];
    at = (at + (is_open ? 3 : 1)) % 4;
    through_passage = is_open;
  } while (cell != 0 || at != below);
  return points;
}

}  // namespace medial::test
