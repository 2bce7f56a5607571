#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/in_flight.h"
#include "base/numbers.h"
#include "base/threads.h"
#include "medial/voronoi.h"
#include "methods/checks.h"
#include "methods/disks/disks.h"
#include "methods/lee/lee.h"
#include "voronoi/planar_graph_diagram.h"

namespace medial {
namespace {

/// The diagram inside a polygon from its axis (Lee, Corollary 3), which lacks two spokes for each
/// reflex vertex: to both ends of the axis' edges around it. O(n).
class FromAxis {
 public:
  explicit FromAxis(MedialAxis axis) {
    diagram_.method = std::move(axis.method);
    diagram_.tolerance = axis.tolerance;
    diagram_.sites = std::move(axis.sites);
    diagram_.nodes = std::move(axis.nodes);
    for (const Edge& edge : axis.edges) diagram_.edges.push_back({edge});
    diagram_.statistics = axis.statistics;
  }

  /// Nothing where disks round to one until a face has no edge.
  std::optional<VoronoiDiagram> run(const Shape& shape, const site::SiteNumbers& numbers) {
    if (!make_faces() || !add_spokes(shape, numbers) || !make_faces()) return std::nullopt;
    voronoi::set_kinds(diagram_);
    return std::move(diagram_);
  }

 private:
  std::uint32_t node_of(std::uint32_t edge, std::uint32_t site, bool is_end) const {
    return diagram_.edges[edge].node[is_end == (diagram_.edges[edge].site[1] == site) ? 1 : 0];
  }

  /// Lists the edges of every site, in the order of its feet.
  bool make_faces() {
    std::vector<std::uint32_t>& begin = diagram_.face_begin;
    begin.assign(diagram_.sites.size() + 2, 0);
    for (const VoronoiEdge& edge : diagram_.edges)
      for (const std::uint32_t site : edge.site) ++begin[site + 2];
    for (std::size_t i = 2; i < begin.size(); ++i) begin[i] += begin[i - 1];
    diagram_.face_edges.resize(begin.back());
    for (std::uint32_t e = 0; e < diagram_.edges.size(); ++e)
      for (const std::uint32_t site : diagram_.edges[e].site)
        diagram_.face_edges[begin[site + 1]++] = e;
    begin.pop_back();
    leaving_.assign(diagram_.nodes.size(), none);
    is_reached_.assign(diagram_.nodes.size(), false);
    ends_.assign(diagram_.sites.size(), {});
    for (std::uint32_t site = 0; site < diagram_.sites.size(); ++site)
      if (!put_in_order(site)) return false;
    return true;
  }

  bool put_in_order(std::uint32_t site) {
    const std::span face(diagram_.face_edges.data() + diagram_.face_begin[site],
                         diagram_.face_edges.data() + diagram_.face_begin[site + 1]);
    for (const std::uint32_t e : face) {
      leaving_[node_of(e, site, false)] = e;
      is_reached_[node_of(e, site, true)] = true;
    }
    auto& [first, last] = ends_[site];
    for (const std::uint32_t e : face) {
      const std::uint32_t from = node_of(e, site, false);
      if (!is_reached_[from] || diagram_.nodes[from].disk.center == diagram_.sites[site].start)
        first = last = from;
    }
    for (std::uint32_t& e : face) {
      if (last == none || leaving_[last] == none) return false;
      e = std::exchange(leaving_[last], none);
      last = node_of(e, site, true);
      is_reached_[last] = false;
    }
    return true;
  }

  bool add_spokes(const Shape& shape, const site::SiteNumbers& numbers) {
    for (std::size_t loop = 0; loop < shape.loop_count(); ++loop)
      for (std::uint32_t i = shape.loop_begin[loop]; i < shape.loop_begin[loop + 1]; ++i) {
        if (!numbers.is_site(i)) continue;
        const bool is_first = i == shape.loop_begin[loop];
        const std::uint32_t before =
            numbers.edge[is_first ? shape.loop_begin[loop + 1] - 1 : i - 1];
        const std::uint32_t after = numbers.edge[i], vertex = after - 1;
        const auto point = static_cast<std::uint32_t>(diagram_.nodes.size());
        diagram_.nodes.push_back({{shape.points[i], 0}, shape.component[loop]});
        if (!add_spoke(point, before, vertex) || !add_spoke(point, vertex, after)) return false;
      }
    return true;
  }

  /// To the node at which the foot passes from one site to the next.
  bool add_spoke(std::uint32_t point, std::uint32_t site, std::uint32_t next) {
    const std::uint32_t end = ends_[site].last != none ? ends_[site].last : ends_[next].first;
    if (end == none) return false;
    const auto& [center, radius] = diagram_.nodes[end].disk;
    const Disk middle{midpoint(diagram_.nodes[point].disk.center, center), 0.5 * radius};
    diagram_.edges.push_back({{{point, end}, {site, next}, middle, 1}, true});
    return true;
  }

  /// The nodes in which the edges of a site begin and end, in the order of its feet.
  struct Ends {
    std::uint32_t first = none, last = none;
  };

  VoronoiDiagram diagram_;
  std::vector<Ends> ends_;
  std::vector<std::uint32_t> leaving_;  ///< by an edge of the current site
  std::vector<bool> is_reached_;        ///< by one
};

Result<VoronoiDiagram> diagram_by_disks(const Problem& problem) {
  auto axis = disks::run(problem, 1);
  if (!axis) return std::move(axis).error();
  if (problem.is_cancelled()) return VoronoiDiagram{};
  auto diagram = FromAxis(std::move(axis).value()).run(problem.shape, problem.numbers());
  if (diagram) return std::move(*diagram);
  return Error{ErrorCode::unsupported,
               "two sides are nearer to each other than doubles tell: move them apart",
               {}};
}

}  // namespace

Result<VoronoiDiagram> voronoi_diagram(const Shape& shape, const Options& options) {
  try {
    Options own = options;
    own.method = method::Lee{};
    own.exact = true;  // the edges of ties stay
    if (auto error = refuse(shape, own)) return std::move(*error);
    if (has_arcs(shape))
      return Error{
          ErrorCode::invalid_option,
          "the diagrams of lee take no arcs: use the method disks, which computes one within "
          "an enclosure",
          {}};
    const Problem problem(shape, own);
    auto diagram = on_threads(own.threads, [&]() -> Result<VoronoiDiagram> {
      if (auto by_lee = lee::voronoi_diagram(problem)) return std::move(*by_lee);
      return diagram_by_disks(problem);
    });
    if (!diagram) return diagram;
    diagram->statistics.threads = effective_threads(own.threads);
    if (problem.is_cancelled()) return Error{ErrorCode::cancelled, "cancelled", {}};
    if (own.progress) own.progress(1);
    return diagram;
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
