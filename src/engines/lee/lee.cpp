#include "engines/lee/lee.h"

#include <optional>

#include "base/stopwatch.h"
#include "base/tolerance.h"
#include "engines/lee/graph.h"
#include "engines/lee/ties.h"

namespace medial::lee {
namespace {

/// A shape's diagram, and what its results are completed from.
struct Solution {
  Frame frame;
  double tolerance = 0;  ///< in units of the input
  sites::SiteNumbers numbers;
  Elements elements;
  Graph graph;
  Statistics statistics;
  bool cancelled = false;
};

/// Lee, Section II: the list of elements, the diagrams of the chains, merges.
Solution solve(const Shape& shape, const Options& options, std::vector<Level>* levels) {
  Solution solution;
  Statistics& statistics = solution.statistics;
  Stopwatch watch;

  const Box box = bounding_box(shape);
  const Frame& frame = solution.frame = frame_of(box);
  solution.tolerance = tolerance_for(box, options.tolerance);
  const Box local{frame.to_local(box.low), frame.to_local(box.high)};

  solution.numbers = sites::number_sites(shape, frame, options.corner_angle);
  solution.elements = elements_of(shape, solution.numbers, frame);
  statistics.seconds_sites = watch.lap();

  std::optional<Diagram> diagram(std::in_place, solution.elements);
  const ConquerContext context{{tolerance_for(local, options.tolerance), radius_limit(box, frame)},
                               options.cancel,
                               options.progress};
  const std::vector<std::uint32_t> last_edges = conquer(*diagram, context, statistics, levels);
  statistics.seconds_walk = watch.lap();

  solution.cancelled = options.cancel != nullptr && options.cancel->load();
  if (!solution.cancelled) {
    solution.graph = graph_of(*diagram, last_edges);
    diagram.reset();
    // Where the shape lies far from the origin, its own coordinates are no better known.
    join_ties(solution.graph, solution.elements, frame.scale * solution.tolerance);
    solution.graph.touched = {};
  }
  statistics.seconds_collect = watch.lap();
  return solution;
}

}  // namespace

MedialAxis run(const Shape& shape, const Options& options, std::vector<Level>* levels) {
  Stopwatch all;
  Stopwatch watch;
  Solution solution = solve(shape, options, levels);
  MedialAxis axis;
  axis.method = name_of(Method::lee);
  axis.tolerance = solution.tolerance;
  if (solution.cancelled) return axis;
  axis.statistics = solution.statistics;
  watch.lap();
  complete(solution.graph, solution.elements, solution.frame,
           solution.frame.scale * solution.tolerance, axis);
  solution.graph = {};  // or there would be three of everything
  solution.elements = {};
  axis.sites = sites::result_sites(shape, solution.numbers);
  axis.statistics.seconds_collect += watch.lap();
  axis.statistics.seconds = all.lap();
  return axis;
}

VoronoiDiagram voronoi_diagram(const Shape& shape, const Options& options) {
  Stopwatch all;
  const Solution solution = solve(shape, options, nullptr);
  VoronoiDiagram diagram;
  diagram.method = name_of(Method::lee);
  diagram.tolerance = solution.tolerance;
  if (solution.cancelled) return diagram;
  diagram.statistics = solution.statistics;
  complete(solution.graph, solution.elements, solution.frame, diagram);
  diagram.sites = sites::result_sites(shape, solution.numbers);
  diagram.statistics.seconds = all.lap();
  return diagram;
}

}  // namespace medial::lee
