#include "methods/raster/finer_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "medial/raster.h"
#include "methods/raster/brushfire/fill.h"
#include "methods/raster/brushfire/layers.h"
#include "methods/raster/ridge/digitize.h"

namespace medial::raster {
namespace {

double longer_side(const Box& box) {
  return std::max(box.high.x - box.low.x, box.high.y - box.low.y);
}

/// As many that a line of pixels' centres crosses each loop: none lies within a square of four.
std::uint32_t pixels_for_ridge(const Shape& shape, double resolution) {
  constexpr double some_more = 1.01;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    Box box = Box::nothing();
    for (const Vec2 p : shape.loop(i)) box.add(p);
    least = std::min(least, longer_side(box));
  }
  const double longer = longer_side(bounding_box(shape));
  const double pixels = std::ceil(some_more * longer / least);
  if (!(pixels < std::numeric_limits<std::uint32_t>::max() && pixels > longer / resolution))
    return 0;
  const PixelGrid wanted{.pixels = static_cast<std::uint32_t>(pixels)};
  return ridge::grid_for(bounding_box(shape), wanted) ? wanted.pixels : 0;
}

std::uint32_t pixels_for_brushfire(const Shape& shape, double resolution) {
  constexpr int most_doublings = 4;
  const Box box = bounding_box(shape);
  PixelGrid wanted{.pixels = static_cast<std::uint32_t>(std::ceil(longer_side(box) / resolution))};
  for (int i = 0; i < most_doublings; ++i) {
    wanted.pixels *= 2;
    const auto grid = ridge::grid_for(box, wanted);
    if (!grid || !fits_image(grid->columns, grid->rows)) return 0;
    if (brushfire::is_resolved(shape, brushfire::runs_inside(shape, *grid))) return wanted.pixels;
  }
  return 0;
}

}  // namespace

std::uint32_t pixels_that_do(const Shape& shape, std::string_view method, double resolution) {
  return method == "ridge" ? pixels_for_ridge(shape, resolution)
                           : pixels_for_brushfire(shape, resolution);
}

}  // namespace medial::raster
