#include "methods/disks/disks.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "axis/statistics.h"
#include "base/memory.h"
#include "base/stopwatch.h"
#include "methods/checks.h"
#include "methods/disks/boundary.h"
#include "methods/disks/collect.h"
#include "methods/disks/connect.h"
#include "methods/disks/exact_event.h"
#include "methods/disks/merge_ties.h"
#include "methods/disks/near_circle.h"
#include "methods/disks/walk.h"
#include "methods/refusal.h"
#include "site/boundary_tree.h"

namespace medial::disks {

namespace {

/// The walk separates contacts to a share of the tolerance, which is still some roundings: narrow
/// gaps may leave only some tolerances between two contacts, and so does the whole axis where arcs
/// are within so many tolerances of one circle. What remains of a tie is merged at the end. Among
/// other arcs ties are known to the tolerance only, since their bulges round, too.
constexpr double fine_share = 0.25, in_centers_share = 0.125, near_circle = 1 << 12;

/// The axis of such arcs is certified before it is returned. With more of them that takes too long,
/// as searches among them take O(n).
constexpr std::size_t most_arcs_in_near_circle = 1 << 14;

/// Reports the share of the walk that is done, if the caller wants it.
std::function<void(std::uint64_t)> reporter(const Options& options, const Boundary& boundary,
                                            std::atomic<std::uint64_t>& finished) {
  if (!options.progress) return {};
  return [&, all = static_cast<double>(boundary.sites.size())](std::uint64_t sites) {
    options.progress(std::min(1.0, static_cast<double>(finished += sites) / all));
  };
}

Error error_of_too_many_arcs(const Box& box) {
  Error error{ErrorCode::unsupported, "too many arcs are of one circle but for rounding", {}};
  error.place.point = midpoint(box.low, box.high);
  return error;
}

/// Connects the holes of the boundary, walks it, and joins what the walk finds. Nothing where the
/// caller cancels.
std::optional<Graph> graph_of(const Problem& problem, double walk_tolerance, Decides decides,
                              Boundary& boundary, Statistics& statistics) {
  Stopwatch watch;
#ifdef MEDIAL_HAS_EXACT
  const bool takes_exact =
      decides != Decides::in_double && !boundary.has_arcs && !boundary.two_sided;
#else
  constexpr bool takes_exact = false;
#endif
  const bool always_exact = decides == Decides::in_precise;
  const ExactSites sites(problem);
  const std::vector<Bridge> bridges =
      connecting_disks(problem.shape, boundary, walk_tolerance, takes_exact ? &sites : nullptr,
                       always_exact ? problem.radius_limit : exact_bridges, statistics.queries);
  if (!bridges.empty()) boundary = connect(problem.shape, boundary, bridges);
  statistics.bridges = bridges.size();
  statistics.seconds_connect = watch.lap();
  if (problem.is_cancelled()) return std::nullopt;

  const site::BoundaryTree tree(boundary.sites);
  statistics.seconds_tree = watch.lap();

  std::atomic<std::uint64_t> finished = 0;
  const ExactEvents exact(sites, boundary, tree, always_exact);
  auto chunks = walk({boundary, bridges, tree, walk_tolerance, problem.radius_limit,
                      takes_exact ? &exact : nullptr, problem.options.cancel,
                      reporter(problem.options, boundary, finished)});
  statistics.seconds_walk = watch.lap();
  if (problem.is_cancelled()) return std::nullopt;

  // A diagram has nodes for a planar graph's points, and edges that lead there, as well.
  const std::size_t spare_nodes = boundary.two_sided ? problem.shape.points.size() : 0;
  Graph graph = collect(chunks, bridges.size(), spare_nodes);
  merge_ties(boundary, tree, problem.local_tolerance(), graph);
  statistics.seconds_collect = watch.lap();
  return graph;
}

/// The engine: sites, holes connected, tree, walk, graph. Contacts are separated to a share of the
/// tolerance, which by default depends on the shape. The edges are returned apart from the axis.
template <class E>
Result<Outcome> attempt(const Problem& problem, bool two_sided, std::optional<double> share,
                        Decides decides, std::vector<E>& edges) {
  Outcome outcome;
  MedialAxis& axis = outcome.axis;
  axis.method = "disks";
  axis.tolerance = problem.tolerance;
  Stopwatch all, watch;

  Boundary boundary = loops_boundary(problem, two_sided);
  const double near = near_circle * problem.fine_tolerance;
  outcome.in_centers = !two_sided && is_near_circle(boundary, problem.local_box(), near);
  if (outcome.in_centers && boundary.sites.size() > most_arcs_in_near_circle)
    return error_of_too_many_arcs(problem.box);
  if (outcome.in_centers && !share) return outcome;
  const double usual_share = boundary.has_arcs ? 1 : fine_share;
  axis.statistics.seconds_sites = watch.lap();

  auto graph = graph_of(problem, share.value_or(usual_share) * problem.fine_tolerance, decides,
                        boundary, axis.statistics);
  if (!graph) return outcome;
  if (graph->statistics.exact_changes > 0)
    return Error{ErrorCode::internal, "the walk lost its way: please report this shape", {}};
  watch.lap();
  if (!two_sided && !outcome.in_centers) outcome.in_centers = is_in_centers(boundary, *graph, near);
  constexpr double loose = 0x1p-20;  // of the size: no near tie is that far off
  const double slack = std::max(loose * diagonal(problem.box), 4 * axis.tolerance);
  reserve_large(edges, graph->links.size() + (two_sided ? problem.numbers().count : 0));
  const auto loose_edges =
      complete(boundary, problem.frame, problem.frame.scale * slack, *graph, edges);
  boundary = {};
  axis.nodes = std::move(graph->nodes);
  axis.statistics += graph->statistics;
  if (!two_sided) axis.sites = problem.result_sites();
  axis.statistics.seconds_collect += watch.lap();
  axis.statistics.seconds = all.lap();
  if (!two_sided && !has_right_topology(problem.shape, axis.nodes, edges))
    return error_of_wrong_axis(
        axis, "the axis does not have one cycle for each hole: please report this shape");
  for (const std::uint32_t edge : loose_edges)
    if (!touches_its_sites(axis, edges[edge], slack))
      return error_of_wrong_axis(
          axis, "a disk of the axis misses a site that it should touch: please report this shape");
  return outcome;
}

}  // namespace

Result<Outcome> run(const Problem& problem) {
  std::optional<Error> error;
  // To another share of the tolerance, what misled the walk may be one contact, or two.
  struct Attempt {
    std::optional<double> share;
    Decides decides = Decides::in_double;
  };
  std::vector<Attempt> attempts{{{}, Decides::in_stages}, {{}, Decides::in_precise}, {}};
  if (!problem.shape.bulges.empty())
    attempts = {{}, {in_centers_share}, {0.25}, {0.0625}, {0.5}, {1.0}};
  for (const auto& [share, decides] : attempts) {
    std::vector<Edge> edges;
    Result<Outcome> outcome = attempt(problem, false, share, decides, edges);
    if (!outcome) {
      if (!error) error = std::move(outcome).error();
      continue;
    }
    outcome->axis.edges = std::move(edges);
    const bool is_doubtful = outcome->in_centers || (error && decides == Decides::in_double);
    if (!is_doubtful || problem.is_cancelled()) return outcome;
    if (outcome->in_centers && !share) continue;  // a finer one is due
    auto refused = error_if_refused(problem, outcome->axis);
    if (!refused) return outcome;
    if (!error) error = std::move(refused);
  }
  return std::move(*error);
}

template <class E>
MedialAxis run_two_sided(const Problem& problem, std::vector<E>& edges) {
  return std::move(attempt(problem, true, std::nullopt, Decides::in_double, edges)->axis);
}

template MedialAxis run_two_sided(const Problem&, std::vector<Edge>&);
template MedialAxis run_two_sided(const Problem&, std::vector<VoronoiEdge>&);

}  // namespace medial::disks
