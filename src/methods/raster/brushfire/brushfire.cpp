#include "methods/raster/brushfire/brushfire.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "axis/pixel_graph.h"
#include "axis/sites.h"
#include "base/stopwatch.h"
#include "medial/raster.h"
#include "methods/raster/brushfire/fill.h"
#include "methods/raster/brushfire/layers.h"
#include "methods/raster/ridge/digitize.h"
#include "site/boundary_tree.h"

namespace medial::brushfire {
namespace {

/// The edges of a shape, and those of each component: first and last.
struct ComponentEdges {
  std::vector<site::Site> all;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> range;

  ComponentEdges(const Shape& shape, const LocalFrame& frame)
      : range(shape.component_count(), {~std::uint32_t{0}, 0}) {
    all.reserve(shape.points.size());
    for (std::size_t i = 0; i < shape.loop_count(); ++i) {
      auto& [first, last] = range[shape.component[i]];
      first = std::min(first, static_cast<std::uint32_t>(all.size()));
      const site::LoopEdges loop(shape, i, frame);
      for (std::uint32_t k = 0; k < loop.size(); ++k) {
        const site::Pieces pieces = loop.edge(k);
        all.insert(all.end(), pieces.site.begin(), pieces.site.begin() + pieces.count);
      }
      last = static_cast<std::uint32_t>(all.size() - 1);
    }
  }
};

/// Exact distances of pixels from the boundary, row by row. The edge nearest to a place in a
/// component is one of that component's.
class Radius {
 public:
  Radius(const Shape& shape, const LocalFrame& frame, const raster::Grid& grid)
      : frame_(frame),
        grid_(grid),
        edges_(shape, frame),
        tree_(edges_.all),
        nearest_(grid.columns + 2) {}

  double at(const raster::Pixel& pixel, std::uint32_t component) {
    const Vec2 local = frame_.to_local(grid_.center(pixel));
    // Neighbours to the left and above mostly have the same nearest edge.
    double squared = std::numeric_limits<double>::infinity();
    for (const std::uint32_t edge : std::span(nearest_).subspan(pixel.column, 3))
      squared = std::min(squared, site::squared_distance(edges_.all[edge], local));
    const auto [first, last] = edges_.range[component];
    const auto hit = tree_.nearest(local, std::sqrt(squared) * (1 + 1e-9), first, last);
    if (hit) {
      squared = hit.squared_distance;
      nearest_[pixel.column + 1] = hit.site;
    }
    return frame_.inverse * std::sqrt(squared);
  }

 private:
  const LocalFrame& frame_;
  const raster::Grid& grid_;
  const ComponentEdges edges_;
  const site::BoundaryTree tree_;
  std::vector<std::uint32_t> nearest_;  ///< of the last pixel in each column: an edge
};

/// The pixels of the axis in the order of increasing x within increasing y.
std::vector<MedialPixel> pixels_of(const Image& axis, const std::vector<raster::PixelRun>& runs,
                                   Radius& radius) {
  std::vector<MedialPixel> pixels;
  pixels.reserve(axis.count());
  for (const raster::PixelRun& run : runs) {
    const std::span<const std::uint64_t> row = axis.row(run.row);
    for (std::size_t w = run.first / 64; w <= run.last / 64; ++w) {
      for (std::uint64_t bits = row[w]; bits != 0; bits &= bits - 1) {
        const auto column =
            static_cast<std::uint32_t>(w * 64) + static_cast<std::uint32_t>(std::countr_zero(bits));
        if (column < run.first || column > run.last) continue;
        const raster::Pixel pixel{column, run.row};
        pixels.push_back({pixel, radius.at(pixel, run.set), run.set, {no_site, no_site}});
      }
    }
  }
  return pixels;
}

}  // namespace

std::optional<Error> refuse(const Problem& problem) {
  const auto grid = ridge::grid_for(problem.box, problem.own<method::Brushfire>().grid);
  if (!grid) return grid.error();
  if (!fits_image(grid->columns, grid->rows))
    return Error{ErrorCode::too_large, "the diagonal of the grid is above 2^16 pixels", {}};
  return std::nullopt;
}

Result<MedialAxis> run(const Problem& problem) {
  const auto& own = problem.own<method::Brushfire>();
  MedialAxis axis;
  axis.method = "brushfire";
  Statistics& statistics = axis.statistics;
  Stopwatch all, watch;
  axis.tolerance = problem.tolerance;

  const raster::Grid grid = ridge::grid_for(problem.box, own.grid).value();
  const std::vector<raster::PixelRun> runs = runs_inside(problem.shape, grid);
  if (runs.empty())
    return Error{ErrorCode::unsupported,
                 "no pixel's centre lies inside the shape: the resolution is too low",
                 {}};
  statistics.seconds_sites = watch.lap();
  Radius radius(problem.shape, problem.frame, grid);
  statistics.seconds_tree = watch.lap();

  axis.sites = problem.result_sites();
  for (const auto& layer : layers_of(runs)) {
    const Result<Image> burnt =
        thin(image_of(layer, grid), {own.family, problem.options.progress, problem.options.cancel});
    if (!burnt) return burnt.error();
    statistics.seconds_walk += watch.lap();
    link_pixels(grid, pixels_of(*burnt, layer, radius), nullptr, axis);
    statistics.seconds_collect += watch.lap();
  }
  statistics.queries = axis.nodes.size();
  statistics.seconds = all.lap();
  return axis;
}

}  // namespace medial::brushfire
