#include "methods/disks/disks.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <type_traits>

#include "axis/statistics.h"
#include "base/compat.h"
#include "base/memory.h"
#include "base/stopwatch.h"
#include "methods/checks.h"
#include "methods/disks/boundary.h"
#include "methods/disks/collect.h"
#include "methods/disks/connect.h"
#include "methods/disks/exact_event.h"
#include "methods/disks/local_check.h"
#include "methods/disks/merge_ties.h"
#include "methods/disks/near_circle.h"
#include "methods/disks/pose.h"
#include "methods/disks/walk.h"
#include "methods/refusal.h"
#include "site/boundary_tree.h"

namespace medial::disks {

namespace {

/// Where arcs are within so many tolerances of one circle, contacts are separated more finely.
constexpr double near_circle = 1 << 12;

#ifdef MEDIAL_HAS_EXACT
constexpr bool has_exact = true;
#else
constexpr bool has_exact = false;
#endif

/// The walk separates contacts to a share of the tolerance, so fine that it asks for rounding only.
/// What remains of a tie is merged at the end. In shapes with arcs ties are known to the tolerance
/// only, since their bulges round, too, unless these are within some tolerances of one circle; but
/// beside them points of a planar graph may be as near to each other.
double walk_share(const Boundary& boundary, bool in_centers) {
  return boundary.has_arcs && !boundary.two_sided && !in_centers ? 1 : fine_share;
}

/// Reports the share of the walk that is done, if the caller wants it.
std::function<void(std::uint64_t)> reporter(const Options& options, const Boundary& boundary,
                                            std::atomic<std::uint64_t>& finished) {
  if (!options.progress) return {};
  return [&, all = static_cast<double>(boundary.sites.size())](std::uint64_t sites) {
    options.progress(std::min(1.0, static_cast<double>(finished += sites) / all));
  };
}

/// How an attempt decides what ends an edge: in double where that is certain and else in 256 bits,
/// or in double only.
struct Way {
  bool in_double = false;
  bool in_centers = false;       ///< contacts are separated as the centres of several arcs ask for
  std::vector<bool> parted;      ///< points whose joints are taken as they stand; empty: none
  std::vector<bool> in_precise;  ///< components in which double is never asked; empty: none
};

/// What an attempt has found out beside the axis.
struct Findings {
  std::vector<std::uint32_t> lost;  ///< sites where the walk found that a step before was wrong
  bool too_coarse = false;          ///< in the centres of arcs, for how contacts are separated
};

/// Adds the sites, as the boundary has them, where the walk found that a step before was wrong.
void find_lost(const Chunk& chunk, std::vector<std::uint32_t>& lost) {
  lost.insert(lost.end(), chunk.lost.begin(), chunk.lost.end());
  for (const auto& child : chunk.children) find_lost(*child, lost);
}

/// These sites with all pieces that bridges divide them into: an edge that leads across a bridge is
/// named after one of them.
std::vector<std::uint32_t> all_pieces(const Boundary& boundary,
                                      const std::vector<std::uint32_t>& sites) {
  std::vector<bool> named(boundary.originals.size());
  for (const std::uint32_t site : sites) named[boundary.originals[site]] = true;
  std::vector<std::uint32_t> pieces;
  for (std::uint32_t i = 0; i < boundary.sites.size(); ++i)
    if (boundary.elements[i] != Element::bridge && named[boundary.originals[i]])
      pieces.push_back(i);
  return pieces;
}

/// Connects the holes of the boundary, walks it, and joins what the walk finds. Nothing where the
/// caller cancels, where sites of a polygon are lost, and where contacts are separated too
/// coarsely.
std::optional<Graph> graph_of(const Problem& problem, const SiteNumbers& numbers,
                              double walk_tolerance, const Way& way, Boundary& boundary,
                              Statistics& statistics, Findings& findings) {
  Stopwatch watch;
  const bool takes_exact = has_exact && !way.in_double;
  const ExactSites sites(problem, numbers, boundary);
  const std::vector<Bridge> bridges =
      connecting_disks(problem.shape, boundary, walk_tolerance, takes_exact ? &sites : nullptr,
                       way.in_precise, statistics.queries);
  if (!bridges.empty()) boundary = connect(problem.shape, boundary, bridges);
  statistics.bridges = bridges.size();
  statistics.seconds_connect = watch.lap();
  if (problem.is_cancelled()) return std::nullopt;

  const site::BoundaryTree tree(boundary.sites);
  statistics.seconds_tree = watch.lap();

  std::atomic<std::uint64_t> finished = 0;
  std::atomic<bool> in_centers = false;
  const ExactEvents exact(sites, boundary, tree, way.in_precise);
  auto chunks = walk({boundary, bridges, tree, walk_tolerance, problem.fine_tolerance,
                      problem.radius_limit, takes_exact ? &exact : nullptr, problem.options.cancel,
                      way.in_centers ? nullptr : &in_centers, near_circle * problem.fine_tolerance,
                      reporter(problem.options, boundary, finished)});
  statistics.seconds_walk = watch.lap();
  if (problem.is_cancelled()) return std::nullopt;
  findings.too_coarse = in_centers;
  for (const auto& chunk : chunks) find_lost(*chunk, findings.lost);
  if (findings.too_coarse || (!findings.lost.empty() && !boundary.has_arcs)) return std::nullopt;

  // A diagram has nodes for a planar graph's points, and edges that lead there, as well.
  const std::size_t spare_nodes = boundary.two_sided ? problem.shape.points.size() : 0;
  Graph graph = collect(chunks, bridges, spare_nodes, boundary.two_sided && boundary.has_arcs);
  const double tolerance = problem.local_tolerance();
  merge_ties(boundary, tree, takes_exact ? &sites : nullptr, tolerance, graph);
  // Edges may be right beside others that are missing: a planar graph's diagram is not measured.
  if (!findings.lost.empty() && !boundary.two_sided &&
      is_right_around(boundary, tree, graph, all_pieces(boundary, findings.lost), tolerance))
    findings.lost.clear();
  statistics.seconds_collect = watch.lap();
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

/// The engine: sites, holes connected, tree, walk, graph. The edges are returned apart from the
/// axis.
template <class E>
Result<MedialAxis> attempt(const Problem& problem, const SiteNumbers& own_numbers, bool two_sided,
                           const Way& way, std::vector<E>& edges, Findings& findings) {
  MedialAxis axis;
  axis.method = "disks";
  axis.tolerance = problem.tolerance;
  Stopwatch all, watch;

  const SiteNumbers* numbers = &own_numbers;
#ifdef MEDIAL_HAS_EXACT
  std::optional<exact::PartedNumbers> parted;
  if (!way.parted.empty()) {
    parted = exact::parted_numbers(problem, way.parted);
    numbers = &parted->numbers;
  }
#endif
  Boundary boundary = loops_boundary(problem, *numbers, two_sided);
  axis.statistics.seconds_sites = watch.lap();

  const double share = walk_share(boundary, way.in_centers);
  auto graph = graph_of(problem, *numbers, share * problem.fine_tolerance, way, boundary,
                        axis.statistics, findings);
#ifdef MEDIAL_HAS_EXACT
  if (parted) rename(parted->names, boundary);
#endif
  for (std::uint32_t& site : findings.lost) site = boundary.originals[site];
  if (!graph) {
    if (problem.is_cancelled()) return axis;
    return Error{ErrorCode::internal, "the walk lost its way: please report this shape", {}};
  }
  watch.lap();
#ifdef MEDIAL_HAS_EXACT
  if (parted && two_sided) remove_spurs(boundary, *graph);
#endif
  constexpr double loose = 0x1p-20;  // of the size: no near tie is that far off
  const double slack = std::max(loose * diagonal(problem.box), 4 * axis.tolerance);
  const auto loose_edges = complete(boundary, problem.frame, problem.frame.scale * slack, *graph);
  boundary = {};
  take_edges(graph->edges, two_sided ? own_numbers.count : 0, edges);
  axis.nodes = std::move(graph->nodes);
  axis.statistics += graph->statistics;
  if (!two_sided && !has_right_topology(problem.shape, axis.nodes, edges))
    return error_of_wrong_axis(
        axis, "the axis does not have one cycle for each hole: please report this shape");
  if (!two_sided) axis.sites = site::result_sites(problem.shape, own_numbers);
  axis.statistics.seconds_collect += watch.lap();
  axis.statistics.seconds = all.lap();
  for (const std::uint32_t edge : loose_edges)
    if (!touches_its_sites(axis, edges[edge], slack))
      return error_of_wrong_axis(
          axis, "a disk of the axis misses a site that it should touch: please report this shape");
  return axis;
}

/// Marks points along the boundary, so many on both sides of each of these sites.
std::vector<bool> points_around(const Problem& problem, const std::vector<std::uint32_t>& sites,
                                std::size_t around) {
  const std::vector<std::uint32_t>& edge = problem.numbers().edge;
  std::vector<bool> marked(edge.size(), false);
  for (const std::uint32_t site : sites) {
    const auto point = static_cast<std::size_t>(ranges::lower_bound(edge, site) - edge.begin());
    const auto& begin = problem.shape.loop_begin;
    const auto loop = std::upper_bound(begin.begin(), begin.end(), point) - 1;
    const std::size_t size = loop[1] - loop[0];
    for (std::size_t i = 0; i <= std::min(2 * around, size); ++i)
      marked[loop[0] + (point - loop[0] + size + i - std::min(around, size)) % size] = true;
  }
  return marked;
}

/// Marks the components of these sites, and all of their points.
void mark_components(const Problem& problem, const std::vector<std::uint32_t>& sites, Way& way) {
  const Shape& shape = problem.shape;
  const std::vector<bool> points = points_around(problem, sites, 0);
  way.in_precise.assign(shape.component_count(), sites.empty());
  way.parted.assign(shape.points.size(), false);
  for (const bool marks_points : {false, true})
    for (std::size_t loop = 0; loop < shape.loop_count(); ++loop)
      for (std::size_t i = shape.loop_begin[loop]; i < shape.loop_begin[loop + 1]; ++i)
        if (marks_points)
          way.parted[i] = way.in_precise[shape.component[loop]];
        else if (points[i])
          way.in_precise[shape.component[loop]] = true;
}

/// What has been tried, and what to try next.
struct Attempts {
  int parted = 0;
  bool in_precise = false, in_double = false;
};

/// What to try after an attempt that lost its way at these sites, or failed: joints of arcs as they
/// stand around the sites, in ever more of them; 256 bits in their components; double only, which
/// comes before where so many sites would take seconds, and first in the centres of arcs. None
/// where all has been tried.
std::optional<Way> next_way(const Problem& problem, const Way& last,
                            const std::vector<std::uint32_t>& lost, Attempts& attempts) {
  constexpr int most_parted = 3;
  constexpr std::size_t around = 4;
  Way way;
  way.in_centers = last.in_centers;
  const bool with_arcs = has_arcs(problem.shape);
  if (last.in_centers && last.in_double) return way;
  const bool goes_on = !attempts.in_precise && (last.in_centers || !attempts.in_double);
  if (goes_on && with_arcs && !lost.empty() && attempts.parted < most_parted) {
    way.parted = points_around(problem, lost, around << (2 * attempts.parted++));
    for (std::size_t i = 0; i < last.parted.size(); ++i)
      if (last.parted[i]) way.parted[i] = true;
    return way;
  }
  if (attempts.in_precise && attempts.in_double) return std::nullopt;
  mark_components(problem, lost, way);
  const std::ptrdiff_t long_time = with_arcs ? 1 << 10 : 1 << 14;
  const bool takes_long = std::count(way.parted.begin(), way.parted.end(), true) > long_time;
  if (!attempts.in_precise && (attempts.in_double || !takes_long)) {
    attempts.in_precise = true;
    return way;
  }
  attempts.in_double = way.in_double = true;
  way.parted.clear();
  way.in_precise.clear();
  return way;
}

/// The axis of a shape, walked as it is.
Result<MedialAxis> run_in_place(const Problem& problem, const SiteNumbers& numbers) {
  Attempts attempts;
  std::optional<Error> error;
  for (std::optional<Way> way = Way{}; way;) {
    const bool is_first = attempts.parted == 0 && !attempts.in_precise && !attempts.in_double;
    std::vector<Edge> edges;
    Findings findings;
    Result<MedialAxis> axis = attempt(problem, numbers, false, *way, edges, findings);
    if (findings.too_coarse) {
      // All that is left open there is mostly one node: what double makes of it is measured.
      way->in_double = way->in_centers = attempts.in_double = true;
      continue;
    }
    if (axis) {
      axis->edges = std::move(edges);
      const bool is_certain =
          findings.lost.empty() && (is_first || (!way->in_double && !has_arcs(problem.shape)));
      if (is_certain || problem.is_cancelled()) return axis;
    }
    auto refused = axis ? error_if_refused(problem, *axis) : axis.error();
    if (!refused) return axis;
    if (!error || axis) error = std::move(refused);
    way = next_way(problem, *way, findings.lost, attempts);
  }
  return std::move(*error);
}

template <class E>
TwoSided run_two_sided_in_place(const Problem& problem, const SiteNumbers& numbers,
                                std::vector<E>& edges) {
  Attempts attempts;
  Way way;
  way.in_double = !has_exact;
  for (;;) {
    edges.clear();
    Findings findings;
    Result<MedialAxis> axis = attempt(problem, numbers, true, way, edges, findings);
    if (findings.too_coarse) {
      way.in_centers = true;
      continue;
    }
    if (axis && findings.lost.empty()) return {std::move(*axis), !way.in_double};
    std::optional<Way> next = next_way(problem, way, findings.lost, attempts);
    if (!next) {
      if (axis) return {std::move(*axis), false};
      edges.clear();
      return {};
    }
    way = std::move(*next);
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

Result<MedialAxis> run(const Problem& problem) {
  if (!has_arcs(problem.shape)) return run_in_place(problem, problem.numbers());
  const Posed posed(problem);
  auto axis = run_in_place(posed.problem, posed.numbers);
  if (!axis) return posed.pose.to_input(axis.error());
  posed.pose.to_input(problem, posed.numbers, *axis, axis->edges);
  return axis;
}

template <class E>
TwoSided run_two_sided(const Problem& problem, std::vector<E>& edges) {
  if (!has_arcs(problem.shape)) return run_two_sided_in_place(problem, problem.numbers(), edges);
  const Posed posed(problem);
  TwoSided result = run_two_sided_in_place(posed.problem, posed.numbers, edges);
  posed.pose.to_input(problem, posed.numbers, result.axis, edges);
  return result;
}

template TwoSided run_two_sided(const Problem&, std::vector<Edge>&);
template TwoSided run_two_sided(const Problem&, std::vector<VoronoiEdge>&);

}  // namespace medial::disks
