#include "methods/raster/ridge/digitize.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "base/disjoint_sets.h"
#include "base/numbers.h"
#include "base/runs.h"
#include "base/tolerance.h"

namespace medial::ridge {

using raster::BitMap;
using raster::Grid;

Result<Grid> grid_for(const Box& box, const PixelGrid& wanted) {
  constexpr std::uint64_t default_pixels = 1024;
  const Vec2 size = box.high - box.low;
  const double longer = std::max(size.x, size.y);
  if (wanted.resolution != 0 && wanted.pixels != 0)
    return Error{
        ErrorCode::invalid_option, "either a resolution or a number of pixels, not both", {}};
  if (!(wanted.resolution >= 0 && wanted.resolution <= longer))
    return Error{ErrorCode::invalid_option,
                 "the resolution must be above 0 and not larger than the shape",
                 {}};
  const double pixels = static_cast<double>(wanted.pixels > 0 ? wanted.pixels : default_pixels);
  const double step = wanted.resolution > 0 ? wanted.resolution : longer / pixels;
  // Where the shape is made of pixels, rounding must not shift the grid by half of one.
  constexpr double rounding = 1e-6;
  const double columns = std::ceil(size.x / step - rounding) + 2;
  const double rows = std::ceil(size.y / step - rounding) + 2;
  if (!(columns * rows <= static_cast<double>(most_pixels)))
    return Error{ErrorCode::too_large, "the grid has more than 2^31 pixels", {}};
  if (!(step > 16 * spacing_in(box)))
    return Error{ErrorCode::unsupported,
                 "the pixels are not larger than the spacing of the coordinates",
                 {}};
  const Vec2 middle = midpoint(box.low, box.high);
  return Grid{{middle.x - 0.5 * step * (columns - 1), middle.y - 0.5 * step * (rows - 1)},
              step,
              static_cast<std::uint32_t>(columns),
              static_cast<std::uint32_t>(rows)};
}

namespace {

/// The whole number nearest to v in [0, count).
std::uint32_t rounded(double v, std::uint32_t count) {
  return static_cast<std::uint32_t>(std::clamp(std::floor(v + 0.5), 0.0, count - 1.0));
}

struct WholeNumbers {
  std::int64_t first, last;  ///< none where last < first
};
/// The whole numbers v with low <= v < high.
WholeNumbers between(double low, double high) {
  return {static_cast<std::int64_t>(std::ceil(low)),
          static_cast<std::int64_t>(std::ceil(high)) - 1};
}

void draw_edge(Vec2 a, Vec2 b, BitMap& map) {
  map.set({rounded(a.x, map.columns()), rounded(a.y, map.rows())});
  const Vec2 d = b - a;
  if (std::abs(d.x) >= std::abs(d.y)) {
    const WholeNumbers span = between(std::min(a.x, b.x), std::max(a.x, b.x));
    for (std::int64_t x = span.first; x <= span.last; ++x)
      map.set({static_cast<std::uint32_t>(x),
               rounded(a.y + (static_cast<double>(x) - a.x) * (d.y / d.x), map.rows())});
  } else {
    const WholeNumbers span = between(std::min(a.y, b.y), std::max(a.y, b.y));
    for (std::int64_t y = span.first; y <= span.last; ++y)
      map.set({rounded(a.x + (static_cast<double>(y) - a.y) * (d.x / d.y), map.columns()),
               static_cast<std::uint32_t>(y)});
  }
}

}  // namespace

BitMap boundary_map(const EdgeOutline& outline, const LocalGrid& local) {
  BitMap map(local.grid.columns, local.grid.rows);
  for (std::size_t e = 0; e < outline.edges.size(); ++e)
    draw_edge(local.in_pixels(outline.edges[e].point),
              local.in_pixels(outline.edges[outline.next[e]].point), map);
  return map;
}

std::vector<PixelRun> runs_of(const BitMap& map, std::uint32_t& sets) {
  std::vector<PixelRun> runs;
  DisjointSets joined;
  std::size_t below = 0, below_end = 0;  // the runs of the row before
  for (std::uint32_t r = 0; r < map.rows(); ++r) {
    const std::size_t begin = runs.size();
    for_each_run(map.row(r), map.columns(), [&](std::int64_t first, std::int64_t end) {
      runs.push_back({r, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end - 1),
                      joined.add()});
    });
    for (std::size_t i = begin; i < runs.size(); ++i) {
      while (below < below_end && runs[below].last < runs[i].first) ++below;
      for (std::size_t j = below; j < below_end && runs[j].first <= runs[i].last; ++j)
        joined.join(runs[i].set, runs[j].set);
    }
    below = begin;
    below_end = runs.size();
  }
  sets = 0;
  std::vector<std::uint32_t> number(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::uint32_t lowest = joined.find(runs[i].set);
    if (lowest == i) number[i] = sets++;
    runs[i].set = number[lowest];
  }
  return runs;
}

InteriorSets interior_sets(const EdgeOutline& outline, const LocalGrid& local,
                           const BitMap& boundary) {
  // Where each row of centres crosses the boundary.
  const auto each_crossing = [&](auto take) {
    for (std::size_t e = 0; e < outline.edges.size(); ++e) {
      const Vec2 a = local.in_pixels(outline.edges[e].point);
      const Vec2 b = local.in_pixels(outline.edges[outline.next[e]].point);
      const WholeNumbers rows = between(std::min(a.y, b.y), std::max(a.y, b.y));
      for (std::int64_t y = rows.first; y <= rows.last; ++y)
        take(static_cast<std::size_t>(y), a, b);
    }
  };
  std::vector<std::size_t> begin(std::size_t{local.grid.rows} + 1, 0);
  each_crossing([&](std::size_t row, Vec2, Vec2) { ++begin[row + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<double> crossing(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  each_crossing([&](std::size_t row, Vec2 a, Vec2 b) {
    const double share = (static_cast<double>(row) - a.y) / (b.y - a.y);
    crossing[next[row]++] = a.x + share * (b.x - a.x);
  });

  InteriorSets sets{BitMap(local.grid.columns, local.grid.rows), {}, 0};
  for (std::uint32_t r = 0; r < local.grid.rows; ++r) {
    const auto first = crossing.begin() + static_cast<std::ptrdiff_t>(begin[r]);
    const auto last = crossing.begin() + static_cast<std::ptrdiff_t>(begin[r + 1]);
    std::sort(first, last);
    const std::span<std::uint64_t> words = sets.inside.row(r);
    for (auto x = first; x + 1 < last; x += 2) {
      const double low = std::max(0.0, std::ceil(*x));
      const double high = std::min(local.grid.columns - 1.0, std::floor(*(x + 1)));
      if (low <= high)
        set_bits(words, static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(high));
    }
    const std::span<const std::uint64_t> drawn = boundary.row(r);
    for (std::uint32_t w = 0; w < sets.inside.words_per_row(); ++w) words[w] &= ~drawn[w];
  }
  sets.runs = runs_of(sets.inside, sets.count);
  return sets;
}

std::vector<Vec2> inner_points(const EdgeOutline& outline) {
  std::vector<std::uint32_t> highest, concave, before(outline.edges.size());
  const auto height = [&](std::uint32_t e) { return outline.edges[e].point.y; };
  const auto raise = [&](std::vector<std::uint32_t>& top, std::uint32_t e) {
    std::uint32_t& best = top[outline.component[e]];
    if (best == none || height(e) > height(best)) best = e;
  };
  for (std::uint32_t e = 0; e < outline.edges.size(); ++e) {
    before[outline.next[e]] = e;
    const std::size_t needed = std::size_t{outline.component[e]} + 1;
    if (highest.size() < needed) {
      highest.resize(needed, none);
      concave.resize(needed, none);
    }
    raise(highest, e);
    if (outline.type[e] == VertexType::concave) raise(concave, e);
  }
  std::vector<Vec2> points;
  for (std::size_t c = 0; c < highest.size(); ++c) {
    if (highest[c] == none) continue;
    const Vec2 b = outline.edges[highest[c]].point;
    const auto cut_off = [&](std::uint32_t e) {
      const Vec2 end = outline.edges[e].point;
      if (concave[c] == none || !(end.y < height(concave[c])) || !(b.y > end.y)) return end;
      return b + ((b.y - height(concave[c])) / (b.y - end.y)) * (end - b);
    };
    const Vec2 p = cut_off(before[highest[c]]), q = cut_off(outline.next[highest[c]]);
    points.push_back((1.0 / 3) * (b + p + q));
  }
  return points;
}

}  // namespace medial::ridge
