#include "engines/ridge/ridge.h"

#include <algorithm>
#include <cmath>

#include "axis/pixel_graph.h"
#include "base/frame.h"
#include "base/stopwatch.h"
#include "base/tolerance.h"
#include "engines/ridge/digitize.h"
#include "engines/ridge/follow.h"
#include "engines/ridge/gaps.h"
#include "engines/ridge/nearest.h"
#include "engines/ridge/outline.h"
#include "engines/ridge/thin.h"

namespace medial::ridge {
namespace {

using raster::Pixel;

/// For each set a pixel inside it: the report's own inner point where it lies in the set, otherwise
/// the middle of the set's first run.
std::vector<Pixel> seeds_of(const Outline& outline, const LocalGrid& local,
                            const InteriorSets& sets) {
  std::vector<Pixel> seeds(sets.count);
  for (std::size_t i = sets.runs.size(); i-- > 0;) {
    const Run& run = sets.runs[i];
    seeds[run.set] = {run.first + (run.last - run.first) / 2, run.row};
  }
  for (const Vec2 point : inner_points(outline)) {
    const Vec2 p = local.in_pixels(point);
    const Pixel pixel{static_cast<std::uint32_t>(std::floor(p.x + 0.5)),
                      static_cast<std::uint32_t>(std::floor(p.y + 0.5))};
    if (!sets.inside.contains(pixel.column, pixel.row) || !sets.inside.at(pixel)) continue;
    const auto run = std::upper_bound(sets.runs.begin(), sets.runs.end(), pixel,
                                      [](Pixel a, const Run& b) {
                                        return a.row != b.row ? a.row < b.row : a.column < b.first;
                                      }) -
                     1;
    seeds[run->set] = pixel;
  }
  return seeds;
}

/// One medial pixel of every set at least, where a set has any: the report's vertical search, and
/// where that finds none, all pixels of the set. Returns the number of sets without.
std::uint64_t find_first_pixels(const std::vector<Pixel>& seeds, const InteriorSets& sets,
                                Follower& follower) {
  std::vector<bool> empty(seeds.size(), false);
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    if (!follower.find_first(seeds[i])) {
      empty[i] = true;
      ++count;
    }
  if (count == 0) return 0;
  for (const Run& run : sets.runs)
    for (std::uint32_t c = run.first; c <= run.last && empty[run.set]; ++c)
      if (follower.check({c, run.row})) {
        empty[run.set] = false;
        --count;
      }
  return count;
}

/// The pixels that are left, in the order of increasing x within increasing y.
std::vector<MedialPixel> result_pixels(const Outline& outline, const Frame& frame,
                                       const MedialMap& map) {
  const std::vector<std::uint32_t> order = map.in_rows();
  std::vector<MedialPixel> pixels;
  pixels.reserve(order.size());
  for (const std::uint32_t place : order) {
    const Found& found = map.found[place];
    MedialPixel pixel{found.pixel, frame.inverse * found.radius, outline.component[found.first]};
    if (found.second != no_edge && outline.site[found.first] != outline.site[found.second])
      pixel.site = {outline.site[found.first], outline.site[found.second]};
    pixels.push_back(pixel);
  }
  return pixels;
}

}  // namespace

std::optional<Error> refuse(const Shape& shape, const Options& options) {
  if (!(options.ridge_collinear >= 0 && options.ridge_collinear <= 45))
    return Error{ErrorCode::invalid_option, "the collinear angle must be in [0, 45] degrees", {}};
  const auto grid = grid_for(bounding_box(shape), options);
  if (!grid) return grid.error();
  return std::nullopt;
}

MedialAxis run(const Shape& shape, const Options& options, Report* report) {
  MedialAxis axis;
  axis.method = "ridge";
  Statistics& statistics = axis.statistics;
  Stopwatch all, watch;
  const auto cancelled = [&] { return options.cancel != nullptr && options.cancel->load(); };

  const Box box = bounding_box(shape);
  const Frame frame = frame_of(box);
  axis.tolerance = tolerance_for(box, options.tolerance);
  const raster::Grid grid = grid_for(box, options).value();
  const LocalGrid local(grid, frame);
  const Outline outline = outline_of(shape, frame, local.grid.step, options);
  const raster::BitMap boundary = boundary_map(outline, local);
  statistics.seconds_sites = watch.lap();
  const auto search = make_search(outline, options.ridge_search);
  statistics.seconds_tree = watch.lap();

  const InteriorSets sets = interior_sets(outline, local, boundary);
  Follower follower(outline, local, boundary, *search, options.ridge_rule, options.cancel);
  const std::uint64_t empty = find_first_pixels(seeds_of(outline, local, sets), sets, follower);
  statistics.seconds_connect = watch.lap();
  if (cancelled()) return axis;

  follower.follow();
  fill_gaps(sets, boundary, follower);
  statistics.seconds_walk = watch.lap();
  if (cancelled()) return axis;

  MedialMap& map = follower.map();
  const std::size_t found = map.found.size();
  if (options.ridge_rule == RidgeRule::difference)
    thin_by_report(boundary, map);
  else
    thin_to_lines(boundary, map);
  open_gaps(sets, boundary, map);
  const double seconds_thin = watch.lap();

  axis.sites = result_sites(shape, frame, options);
  const std::vector<MedialPixel> pixels = result_pixels(outline, frame, map);
  link_pixels(grid, pixels, &boundary, axis);
  statistics.seconds_collect = seconds_thin + watch.lap();
  statistics.queries = search->queries;
  statistics.seconds = all.lap();
  if (report != nullptr)
    *report = {statistics.seconds_sites + statistics.seconds_tree,
               statistics.seconds_connect,
               statistics.seconds_walk,
               seconds_thin,
               grid.columns,
               grid.rows,
               sets.count,
               empty,
               found,
               pixels.size(),
               search->queries,
               search->distances};
  return axis;
}

}  // namespace medial::ridge
