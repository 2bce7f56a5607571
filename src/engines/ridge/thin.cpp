#include "engines/ridge/thin.h"

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <vector>

namespace medial::ridge {

using raster::BitMap;
using raster::Pixel;

namespace {

/// Whether one pixel is worse than another; no two are equal.
bool is_worse(const Found& a, const Found& b) {
  if (a.quality != b.quality) return a.quality > b.quality;
  return a.pixel.row != b.pixel.row ? a.pixel.row > b.pixel.row : a.pixel.column > b.pixel.column;
}

/// Takes pixels away in the order given, as often as that changes anything. Whether one may go must
/// depend on the pixels up to two columns and rows away only: unless one of those has gone since, a
/// pixel that had to stay is not asked again.
template <class MayGo>
void thin(const BitMap& boundary, MedialMap& map, const std::vector<std::uint32_t>& order,
          MayGo may_go) {
  using Ranks = std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>>;
  std::vector<std::uint32_t> rank(map.found.size(), 0);
  for (std::uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
  std::vector<bool> waits(order.size(), true);  // to be asked in this round or the next
  Ranks now, later;
  const auto ask = [&](std::uint32_t i) {
    waits[i] = false;
    const Found& found = map.found[order[i]];
    if (found.is_pinned() || !may_go(found) || !is_simple(map.medial, boundary, found.pixel))
      return;
    map.medial.clear(found.pixel);
    for (std::uint32_t row = found.pixel.row - 2; row != found.pixel.row + 3; ++row)
      for (std::uint32_t column = found.pixel.column - 2; column != found.pixel.column + 3;
           ++column) {
        if (!map.medial.contains(column, row) || !map.medial.at({column, row})) continue;
        const std::uint32_t other = rank[map.place.at({column, row}) - 1];
        if (waits[other]) continue;
        waits[other] = true;
        (other > i ? now : later).push(other);
      }
  };
  for (std::uint32_t i = 0; i < order.size(); ++i) ask(i);
  while (!later.empty()) {
    std::swap(now, later);
    while (!now.empty()) {
      const std::uint32_t i = now.top();
      now.pop();
      if (map.medial.at(map.found[order[i]].pixel)) ask(i);
    }
  }
}

/// The five bits of a row around a column, the one two to the left lowest; beyond the map none.
std::uint32_t five_bits(const BitMap& map, std::int64_t row, std::uint32_t column) {
  if (row < 0 || row >= map.rows()) return 0;
  const std::uint64_t* words = map.row(static_cast<std::uint32_t>(row));
  const std::uint32_t word = column >> 6, bit = column & 63;
  std::uint64_t bits = bit >= 2 ? words[word] >> (bit - 2) : words[word] << (2 - bit);
  if (bit < 2 && word > 0) bits |= words[word - 1] >> (62 + bit);
  if (bit > 61 && word + 1 < map.words_per_row()) bits |= words[word + 1] << (66 - bit);
  return static_cast<std::uint32_t>(bits & 31);
}

/// Whether, with a medial pixel gone, all pixels among it and its neighbours that the axis passes
/// still are medial or have a medial neighbour.
bool stays_near(const BitMap& passed, const BitMap& medial, Pixel p) {
  std::array<std::uint32_t, 5> there{}, asked{};
  for (std::size_t i = 0; i < 5; ++i) {
    const std::int64_t row = std::int64_t{p.row} + static_cast<std::int64_t>(i) - 2;
    there[i] = five_bits(medial, row, p.column);
    asked[i] = five_bits(passed, row, p.column);
  }
  there[2] &= ~4u;
  for (std::size_t row = 1; row < 4; ++row) {
    const std::uint32_t any = there[row - 1] | there[row] | there[row + 1];
    const std::uint32_t near = any | any << 1 | any >> 1;
    if ((asked[row] & ~near & 0b01110u) != 0) return false;
  }
  return true;
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

void thin_to_lines(const BitMap& boundary, double step, MedialMap& map) {
  std::vector<std::uint32_t> order = map.in_rows();
  BitMap passed(map.medial.columns(), map.medial.rows());
  for (const std::uint32_t place : order)
    if (map.found[place].quality <= step) passed.set(map.found[place].pixel);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return is_worse(map.found[a], map.found[b]); });
  thin(boundary, map, order,
       [&](const Found& found) { return stays_near(passed, map.medial, found.pixel); });
}

}  // namespace medial::ridge
