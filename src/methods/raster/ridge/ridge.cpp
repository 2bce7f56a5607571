#include "methods/raster/ridge/ridge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numeric>

#include "axis/node_kinds.h"
#include "axis/pixel_graph.h"
#include "base/arc.h"
#include "base/stopwatch.h"
#include "methods/raster/ridge/digitize.h"
#include "methods/raster/ridge/follow.h"
#include "methods/raster/ridge/gaps.h"
#include "methods/raster/ridge/nearest.h"
#include "methods/raster/ridge/necks.h"
#include "methods/raster/ridge/outline.h"
#include "methods/raster/ridge/passages.h"
#include "methods/raster/ridge/thin.h"

namespace medial::ridge {
namespace {

using raster::Pixel;

/// Seconds of the thread's processor time since the last call.
class ProcessorWatch {
 public:
  double lap() {
    const double now = seconds(), passed = now - last_;
    last_ = now;
    return passed;
  }

 private:
  static double seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }
  double last_ = seconds();
};

/// For each set a pixel inside it: the report's own inner point where it lies in the set, otherwise
/// the middle of the set's first run.
std::vector<Pixel> seeds_of(const EdgeOutline& outline, const LocalGrid& local,
                            const InteriorSets& sets) {
  std::vector<Pixel> seeds(sets.count);
  for (std::size_t i = sets.runs.size(); i-- > 0;) {
    const PixelRun& run = sets.runs[i];
    seeds[run.set] = {run.first + (run.last - run.first) / 2, run.row};
  }
  for (const Vec2 point : inner_points(outline)) {
    const Vec2 p = local.in_pixels(point);
    const Pixel pixel{static_cast<std::uint32_t>(std::floor(p.x + 0.5)),
                      static_cast<std::uint32_t>(std::floor(p.y + 0.5))};
    if (!sets.inside.contains(pixel.column, pixel.row) || !sets.inside.at(pixel)) continue;
    const auto run = std::upper_bound(sets.runs.begin(), sets.runs.end(), pixel,
                                      [](Pixel a, const PixelRun& b) {
                                        return a < Pixel{b.first, b.row};
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
  for (const PixelRun& run : sets.runs)
    for (std::uint32_t c = run.first; c <= run.last && empty[run.set]; ++c)
      if (follower.check({c, run.row})) {
        empty[run.set] = false;
        --count;
      }
  return count;
}

/// The two sites on the sides of an edge of the axis, if they are two.
std::array<std::uint32_t, 2> sites_of(const EdgeOutline& outline, std::uint32_t first,
                                      std::uint32_t second) {
  if (second == no_edge || outline.site[first] == outline.site[second]) return {no_site, no_site};
  return {outline.site[first], outline.site[second]};
}

/// The pixels that are left, in the order of increasing x within increasing y.
std::vector<MedialPixel> result_pixels(const EdgeOutline& outline, const LocalFrame& frame,
                                       const MedialMap& map) {
  const std::vector<std::uint32_t> order = map.in_rows();
  std::vector<MedialPixel> pixels;
  pixels.reserve(order.size());
  for (const std::uint32_t place : order) {
    const Found& found = map.found[place];
    pixels.push_back({found.pixel, frame.inverse * found.radius, outline.component[found.first],
                      sites_of(outline, found.first, found.second)});
  }
  return pixels;
}

/// Adds the axis in necks to that of pixels, and sorts all nodes by increasing x within increasing
/// y.
void add_passages(const Passages& passages, const EdgeOutline& outline, const LocalFrame& frame,
                  const std::vector<MedialPixel>& pixels, MedialAxis& axis) {
  if (passages.points.empty() && passages.links.empty()) return;
  const auto first_point = static_cast<std::uint32_t>(axis.nodes.size());
  for (const Passages::Point& point : passages.points)
    axis.nodes.push_back({{frame.to_input(point.center), frame.inverse * point.radius},
                          outline.component[point.first],
                          NodeKind::leaf});
  const auto node_of = [&](const Passages::End& end) {
    if (end.point != Passages::End::none) return first_point + end.point;
    const auto pixel = std::lower_bound(pixels.begin(), pixels.end(), end.pixel,
                                        [](const MedialPixel& a, Pixel b) { return a.pixel < b; });
    return static_cast<std::uint32_t>(pixel - pixels.begin());
  };
  for (const auto& link : passages.links) {
    const Passages::End& from = link[0].point != Passages::End::none ? link[0] : link[1];
    const Passages::End& to = &from == &link[0] ? link[1] : link[0];
    const bool is_point = from.point != Passages::End::none;
    const auto sites = is_point ? sites_of(outline, passages.points[from.point].first,
                                           passages.points[from.point].second)
                                : std::array{no_site, no_site};
    add_link(axis, node_of(from), node_of(to), sites);
  }
  std::vector<std::uint32_t> order(axis.nodes.size()), place(axis.nodes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const Vec2 a = axis.nodes[i].disk.center, b = axis.nodes[j].disk.center;
    if (a.y != b.y) return a.y < b.y;
    return a.x != b.x ? a.x < b.x : i < j;
  });
  std::vector<Node> nodes;
  nodes.reserve(order.size());
  for (const std::uint32_t i : order) {
    place[i] = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back(axis.nodes[i]);
  }
  axis.nodes = std::move(nodes);
  for (Edge& edge : axis.edges)
    for (std::uint32_t& node : edge.node) node = place[node];
  set_node_kinds(axis);
}

/// How many rows and columns of pixels the boundary crosses, about.
double crossings_of(const Shape& shape, double step) {
  double sum = 0;
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
    const std::uint32_t begin = shape.loop_begin[loop], end = shape.loop_begin[loop + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const Vec2 chord = shape.points[i + 1 < end ? i + 1 : begin] - shape.points[i];
      const double straight = std::abs(chord.x) + std::abs(chord.y);
      sum += std::max(straight, arc_length(norm(chord), shape.bulge(i)));
    }
  }
  return sum / step;
}

Report with_sizes(Report report, const raster::Grid& grid, const InteriorSets& sets,
                  const Necks& necks, const NearestEdges& search) {
  report.columns = grid.columns;
  report.rows = grid.rows;
  report.sets = sets.count;
  report.gates = necks.gates.size();
  report.hidden = necks.hidden;
  report.torn = necks.torn;
  report.queries = search.queries;
  report.distances = search.distances;
  return report;
}

}  // namespace

std::optional<Error> refuse(const Problem& problem) {
  const auto& own = problem.own<method::Ridge>();
  if (!(own.collinear >= 0 && own.collinear <= 45))
    return Error{ErrorCode::invalid_option, "the collinear angle must be in [0, 45] degrees", {}};
  const auto grid = grid_for(problem.box, own.grid);
  if (!grid) return grid.error();
  if (!(crossings_of(problem.shape, grid->step) <= most_crossings))
    return Error{
        ErrorCode::too_large, "the boundary crosses more than 2^23 rows and columns of pixels", {}};
  return std::nullopt;
}

MedialAxis run(const Problem& problem, Report* report) {
  const auto& own = problem.own<method::Ridge>();
  MedialAxis axis;
  axis.method = "ridge";
  Statistics& statistics = axis.statistics;
  Stopwatch all, watch;
  ProcessorWatch processor;
  Report measured;

  const LocalFrame& frame = problem.frame;
  axis.tolerance = problem.tolerance;
  const raster::Grid grid = grid_for(problem.box, own.grid).value();
  const LocalGrid local(grid, frame);
  const EdgeOutline outline = outline_of(problem, local.grid.step);
  raster::BitMap boundary = boundary_map(outline, local);
  statistics.seconds_sites = watch.lap();
  const auto search = make_search(outline, own.sorted_list);
  statistics.seconds_tree = watch.lap();
  measured.seconds_start = processor.lap();

  InteriorSets sets = interior_sets(outline, local, boundary);
  measured.seconds_first = processor.lap();
  const Necks necks = find_necks(outline, local, boundary, sets);
  measured.seconds_necks = processor.lap();
  Follower follower(outline, local, boundary, *search, own.rule, problem.options.cancel);
  const std::uint64_t empty = find_first_pixels(seeds_of(outline, local, sets), sets, follower);
  statistics.seconds_connect = watch.lap();
  measured.seconds_first += processor.lap();
  if (problem.is_cancelled()) return axis;

  follower.follow();
  const Passages passages = pass_necks(necks, outline, local, sets, *search, follower);
  fill_gaps(sets, boundary, follower);
  statistics.seconds_walk = watch.lap();
  measured.seconds_follow = processor.lap();
  if (problem.is_cancelled()) return axis;

  MedialMap& map = follower.map();
  measured.found = map.found.size();
  if (own.rule == RidgeRule::difference)
    thin_by_report(boundary, map);
  else
    thin_to_lines(boundary, local.grid.step, map);
  open_gaps(sets, boundary, map);
  const double seconds_thin = watch.lap();
  measured.seconds_thin = processor.lap();

  axis.sites = problem.result_sites();
  const std::vector<MedialPixel> pixels = result_pixels(outline, frame, map);
  link_pixels(grid, pixels, &boundary, axis);
  add_passages(passages, outline, frame, pixels, axis);
  statistics.seconds_collect = seconds_thin + watch.lap();
  statistics.queries = search->queries;
  statistics.seconds = all.lap();
  measured.empty_sets = empty;
  measured.kept = pixels.size();
  if (report != nullptr) *report = with_sizes(measured, grid, sets, necks, *search);
  return axis;
}

}  // namespace medial::ridge
