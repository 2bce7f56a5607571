#include "methods/disks/disks.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "axis/statistics.h"
#include "base/compat.h"
#include "base/memory.h"
#include "base/stopwatch.h"
#include "base/threads.h"
#include "methods/checks.h"
#include "methods/disks/boundary.h"
#include "methods/disks/collect.h"
#include "methods/disks/connect.h"
#include "methods/disks/merge_ties.h"
#include "methods/disks/pose.h"
#include "methods/disks/walk.h"
#include "methods/refusal.h"
#include "site/boundary_tree.h"

namespace medial::disks {

namespace {

/// Reports the share of the walk that is done, if the caller wants it.
std::function<void(std::uint64_t)> reporter(const Problem& problem, int attempts,
                                            const Boundary& boundary,
                                            std::atomic<std::uint64_t>& finished) {
  const auto tell = problem.progress_of_attempt(attempts);
  if (!tell) return {};
  return [&finished, tell, all = static_cast<double>(boundary.sites.size())](std::uint64_t sites) {
    tell(std::min(1.0, static_cast<double>(finished += sites) / all));
  };
}

/// How an axis is found.
struct Way {
  std::vector<bool> in_precise = {};  ///< of each component: double is never asked; empty: it is
  bool merges_ties = true;
  int attempts = 0;  ///< before this one
};

/// Connects the holes of the boundary, walks it, and joins what the walk finds. Nothing where the
/// caller cancels. `parted`: if `numbers` are those.
std::optional<Graph> graph_of(const Problem& problem, const SiteNumbers& numbers,
                              const exact::PartedNumbers* parted, const Way& way,
                              std::size_t spare_nodes, Boundary& boundary, Stopwatch& watch,
                              Statistics& statistics) {
  const ExactSites sites(problem, numbers, boundary);
  connect_holes(problem.shape, WalkContext::fine_share * problem.fine_tolerance, sites,
                way.in_precise, boundary);
  statistics.queries += statistics.bridges = boundary.bridges.size();
  statistics.seconds_connect = watch.lap();
  if (problem.is_cancelled()) return std::nullopt;

  const site::BoundaryTree tree(boundary.sites, site::BoundaryTree::Chords::all,
                                boundary.longest_run());
  statistics.seconds_tree = watch.lap();

  std::atomic<std::uint64_t> finished = 0;
  WalkContext context(sites, tree);
  context.in_precise = way.in_precise;
  context.cancel = problem.options.cancel;
  context.finished_sites = reporter(problem, way.attempts, boundary, finished);
  context.joins_ties = way.merges_ties;
  if (parted != nullptr && boundary.sides == Sides::one) context.ends_smooth = &parted->ends_smooth;
  auto chunks = walk(context);
  statistics.seconds_walk = watch.lap();
  if (problem.is_cancelled()) return std::nullopt;

  Graph graph = collect(chunks, boundary.bridges, spare_nodes, boundary.has_arcs);
  if (way.merges_ties) merge_ties(tree, sites, problem.local_tolerance(), graph);
  if (boundary.has_arcs) {
    remove_spurs(boundary, problem.local_tolerance(), graph);
    find_doubts(boundary, tree, problem.local_tolerance(), graph);
  }
  return graph;
}

/// The sites of a boundary get the names that the axis has for them.
void rename(const std::vector<std::uint32_t>& names, Boundary& boundary) {
  WorkVector<std::uint32_t> renamed;
  for (std::size_t i = 0; i < boundary.originals.size(); ++i) {
    const std::uint32_t own = boundary.originals[i];
    renamed.push_back(boundary.elements[i] == Element::bridge ? own : names[own]);
  }
  boundary.originals.assign(std::move(renamed));
}

/// Moves edges, and leaves room for so many more. Edges of another type are freed as they are
/// copied.
template <class E>
void take_edges(std::vector<Edge>& from, std::size_t spare, std::vector<E>& to) {
  if constexpr (std::is_same_v<E, Edge>) {
    to = std::move(from);
  } else {
    constexpr std::size_t block = 1 << 14;
    reserve_large(to, from.size() + spare);
    for (std::size_t i = 0; i < from.size(); ++i) {
      to.push_back({from[i]});
      if ((i + 1) % block == 0) give_back_pages(&from[i + 1 - block], block * sizeof(Edge));
    }
    free_memory(from);
  }
}

/// The engine up to the graph: sites, holes connected, tree, walk. Nothing where the caller
/// cancels.
std::optional<Graph> attempt(const Problem& problem, const SiteNumbers& own_numbers, Sides sides,
                             const Way& way, std::size_t spare_nodes, Boundary& boundary,
                             Stopwatch& watch, Statistics& statistics) {
  const SiteNumbers* numbers = &own_numbers;
  std::optional<exact::PartedNumbers> parted;
  if (!way.in_precise.empty() && has_arcs(problem.shape)) {
    parted = exact::parted_numbers(problem, own_numbers, way.in_precise);
    numbers = &parted->numbers;
  }
  boundary = loops_boundary(problem, *numbers, sides);
  statistics.seconds_sites = watch.lap();

  auto graph = graph_of(problem, *numbers, parted ? &*parted : nullptr, way, spare_nodes, boundary,
                        watch, statistics);
  if (!graph) return graph;
  if (parted) rename(parted->names, boundary);
  for (std::uint32_t& site : graph->lost) site = boundary.originals[site];
  return graph;
}

MedialAxis empty_axis(const Problem& problem) {
  MedialAxis axis;
  axis.method = "disks";
  axis.tolerance = problem.tolerance;
  return axis;
}

/// The time since the walk has gone to collect.
void end_times(Stopwatch& watch, Statistics& statistics) {
  statistics.seconds_collect = watch.lap();
  statistics.seconds = statistics.seconds_sites + statistics.seconds_connect +
                       statistics.seconds_tree + statistics.seconds_walk +
                       statistics.seconds_collect;
}

/// Moves what a graph has found to an axis, but for its edges.
void take_nodes(Graph& graph, MedialAxis& axis, std::vector<std::uint32_t>& lost) {
  lost = std::move(graph.lost);
  axis.nodes = std::move(graph.nodes);
  axis.statistics += graph.statistics;
}

/// The axis of a shape by one walk.
Result<MedialAxis> axis_by(const Problem& problem, const SiteNumbers& numbers, const Way& way,
                           std::vector<std::uint32_t>& lost) {
  MedialAxis axis = empty_axis(problem);
  Stopwatch watch;
  Boundary boundary;
  auto graph = attempt(problem, numbers, Sides::one, way, 0, boundary, watch, axis.statistics);
  if (!graph) return axis;
  // No near tie is that far off, against the size. Next to arcs several may add up to more than a
  // tolerance: such an axis is measured.
  constexpr double loose = 0x1p-20;
  const bool with_arcs = has_arcs(problem.shape);
  const double slack =
      with_arcs ? 2 * axis.tolerance : std::max(loose * diagonal(problem.box), 4 * axis.tolerance);
  const auto loose_edges = complete(boundary, problem.frame, problem.frame.scale * slack, *graph);
  boundary = {};
  take_nodes(*graph, axis, lost);
  axis.edges = std::move(graph->edges);
  bool is_right = false;
  in_parallel([&] { is_right = has_right_topology(problem.shape, axis.nodes, axis.edges); },
              [&] { axis.sites = site::result_sites(problem.shape, numbers); });
  if (!is_right)
    return error_of_wrong_axis(
        axis, "the axis does not have one cycle for each hole: please report this shape");
  end_times(watch, axis.statistics);
  for (const std::uint32_t edge : loose_edges) {
    if (touches_its_sites(axis, axis.edges[edge], slack)) continue;
    if (!with_arcs)
      return error_of_wrong_axis(
          axis, "a disk of the axis misses a site that it should touch: please report this shape");
    lost.push_back(axis.edges[edge].site[0]);
  }
  return axis;
}

/// The same of what lies around a planar graph; the edges are returned apart. A diagram has nodes
/// for the planar graph's points, and edges that lead there, as well.
template <class E>
MedialAxis axis_around_by(const Problem& problem, const SiteNumbers& numbers, const Way& way,
                          std::vector<E>& edges, std::vector<std::uint32_t>& lost) {
  MedialAxis axis = empty_axis(problem);
  Stopwatch watch;
  Boundary boundary;
  auto graph = attempt(problem, numbers, Sides::both, way, problem.shape.points.size(), boundary,
                       watch, axis.statistics);
  if (!graph) return axis;
  complete(boundary, problem.frame, std::nullopt, *graph);
  boundary = {};
  take_nodes(*graph, axis, lost);
  take_edges(graph->edges, numbers.count, edges);
  end_times(watch, axis.statistics);
  return axis;
}

/// Whether walking a shape in 256 bits takes seconds.
bool takes_long(const Shape& shape) {
  constexpr std::size_t of_arcs = 1 << 10, of_segments = 1 << 14;
  return shape.points.size() > (has_arcs(shape) ? of_arcs : of_segments);
}

/// Marks the components of these sites; all if there are none.
std::vector<bool> components_of(const Shape& shape, const SiteNumbers& numbers,
                                const std::vector<std::uint32_t>& sites) {
  const std::vector<std::uint32_t>& edge = numbers.edge;
  std::vector<bool> marked(shape.component_count(), sites.empty());
  for (const std::uint32_t site : sites) {
    const auto point = static_cast<std::size_t>(ranges::lower_bound(edge, site) - edge.begin());
    const auto loop = std::upper_bound(shape.loop_begin.begin(), shape.loop_begin.end(), point) - 1;
    marked[shape.component[static_cast<std::size_t>(loop - shape.loop_begin.begin())]] = true;
  }
  return marked;
}

/// Turns to the next way after one whose axis is refused. False after the last.
bool turn_to_next(const Problem& problem, const SiteNumbers& numbers,
                  const std::vector<std::size_t>& doubtful, std::vector<std::uint32_t> lost,
                  Way& way) {
  ++way.attempts;
  // What seemed to be one tie may be none that one disk touches: the last way keeps it apart.
  if (!way.in_precise.empty()) return std::exchange(way.merges_ties, false);
  if (!lost.empty())  // else all components are walked again
    for (const std::size_t point : doubtful) lost.push_back(numbers.edge[point]);
  way.in_precise = components_of(problem.shape, numbers, lost);
  return true;
}

/// The axis of a shape, walked as it is. Components in which the walk lost its way, or all of a
/// shape whose axis is refused, are walked again in 256 bits; if that is refused, too, once more
/// with ties kept apart.
Result<MedialAxis> run_in_place(const Problem& problem, const SiteNumbers& numbers, int attempts) {
  const bool with_arcs = has_arcs(problem.shape);
  std::vector<std::size_t> doubtful = tiny_edges(problem);
  const bool has_tiny_edges = !doubtful.empty();
  for (const std::size_t point : almost_smooth_joints(problem, numbers)) doubtful.push_back(point);
  // Next to arcs, a walk that merges nothing, or far more than rounding, is measured, too.
  constexpr double coarse = 8;
  const bool is_coarse = problem.tolerance > coarse * problem.joint_tolerance;
  const bool is_measured = with_arcs && (problem.options.exact || has_tiny_edges || is_coarse);
  std::optional<Error> error;
  Way way{{}, !problem.options.exact, attempts};
  std::vector<std::uint32_t> lost;
  do {
    lost.clear();
    auto axis = axis_by(problem, numbers, way, lost);
    const bool is_precise = !way.in_precise.empty();
    const bool is_certain = lost.empty() && !(with_arcs && is_precise) && !is_measured && axis;
    if (axis && (is_certain || problem.is_cancelled())) return axis;
    // A polygon in which the walk lost its way is measured only if another walk takes seconds.
    if (with_arcs || is_precise || takes_long(problem.shape)) {
      auto refused = axis ? error_if_refused(problem, *axis) : axis.error();
      if (!refused) return axis;
      if (!error || axis) error = std::move(refused);
    }
  } while (turn_to_next(problem, numbers, doubtful, lost, way));
  return crossing_or(problem, std::move(*error));
}

/// The axis around a planar graph, walked as it is, and once more in 256 bits where the walk lost
/// its way.
template <class E>
AxisAround run_around_in_place(const Problem& problem, const SiteNumbers& numbers,
                               std::vector<E>& edges) {
  Way way;
  for (bool is_last = false;; is_last = true) {
    edges.clear();
    std::vector<std::uint32_t> lost;
    MedialAxis axis = axis_around_by(problem, numbers, way, edges, lost);
    if (lost.empty() || is_last || takes_long(problem.shape))
      return {std::move(axis), lost.empty()};
    way.in_precise = components_of(problem.shape, numbers, lost);
    ++way.attempts;
  }
}

/// The image in which a shape with arcs is walked.
struct Posed {
  Pose pose;
  Problem problem;  ///< a box of arcs rounds: it is the image's
  SiteNumbers numbers;

  explicit Posed(const Problem& own)
      : pose(own.shape), problem(pose.shape(), own.options), numbers(pose.to_image(own.numbers())) {
    problem.joint_tolerance = own.joint_tolerance;
  }
};

}  // namespace

Result<MedialAxis> run(const Problem& problem, int attempts) {
  if (!has_arcs(problem.shape)) return run_in_place(problem, problem.numbers(), attempts);
  const Posed posed(problem);
  auto axis = run_in_place(posed.problem, posed.numbers, attempts);
  if (!axis) return posed.pose.to_input(axis.error());
  posed.pose.to_input(problem, posed.numbers, *axis, axis->edges);
  return axis;
}

template <class E>
AxisAround run_around(const Problem& problem, std::vector<E>& edges) {
  if (!has_arcs(problem.shape)) return run_around_in_place(problem, problem.numbers(), edges);
  const Posed posed(problem);
  AxisAround result = run_around_in_place(posed.problem, posed.numbers, edges);
  posed.pose.to_input(problem, posed.numbers, result.axis, edges);
  return result;
}

template AxisAround run_around(const Problem&, std::vector<Edge>&);
template AxisAround run_around(const Problem&, std::vector<VoronoiEdge>&);

}  // namespace medial::disks
