#include "methods/disks/disks.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "base/local_frame.h"
#include "base/memory.h"
#include "base/stopwatch.h"
#include "base/tolerance.h"
#include "methods/checks.h"
#include "methods/disks/boundary.h"
#include "methods/disks/collect.h"
#include "methods/disks/connect.h"
#include "methods/disks/merge_ties.h"
#include "methods/disks/near_circle.h"
#include "methods/disks/refusal.h"
#include "methods/disks/walk.h"
#include "site/boundary_tree.h"

namespace medial::disks {

namespace {

/// The walk tells contacts apart to a share of the tolerance, which is still some roundings: what
/// narrow gaps leave between two contacts may be some tolerances only, and so is all of the axis
/// where arcs are within so many tolerances of one circle. What that leaves of a tie is merged at
/// the end. Among other arcs ties are known to the tolerance only, as their bulges round, too.
constexpr double fine_share = 0.25, in_centers_share = 0.125, near_circle = 1 << 12;

/// The axis of such arcs is certified before it is given out. Of more of them that takes too long,
/// as searches among them take O(n).
constexpr std::size_t most_arcs_in_near_circle = 1 << 14;

/// Tells the caller how much of the walk is done, if he wants to know.
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

/// What a walk makes of a shape.
struct Outcome {
  MedialAxis axis;
  bool in_centers = false;  ///< rounding may have decided what it is: see is_in_centers()
  SiteNumbers numbers;      ///< of its sites, where it has none
};

/// The engine: sites, holes connected, tree, walk, graph. Cancelled, it stops where it is. Contacts
/// are told apart to a share of the tolerance, which if it is not given goes by the shape. The
/// edges stand apart from the axis.
template <class E>
Result<Outcome> run(const Shape& shape, const Options& options, bool two_sided,
                    std::optional<double> share, std::vector<E>& edges) {
  Outcome outcome;
  MedialAxis& axis = outcome.axis;
  axis.method = "disks";
  Statistics& statistics = axis.statistics;
  Stopwatch all, watch;

  const Box box = bounding_box(shape);
  const LocalFrame frame = frame_of(box);
  axis.tolerance = tolerance_for(box, options.tolerance);
  // Where the shape lies far from the origin, only going back there rounds: the walk knows its
  // coordinates better than the input's own spacing, to which ties are decided.
  const Box local{frame.to_local(box.low), frame.to_local(box.high)};
  double walk_tolerance = tolerance_for(local, options.tolerance);
  const double input_tolerance = frame.scale * axis.tolerance;

  SiteNumbers numbers = sites::number_sites(shape, frame, options.corner_angle);
  Boundary boundary = loops_boundary(shape, numbers, frame, two_sided);
  const double near = near_circle * walk_tolerance;
  outcome.in_centers = !two_sided && is_near_circle(boundary, local, near);
  if (outcome.in_centers && boundary.sites.size() > most_arcs_in_near_circle)
    return error_of_too_many_arcs(box);
  if (outcome.in_centers && !share) return outcome;
  walk_tolerance *= share ? *share : boundary.has_arcs ? 1 : fine_share;
  statistics.seconds_sites = watch.lap();

  const std::vector<Cut> cuts =
      connecting_disks(shape, boundary, walk_tolerance, statistics.queries);
  if (!cuts.empty()) boundary = connect(shape, boundary, cuts);
  statistics.cuts = cuts.size();
  statistics.seconds_connect = watch.lap();
  if (is_cancelled(options)) return outcome;

  auto tree = std::make_unique<site::BoundaryTree>(boundary.sites);
  statistics.seconds_tree = watch.lap();

  std::atomic<std::uint64_t> finished = 0;
  auto chunks = walk({boundary, cuts, *tree, walk_tolerance, radius_limit(box, frame),
                      options.cancel, reporter(options, boundary, finished)});
  statistics.seconds_walk = watch.lap();
  if (is_cancelled(options)) return outcome;

  // A diagram has nodes for a planar graph's points, and edges that lead there, as well.
  Graph graph = collect(chunks, cuts.size(), two_sided ? shape.points.size() : 0);
  merge_ties(boundary, *tree, input_tolerance, graph);
  tree.reset();
  if (!two_sided && !outcome.in_centers) outcome.in_centers = is_in_centers(boundary, graph, near);
  constexpr double loose = 0x1p-20;  // of the size: no near tie is that far off
  const double slack = std::max(loose * diagonal(box), 4 * axis.tolerance);
  reserve_large(edges, graph.links.size() + (two_sided ? numbers.count : 0));
  const auto loose_edges = complete(boundary, frame, frame.scale * slack, graph, edges);
  boundary = {};
  axis.nodes = std::move(graph.nodes);
  statistics += graph.statistics;
  if (two_sided)
    outcome.numbers = std::move(numbers);
  else
    axis.sites = sites::result_sites(shape, numbers);
  statistics.seconds_collect = watch.lap();
  statistics.seconds = all.lap();
  for (const std::uint32_t edge : loose_edges)
    if (!touches_its_sites(axis, edges[edge], slack))
      return error_of_wrong_axis(
          axis, "a disk of the axis misses a site that it should touch: please report this shape");
  return outcome;
}

}  // namespace

Result<MedialAxis> run(const Shape& shape, const Options& options, bool* in_centers) {
  std::optional<Error> error;
  // To another share of the tolerance, what misled the walk may be one contact, or two.
  std::vector<std::optional<double>> shares{std::nullopt, 1.0};
  if (!shape.bulges.empty()) shares = {std::nullopt, in_centers_share, 0.25, 0.0625, 0.5, 1.0};
  for (const auto& share : shares) {
    std::vector<Edge> edges;
    Result<Outcome> outcome = run(shape, options, false, share, edges);
    if (!outcome) {
      if (!error) error = std::move(outcome).error();
      continue;
    }
    outcome->axis.edges = std::move(edges);
    if (in_centers != nullptr) *in_centers = outcome->in_centers;
    if (!outcome->in_centers || is_cancelled(options)) return std::move(outcome->axis);
    if (!share) continue;  // a finer one is due
    error = error_if_refused(shape, options, outcome->axis);
    if (!error) return std::move(outcome->axis);
  }
  return std::move(*error);
}

template <class E>
MedialAxis run_two_sided(const Shape& shape, const Options& options, std::vector<E>& edges,
                         SiteNumbers& numbers) {
  Outcome outcome = run(shape, options, true, std::nullopt, edges).value();
  numbers = std::move(outcome.numbers);
  return std::move(outcome.axis);
}

template MedialAxis run_two_sided(const Shape&, const Options&, std::vector<Edge>&, SiteNumbers&);
template MedialAxis run_two_sided(const Shape&, const Options&, std::vector<VoronoiEdge>&,
                                  SiteNumbers&);

}  // namespace medial::disks
