#include "methods/lee/lee.h"

#include <optional>
#include <span>
#include <utility>

#include "axis/statistics.h"
#include "base/stopwatch.h"
#include "methods/checks.h"
#include "methods/disks/disks.h"
#include "methods/lee/graph.h"
#include "methods/lee/ties.h"

namespace medial::lee {
namespace {

/// Whether a side is so short, compared with the tolerance, that rounding may turn it, or an arc
/// bends by less than rounding.
bool has_short_sides(const Problem& problem) {
  constexpr double shortest = 16;  // tolerances
  const double least = shortest * problem.tolerance;
  for (std::size_t i = 0; i < problem.shape.loop_count(); ++i) {
    const std::span<const Vec2> loop = problem.shape.loop(i);
    for (std::size_t k = 0; loop.size() > 1 && k < loop.size(); ++k)
      if (squared_norm(loop[k] - loop[k > 0 ? k - 1 : loop.size() - 1]) < least * least)
        return true;
  }
  return false;
}

/// The diagram of a shape, from which results are completed.
class Solution {
 public:
  explicit Solution(const Problem& problem) : problem_(problem) {}
  Solution(const Solution&) = delete;  // its members refer to each other
  Solution& operator=(const Solution&) = delete;

  /// Lee, Section II: lists the elements, makes the diagrams of the chains, and merges. Returns
  /// false if rounding may have decided what disks touch, or if the caller cancels.
  bool solve(std::vector<Level>* levels) {
    Stopwatch watch;
    auto elements = elements_of(problem_);
    if (!elements) return false;
    elements_ = std::move(*elements);
    statistics.seconds_sites = watch.lap();
    statistics.bridges = elements_.passages.size() / 2;
    if (!merge_all(levels)) return false;
    const double tolerance = problem_.local_tolerance();
    join_ties(*graph, tolerance);
    const bool is_right = is_right_locally(*graph, tolerance);
    statistics.seconds_walk = watch.lap();
    return is_right;
  }

  /// Frees everything but the statistics.
  void free_graph() {
    graph.reset();
    diagram_.reset();
    elements_ = {};
  }

  Statistics statistics;

 private:
  /// Merges the chains and closes the graph. Returns false if rounding breaks a diagram, or if the
  /// caller cancels.
  bool merge_all(std::vector<Level>* levels) {
    diagram_.emplace(elements_);
    const ConquerContext context{{problem_.fine_tolerance, problem_.radius_limit},
                                 problem_.local_tolerance(),
                                 problem_.options.cancel,
                                 problem_.progress_of_attempt(0)};
    const auto last_edges = conquer(*diagram_, context, statistics, levels);
    if (!last_edges || problem_.is_cancelled()) return false;
    graph.emplace(*diagram_, *last_edges, problem_.local_tolerance());
    return graph->is_whole();
  }

  const Problem& problem_;
  Elements elements_;
  std::optional<Diagram> diagram_;

 public:
  std::optional<Graph> graph;
};

/// The axis, if double precision decides what its disks touch.
std::optional<MedialAxis> axis_in_double(const Problem& problem, std::vector<Level>* levels) {
  Solution solution(problem);
  if (!solution.solve(levels)) return std::nullopt;
  MedialAxis axis;
  axis.method = "lee";
  axis.tolerance = problem.tolerance;
  axis.statistics = solution.statistics;
  Stopwatch watch;
  const double in_middle =
      complete(*solution.graph, problem.frame, problem.local_tolerance(), axis);
  if (!(in_middle <= problem.local_tolerance()) ||
      !has_right_topology(problem.shape, axis.nodes, axis.edges))
    return std::nullopt;
  solution.free_graph();
  axis.sites = problem.result_sites();
  axis.statistics.seconds_collect += watch.lap();
  return axis;
}

}  // namespace

Result<MedialAxis> run(const Problem& problem, std::vector<Level>* levels) {
  Stopwatch all;
  const bool in_double = !has_short_sides(problem) && tiny_edges(problem).empty() &&
                         almost_smooth_joints(problem, problem.numbers()).empty();
  auto decided = in_double ? axis_in_double(problem, levels) : std::nullopt;
  auto axis =
      decided ? Result<MedialAxis>(std::move(*decided)) : disks::run(problem, in_double ? 1 : 0);
  if (axis) axis->statistics.seconds = all.lap();
  return axis;
}

std::optional<VoronoiDiagram> voronoi_diagram(const Problem& problem) {
  Stopwatch all;
  Solution solution(problem);
  if (!solution.solve(nullptr)) return std::nullopt;
  VoronoiDiagram diagram;
  diagram.method = "lee";
  diagram.tolerance = problem.tolerance;
  diagram.statistics = solution.statistics;
  diagram.sites = problem.result_sites();
  complete(*solution.graph, problem.frame, diagram);
  diagram.statistics.seconds = all.lap();
  return diagram;
}

}  // namespace medial::lee
