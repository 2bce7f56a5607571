#include "engines/ridge/thin.h"

#include <algorithm>
#include <array>

namespace medial::ridge {

using raster::BitMap;
using raster::Pixel;

namespace {

/// Whether one pixel is worse than another; no two are equal.
bool is_worse(const Found& a, const Found& b) {
  if (a.quality != b.quality) return a.quality > b.quality;
  return a.pixel.row != b.pixel.row ? a.pixel.row > b.pixel.row : a.pixel.column > b.pixel.column;
}

/// Takes pixels away in the order given, as often as that changes anything.
template <class MayGo>
void thin(const BitMap& boundary, MedialMap& map, std::vector<std::uint32_t> order, MayGo may_go) {
  for (bool changed = true; changed;) {
    std::size_t kept = 0;
    for (const std::uint32_t place : order) {
      const Found& found = map.found[place];
      if (may_go(found) && is_simple(map.medial, boundary, found.pixel))
        map.medial.clear(found.pixel);
      else
        order[kept++] = place;
    }
    changed = kept < order.size();
    order.resize(kept);
  }
}

}  // namespace

std::array<bool, 8> closed_neighbours(const BitMap& medial, const BitMap& boundary, Pixel p) {
  std::array<bool, 8> set{};
  for (int direction = 0; direction < 8; ++direction)
    set[static_cast<std::size_t>(direction)] =
        medial.at(neighbour(p, direction)) && !crosses_contour(boundary, p, direction);
  for (std::size_t d = 1; d < 8; d += 2) set[d] = set[d] || (set[d - 1] && set[(d + 1) % 8]);
  return set;
}

bool is_simple(const BitMap& medial, const BitMap& boundary, Pixel p) {
  const std::array<bool, 8> set = closed_neighbours(medial, boundary, p);
  int elements = 0, changes = 0;
  for (std::size_t d = 0; d < 8; ++d) {
    elements += set[d] ? 1 : 0;
    changes += set[d] && !set[(d + 1) % 8] ? 1 : 0;
  }
  return elements > 2 && changes == 1;
}

void thin_by_report(const BitMap& boundary, MedialMap& map) {
  thin(boundary, map, map.in_rows(), [&](const Found& found) {
    for (int direction = 0; direction < 8; ++direction) {
      const Pixel q = neighbour(found.pixel, direction);
      if (map.medial.at(q) && !crosses_contour(boundary, found.pixel, direction) &&
          !is_worse(found, map.at(q)))
        return false;
    }
    return true;
  });
}

void thin_to_lines(const BitMap& boundary, MedialMap& map) {
  std::vector<std::uint32_t> order = map.in_rows();
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return is_worse(map.found[a], map.found[b]); });
  thin(boundary, map, std::move(order), [](const Found&) { return true; });
}

}  // namespace medial::ridge
