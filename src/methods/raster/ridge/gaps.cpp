#include "methods/raster/ridge/gaps.h"

#include <algorithm>
#include <numeric>

#include "base/disjoint_sets.h"
#include "base/numbers.h"
#include "base/runs.h"
#include "methods/raster/ridge/thin.h"

namespace medial::ridge {
namespace {

using raster::BitMap;
using raster::Pixel;

/// The pixels of the interior that are not medial, and which sets of them touch a boundary.
struct Rest {
  std::vector<PixelRun> runs;
  std::vector<std::size_t> row_begin;  ///< in `runs`; of each row and of one more
  std::vector<bool> touches;           ///< of each set
  bool any_gap() const { return std::find(touches.begin(), touches.end(), false) != touches.end(); }
  std::uint32_t set_of(Pixel p) const {
    const auto from = runs.begin() + static_cast<std::ptrdiff_t>(row_begin[p.row]);
    const auto to = runs.begin() + static_cast<std::ptrdiff_t>(row_begin[std::size_t{p.row} + 1]);
    return (std::upper_bound(
                from, to, p.column,
                [](std::uint32_t column, const PixelRun& b) { return column < b.first; }) -
            1)
        ->set;
  }
};

Rest rest_of(const InteriorSets& sets, const BitMap& boundary, const BitMap& medial) {
  BitMap map = sets.inside;
  for (std::uint32_t r = 0; r < map.rows(); ++r)
    for (std::uint32_t w = 0; w < map.words_per_row(); ++w) map.row(r)[w] &= ~medial.row(r)[w];
  Rest rest;
  std::uint32_t count = 0;
  rest.runs = runs_of(map, count);
  rest.row_begin.assign(std::size_t{map.rows()} + 1, 0);
  for (const PixelRun& run : rest.runs) ++rest.row_begin[std::size_t{run.row} + 1];
  std::partial_sum(rest.row_begin.begin(), rest.row_begin.end(), rest.row_begin.begin());
  rest.touches.assign(count, false);
  const auto any = [&](std::uint32_t row, std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t c = first; c <= last; ++c)
      if (boundary.at({c, row})) return true;
    return false;
  };
  for (const PixelRun& run : rest.runs)
    if (!rest.touches[run.set])
      rest.touches[run.set] =
          boundary.at({run.first - 1, run.row}) || boundary.at({run.last + 1, run.row}) ||
          any(run.row - 1, run.first, run.last) || any(run.row + 1, run.first, run.last);
  return rest;
}

/// A pixel of a line beside a gap.
struct Wall {
  double quality;
  Pixel pixel;
};

/// All walls that may go, those of the largest quality first.
std::vector<Wall> walls_beside(const BitMap& gaps, const MedialMap& map) {
  std::vector<Wall> walls;
  const auto is_gap_beside = [&](Pixel p) {
    for (int direction = 0; direction < 8; direction += 2)
      if (gaps.at(neighbour(p, direction))) return true;
    return false;
  };
  for (const Found& found : map.found)
    if (!found.is_pinned() && map.medial.at(found.pixel) && is_gap_beside(found.pixel))
      walls.push_back({found.quality, found.pixel});
  std::sort(walls.begin(), walls.end(), [](const Wall& a, const Wall& b) {
    if (a.quality != b.quality) return a.quality > b.quality;
    return b.pixel < a.pixel;
  });
  return walls;
}

}  // namespace

void fill_gaps(const InteriorSets& sets, const BitMap& boundary, Follower& follower) {
  const BitMap& medial = follower.map().medial;
  const Rest rest = rest_of(sets, boundary, medial);
  if (!rest.any_gap()) return;
  std::vector<bool> narrow(rest.touches.size());
  for (std::size_t i = 0; i < narrow.size(); ++i) narrow[i] = !rest.touches[i];
  const auto each_pixel = [&](auto work) {
    for (const PixelRun& run : rest.runs)
      for (std::uint32_t c = run.first; c <= run.last && narrow[run.set]; ++c)
        work(run, Pixel{c, run.row});
  };
  each_pixel([&](const PixelRun& run, Pixel p) {
    bool beside = false;
    for (int direction = 0; direction < 8; direction += 2)
      beside = beside || medial.at(neighbour(p, direction));
    if (!beside) narrow[run.set] = false;
  });
  each_pixel([&](const PixelRun&, Pixel p) { follower.map().add(follower.measured(p)); });
}

void open_gaps(const InteriorSets& sets, const BitMap& boundary, MedialMap& map) {
  const Rest rest = rest_of(sets, boundary, map.medial);
  if (!rest.any_gap()) return;
  BitMap gaps(map.medial.columns(), map.medial.rows());
  for (const PixelRun& run : rest.runs)
    if (!rest.touches[run.set]) set_bits(gaps.row(run.row), run.first, run.last);

  // Sets that were opened to each other; the last number stands for all that touch a boundary.
  const auto outside = static_cast<std::uint32_t>(rest.touches.size());
  DisjointSets joined(rest.touches.size() + 1);
  for (std::uint32_t i = 0; i < outside; ++i)
    if (rest.touches[i]) joined.join(i, outside);
  // A pixel taken away belongs to the set that it opened; by its place in `found`.
  std::vector<std::uint32_t> opened(map.found.size(), none);
  const auto set_at = [&](Pixel q) {
    if (gaps.at(q)) return rest.set_of(q);
    const std::uint32_t place = map.place.at(q);
    return place == 0 || opened[place - 1] == none ? outside : opened[place - 1];
  };
  for (const Wall& wall : walls_beside(gaps, map)) {
    // What lies on its sides, one after the other around it.
    const std::uint8_t closed = closed_neighbours(map.medial, boundary, wall.pixel);
    const auto set = [&](std::size_t direction) { return (closed >> (direction % 8) & 1) != 0; };
    std::array<std::uint32_t, 4> side{};
    std::size_t sides = 0;
    std::size_t start = 0;
    while (start < 8 && !set(start)) ++start;
    if (start == 8) continue;
    for (std::size_t i = 1; i <= 8; ++i) {
      const std::size_t d = (start + i) % 8;
      if (set(d) || d % 2 == 1) continue;
      const Pixel q = neighbour(wall.pixel, static_cast<int>(d));
      const std::uint32_t what = joined.find(set_at(q));
      const bool same_side = sides > 0 && !set(d + 7) && !set(d + 6);
      if (!same_side) side[sides++] = what;
    }
    if (sides != 2 || side[0] == side[1]) continue;
    map.medial.clear(wall.pixel);
    joined.join(side[0], side[1]);
    opened[map.place.at(wall.pixel) - 1] = side[0];
  }
}

}  // namespace medial::ridge
