#include "methods/raster/brushfire/fill.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/arc.h"
#include "base/runs.h"

namespace medial::brushfire {
namespace {

/// Where the boundary passes a row of centres.
struct Crossing {
  std::uint32_t row;
  bool enters;  ///< into the shape, from the left to the right
  std::uint32_t component;
  double x;  ///< in pixels

  /// From the left; at one place what leaves comes first.
  friend bool operator<(const Crossing& a, const Crossing& b) {
    return std::tie(a.x, a.enters) < std::tie(b.x, b.enters);
  }
};

/// Crossings row by row, each from the left.
std::vector<Crossing> sorted(const std::vector<Crossing>& crossings, std::uint32_t rows) {
  std::vector<std::size_t> end(rows + std::size_t{1}, 0);  // first the begin of each row
  for (const Crossing& crossing : crossings) ++end[crossing.row + 1];
  for (std::size_t row = 0; row < rows; ++row) end[row + 1] += end[row];
  std::vector<Crossing> by_rows(crossings.size());
  for (const Crossing& crossing : crossings) by_rows[end[crossing.row]++] = crossing;
  for (std::size_t row = 0, begin = 0; row < rows; begin = end[row++])
    std::sort(by_rows.begin() + static_cast<std::ptrdiff_t>(begin),
              by_rows.begin() + static_cast<std::ptrdiff_t>(end[row]));
  return by_rows;
}

class Scan {
 public:
  explicit Scan(const raster::Grid& grid) : grid_(grid) {}

  void add_edge(Vec2 start, Vec2 end, double bulge, std::uint32_t component) {
    add(in_pixels(start), in_pixels(end), bulge, component);
  }

  std::vector<raster::PixelRun> runs() {
    const std::vector<Crossing> crossings = sorted(crossings_, grid_.rows);
    std::vector<raster::PixelRun> runs;
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const Crossing& in = crossings[i];
      const Crossing& out = crossings[i + 1];
      const double first = std::max(std::ceil(in.x), 0.0);
      const double last = std::min(std::ceil(out.x) - 1, grid_.columns - 1.0);
      if (first > last) continue;
      runs.push_back({in.row, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last),
                      (in.enters ? in : out).component});
    }
    return runs;
  }

 private:
  Vec2 in_pixels(Vec2 p) const { return (1 / grid_.step) * (p - grid_.origin); }

  void add(Vec2 start, Vec2 end, double bulge, std::uint32_t component) {
    // The largest distance of an arc from its chord is half its bulge times the chord's length.
    constexpr double flat = 1e-3;
    if (std::abs(bulge) * norm(end - start) > 2 * flat) {
      const Vec2 middle = apex({start, end, bulge});
      const double half = half_bulge(bulge);
      add(start, middle, half, component);
      add(middle, end, half, component);
      return;
    }
    const bool down = end.y < start.y;
    const Vec2 low = down ? end : start, high = down ? start : end;
    const double first = std::max(std::ceil(low.y), 0.0);
    const double last = std::min(std::ceil(high.y) - 1, grid_.rows - 1.0);
    for (double y = first; y <= last; ++y) {
      const double x = low.x + (y - low.y) * ((high.x - low.x) / (high.y - low.y));
      crossings_.push_back({static_cast<std::uint32_t>(y), down, component, x});
    }
  }

  const raster::Grid& grid_;
  std::vector<Crossing> crossings_;
};

}  // namespace

std::vector<raster::PixelRun> runs_inside(const Shape& shape, const raster::Grid& grid) {
  Scan scan(grid);
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
    const std::uint32_t begin = shape.loop_begin[loop], end = shape.loop_begin[loop + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      scan.add_edge(shape.points[i], shape.points[i + 1 == end ? begin : i + 1], shape.bulge(i),
                    shape.component[loop]);
    }
  }
  return scan.runs();
}

Image image_of(const std::vector<raster::PixelRun>& runs, const raster::Grid& grid) {
  Image image(grid.columns, grid.rows);
  for (const raster::PixelRun& run : runs) set_bits(image.row(run.row), run.first, run.last);
  return image;
}

}  // namespace medial::brushfire
