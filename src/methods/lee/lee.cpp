#include "methods/lee/lee.h"

#include <cmath>
#include <optional>
#include <stdexcept>

#include "base/stopwatch.h"
#include "base/tolerance.h"
#include "methods/checks.h"
#include "methods/lee/graph.h"
#include "methods/lee/ties.h"

namespace medial::lee {
namespace {

/// A point amid very many sides that turn by very little each, if there are such: three next to
/// each other determine a disk far less exactly than the tolerance.
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
  /// Lee, Section II: the list of elements, the diagrams of the chains, merges.
  Solution(const Shape& shape, const Options& options, std::vector<Level>* levels) {
    Stopwatch watch;
    const Box box = bounding_box(shape);
    frame = frame_of(box);
    tolerance = tolerance_for(box, options.tolerance);
    const Box local{frame.to_local(box.low), frame.to_local(box.high)};

    numbers = sites::number_sites(shape, frame, options.corner_angle);
    elements_ = elements_of(shape, numbers, frame);
    statistics.seconds_sites = watch.lap();

    // To a multiple of the tolerance, what misled a merge is a tie; what that may make of the disks
    // is checked to the tolerance itself, below.
    for (const double multiple : {1.0, 8.0, 64.0}) {
      const ConquerContext context{
          {multiple * tolerance_for(local, options.tolerance), radius_limit(box, frame)},
          multiple * local_tolerance(),
          options.cancel,
          options.progress};
      if (levels != nullptr) levels->clear();
      diagram_.emplace(elements_);
      try {
        const std::vector<std::uint32_t> last_edges =
            conquer(*diagram_, context, statistics, levels);
        statistics.seconds_walk += watch.lap();
        if (is_cancelled(options)) return;
        graph.emplace(*diagram_, last_edges, multiple * local_tolerance());
        break;
      } catch (const std::runtime_error&) {
        // Of such a boundary, rounding may break the structure, too.
        if (const auto place = find_smooth_run(elements_)) {
          error = too_nearly_round(*place);
          return;
        }
        if (multiple > 8) throw;
      }
    }
    join_ties(*graph, local_tolerance());
    // The certificate, too, would refuse such an axis.
    constexpr double slack = 2;
    if (const auto disk = find_overreach(*graph, slack * local_tolerance()))
      error = too_nearly_round(disk->center);
    statistics.seconds_collect = watch.lap();
  }
  Solution(const Solution&) = delete;  // its members refer to each other
  Solution& operator=(const Solution&) = delete;

  /// Where the shape lies far from the origin, its own coordinates are no better known.
  double local_tolerance() const { return frame.scale * tolerance; }

  /// Leaves the numbers of the sites only.
  void free_graph() {
    graph.reset();
    diagram_.reset();
    elements_ = {};
  }

  LocalFrame frame;
  double tolerance = 0;  ///< in units of the input
  sites::SiteNumbers numbers;
  Statistics statistics;
  std::optional<Error> error;

 private:
  Error too_nearly_round(Vec2 place) const {
    Error told{ErrorCode::unsupported,
               "the boundary is too nearly round here for its sides to be told from rounding: use "
               "the method disks",
               {}};
    told.place.point = frame.to_input(place);
    return told;
  }

  Elements elements_;
  std::optional<Diagram> diagram_;

 public:
  std::optional<Graph> graph;  ///< none where the caller cancelled
};

}  // namespace

Result<MedialAxis> run(const Shape& shape, const Options& options, std::vector<Level>* levels) {
  Stopwatch all;
  Solution solution(shape, options, levels);
  if (solution.error) return *solution.error;
  MedialAxis axis;
  axis.method = name_of(Method::lee);
  axis.tolerance = solution.tolerance;
  if (!solution.graph) return axis;
  axis.statistics = solution.statistics;
  Stopwatch watch;
  complete(*solution.graph, solution.frame, solution.local_tolerance(), axis);
  solution.free_graph();
  axis.sites = sites::result_sites(shape, solution.numbers);
  axis.statistics.seconds_collect += watch.lap();
  axis.statistics.seconds = all.lap();
  return axis;
}

Result<VoronoiDiagram> voronoi_diagram(const Shape& shape, const Options& options) {
  Stopwatch all;
  const Solution solution(shape, options, nullptr);
  if (solution.error) return *solution.error;
  VoronoiDiagram diagram;
  diagram.method = name_of(Method::lee);
  diagram.tolerance = solution.tolerance;
  if (!solution.graph) return diagram;
  diagram.statistics = solution.statistics;
  complete(*solution.graph, solution.frame, diagram);
  diagram.sites = sites::result_sites(shape, solution.numbers);
  diagram.statistics.seconds = all.lap();
  return diagram;
}

}  // namespace medial::lee
