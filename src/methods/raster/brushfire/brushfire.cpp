#include "methods/raster/brushfire/brushfire.h"

#include <bit>
#include <cmath>

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

/// Exact distances from the boundary, of one place after another.
class Radius {
 public:
  Radius(const Shape& shape, const LocalFrame& frame)
      : frame_(frame), edges_(site::edge_sites(shape, frame)), tree_(edges_) {}

  double at(Vec2 point) {
    const Vec2 local = frame_.to_local(point);
    // The distance changes by no more than the way from the place before.
    const double reach = (before_.radius + norm(local - before_.center)) * (1 + 1e-9);
    const auto hit = tree_.nearest(local, reach, 0, static_cast<std::uint32_t>(edges_.size() - 1));
    const double squared = hit ? hit.squared_distance : reach * reach;
    before_ = {local, std::sqrt(squared)};
    return frame_.inverse * before_.radius;
  }

 private:
  const LocalFrame& frame_;
  std::vector<site::Site> edges_;
  site::BoundaryTree tree_;
  Disk before_{{0, 0}, 16};  // farther than anything in the frame
};

/// The pixels of the axis in the order of increasing x within increasing y.
std::vector<MedialPixel> pixels_of(const Image& axis, const std::vector<raster::PixelRun>& runs,
                                   const raster::Grid& grid, Radius& radius) {
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
        pixels.push_back({pixel, radius.at(grid.center(pixel)), run.set, {no_site, no_site}});
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
  Radius radius(problem.shape, problem.frame);
  statistics.seconds_tree = watch.lap();

  axis.sites = problem.result_sites();
  for (const auto& layer : layers_of(runs)) {
    const Result<Image> burnt =
        thin(image_of(layer, grid), {own.family, problem.options.progress, problem.options.cancel});
    if (!burnt) return burnt.error();
    statistics.seconds_walk += watch.lap();
    link_pixels(grid, pixels_of(*burnt, layer, grid, radius), nullptr, axis);
    statistics.seconds_collect += watch.lap();
  }
  statistics.queries = axis.nodes.size();
  statistics.seconds = all.lap();
  return axis;
}

}  // namespace medial::brushfire
