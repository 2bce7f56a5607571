#include "methods/lee/lee.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "axis/statistics.h"
#include "base/stopwatch.h"
#include "methods/lee/graph.h"
#include "methods/lee/ties.h"
#include "methods/refusal.h"

namespace medial::lee {
namespace {

/// A point amid very many sides that turn by very little each, if there are such: three neighbours
/// determine a disk far less exactly than the tolerance.
std::optional<Vec2> find_smooth_run(const Elements& elements) {
  constexpr std::uint32_t many = 256;
  constexpr double little = 1e-3;
  const site::Site* before = nullptr;
  std::uint32_t count = 0;
  for (const site::Site& site : elements.sites) {
    if (site.is_vertex()) continue;
    const bool goes_on = before != nullptr && site::meets(*before, site) &&
                         std::abs(cross(before->direction, site.direction)) <= little;
    count = goes_on ? count + 1 : 0;
    if (count == many) return site.point;
    before = &site;
  }
  return std::nullopt;
}

/// A shape's diagram, and what its results are completed from.
class Solution {
 public:
  explicit Solution(const Problem& problem) : problem_(problem) {}
  Solution(const Solution&) = delete;  // its members refer to each other
  Solution& operator=(const Solution&) = delete;

  /// Lee, Section II: the list of elements, the diagrams of the chains, merges. Leaves no graph
  /// where the caller cancels.
  Status solve(std::vector<Level>* levels) {
    Stopwatch watch;
    auto elements = elements_of(problem_);
    if (!elements) return broken();
    elements_ = std::move(*elements);
    statistics.seconds_sites = watch.lap();
    statistics.bridges = elements_.passages.size() / 2;
    const bool merged = merge_all(levels);
    if (problem_.is_cancelled()) return success();
    if (!merged && elements_.have_arcs()) return undecided();
    if (merged) join_ties(*graph, problem_.local_tolerance());
    if (elements_.have_arcs()) {
      is_doubtful_ = !is_right_locally(*graph, problem_.local_tolerance());
    } else if (!merged || overreach()) {
      if (Status decided = decide_in_precise(); !decided) return decided;
    }
    statistics.seconds_walk = watch.lap();
    return success();
  }

  /// Leaves the statistics only.
  void free_graph() {
    graph.reset();
    diagram_.reset();
    elements_ = {};
  }

  /// Whether disks of a shape with arcs are off by more than the tolerance somewhere.
  bool is_doubtful() const { return is_doubtful_; }

  Statistics statistics;

 private:
  /// Merges the chains and closes the graph; false where rounding breaks a diagram, or where the
  /// caller cancels.
  bool merge_all(std::vector<Level>* levels) {
    diagram_.emplace(elements_, elements_.sites, elements_.disks_of_passages);
    return close(conquer(*diagram_, context(problem_.fine_tolerance), statistics, levels));
  }

  /// Of a polygon: a disk for which the certificate, too, would refuse the axis.
  std::optional<Disk> overreach() const {
    constexpr double slack = 2;
    return find_overreach(*graph, slack * problem_.local_tolerance());
  }

  /// What rounding leaves open of a polygon.
  Status decide_in_precise() {
    // Of such a boundary, rounding may break the structure, too.
    if (const auto place = find_smooth_run(elements_)) return too_nearly_round(*place);
    merge_in_precise();
    if (problem_.is_cancelled()) return success();
    if (!graph) return is_needle() ? undecided() : broken();
    join_ties(*graph, problem_.local_tolerance());
    if (const auto disk = overreach()) return too_nearly_round(disk->center);
    return success();
  }

  /// Whether sides may be nearer to each other than 256 bits separate: at a corner whose sides
  /// double cannot tell apart, or at the two ends of an edge.
  bool is_needle() const {
    constexpr double rounding = 0x1p-50, shortest = 0x1p-200;
    const site::Site* before = nullptr;
    for (const site::Site& site : elements_.sites) {
      if (!site.is_vertex() && site.length < shortest) return true;
      if (before != nullptr && !site.is_vertex() && dot(before->direction, site.direction) < 0 &&
          std::abs(cross(before->direction, site.direction)) <= rounding)
        return true;
      if (!site.is_vertex()) before = &site;
    }
    return false;
  }

  /// The same in 256 bits, from what the shape has: rounded to double at the end.
  void merge_in_precise() {
    const PreciseSites sites = precise_sites(problem_, elements_);
    DiagramIn<InPrecise> precise(elements_, sites.elements, sites.passages);
    Statistics own;
    const auto last_edges = conquer(precise, context(InPrecise::tolerance), own);
    statistics += own;
    statistics.exact_precise += own.queries;
    diagram_.emplace(elements_, elements_.sites, elements_.disks_of_passages);
    diagram_->top = std::move(precise.top);
    diagram_->free = std::move(precise.free);
    std::transform(precise.edges.begin(), precise.edges.end(), diagram_->edges.begin(),
                   [](const auto& edge) {
                     return ListEdge{edge.element, edge.inward, rounded(edge.inner)};
                   });
    close(last_edges);
  }

  ConquerContext context(double tolerance) const {
    return {{tolerance, problem_.radius_limit},
            problem_.local_tolerance(),
            problem_.options.cancel,
            problem_.options.progress};
  }

  bool close(const std::optional<std::vector<std::uint32_t>>& last_edges) {
    if (!last_edges || problem_.is_cancelled()) return false;
    graph.emplace(*diagram_, *last_edges, problem_.local_tolerance());
    if (graph->is_whole()) return true;
    broken_at_ = graph->broken_at();
    graph.reset();
    return false;
  }

  static Error broken() {
    return {
        ErrorCode::internal, "the Voronoi diagrams cannot be merged: please report this shape", {}};
  }
  Error too_nearly_round(Vec2 place) const {
    return unsupported(
        place,
        "the boundary is too nearly round here to separate its sides from rounding: use the method "
        "disks");
  }
  Error undecided() const {
    const Vec2 place = broken_at_ ? elements_.sites[*broken_at_].point : Vec2{};
    Error error = unsupported(
        place, elements_.have_arcs()
                   ? "rounding alone decides what a disk touches next to arcs: use the method disks"
                   : "the sides are too near to each other to separate: use the method disks");
    if (!broken_at_) error.place = {};
    return error;
  }
  Error unsupported(Vec2 place, const char* text) const {
    Error error{ErrorCode::unsupported, text, {}};
    error.place.point = problem_.frame.to_input(place);
    return error;
  }

  const Problem& problem_;
  Elements elements_;
  std::optional<Diagram> diagram_;
  std::optional<std::uint32_t> broken_at_;
  bool is_doubtful_ = false;

 public:
  std::optional<Graph> graph;
};

}  // namespace

Result<MedialAxis> run(const Problem& problem, std::vector<Level>* levels) {
  Stopwatch all;
  Solution solution(problem);
  if (Status solved = solution.solve(levels); !solved) return std::move(solved).error();
  MedialAxis axis;
  axis.method = "lee";
  axis.tolerance = problem.tolerance;
  if (!solution.graph) return axis;
  axis.statistics = solution.statistics;
  Stopwatch watch;
  const double in_middle =
      complete(*solution.graph, problem.frame, problem.local_tolerance(), axis);
  solution.free_graph();
  axis.sites = problem.result_sites();
  axis.statistics.seconds_collect += watch.lap();
  // Next to arcs, rounding may have decided what disks touch.
  if (solution.is_doubtful() || !(in_middle <= problem.local_tolerance()))
    if (auto error = error_if_refused(problem, axis)) {
      error->text += ": use the method disks";
      return std::move(*error);
    }
  axis.statistics.seconds = all.lap();
  return axis;
}

Result<VoronoiDiagram> voronoi_diagram(const Problem& problem) {
  Stopwatch all;
  Solution solution(problem);
  if (Status solved = solution.solve(nullptr); !solved) return std::move(solved).error();
  VoronoiDiagram diagram;
  diagram.method = "lee";
  diagram.tolerance = problem.tolerance;
  if (!solution.graph) return diagram;
  diagram.statistics = solution.statistics;
  diagram.sites = problem.result_sites();
  complete(*solution.graph, problem.frame, diagram);
  diagram.statistics.seconds = all.lap();
  return diagram;
}

}  // namespace medial::lee
