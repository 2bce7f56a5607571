
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "base/arc.h"
#include "base/box_tree.h"
#include "base/compat.h"
#include "base/in_flight.h"
#include "base/numbers.h"
#include "base/spatial_order.h"
#include "base/threads.h"
#include "base/tolerance.h"
#include "medial/query.h"
#include "medial/verify.h"
#include "medial/voronoi.h"
#include "methods/checks.h"
#include "methods/disks/collect.h"
#include "methods/disks/disks.h"
#include "shape/around.h"
#include "shape/exterior.h"
#include "shape/limits.h"
#include "voronoi/axis_around.h"
#include "voronoi/long_edges.h"
#include "voronoi/planar_graph_diagram.h"
#include "voronoi/points_diagram.h"

namespace medial {
namespace {

/// The enclosure that a planar graph's diagram is cut off at; an error where it does not hold the
/// planar graph.
Result<Box> enclosure_for(const PlanarGraph& planar_graph, const Options& options,
                          const std::optional<Box>& enclosure) {
  constexpr double most = 1e6;  // of the planar graph's size, or of its coordinates'
  const Box box = bounding_box(planar_graph);
  const double size = diagonal(box);
  const double largest = std::max(largest_coordinate_in(box), size);
  if (enclosure) {
    const bool holds = enclosure->low.x < box.low.x && enclosure->low.y < box.low.y &&
                       enclosure->high.x > box.high.x && enclosure->high.y > box.high.y;
    if (!holds || !(diagonal(*enclosure) <= most * std::max(largest, 1.0)))
      return Error{ErrorCode::invalid_option, "the enclosure must contain all of the input", {}};
    const Vec2 sides = enclosure->high - enclosure->low;
    if (!(std::min(sides.x, sides.y) >= least_room * spacing_in(*enclosure)))
      return Error{ErrorCode::invalid_option,
                   "the enclosure must be wider than what rounding can separate",
                   {}};
    return *enclosure;
  }
  const bool is_point = options.margin == 0 && size == 0;
  const double margin =
      is_point ? (largest > 0 ? 0.5 * largest : 1) : margin_for(box, options.margin);
  if (!(options.margin >= 0 && margin >= least_margin_for(box) &&
        margin <= most * std::max(largest, 1.0)))
    return Error{ErrorCode::invalid_option,
                 "the margin must be in [1e-6, 1e6] of the input's diagonal, and far above the "
                 "rounding of its coordinates",
                 {}};
  return Box{box.low - Vec2{margin, margin}, box.high + Vec2{margin, margin}};
}

std::optional<Error> refuse(const PlanarGraph& planar_graph, const Options& options) {
  if (auto error = refuse(options)) return error;
  if (planar_graph.points.empty()) return Error{ErrorCode::empty, "there is no point", {}};
  if (planar_graph.half_edges.size() + planar_graph.lone_points.size() >
      std::numeric_limits<std::uint32_t>::max() / 16)
    return Error{ErrorCode::too_large, "there are more than 2^28 edges and points", {}};
  return std::nullopt;
}

/// In tolerances: below `told_apart`, some disks may not separate two elements; below `doubtful`,
/// two elements may be the reason why a walk failed.
constexpr double told_apart = 16, doubtful = 0x1p20;

/// The ends of an edge, the lower one in the direction that it mostly runs in first.
std::array<std::uint32_t, 2> ends_by_place(const PlanarGraph& planar_graph,
                                           const PlanarGraphEdge& edge) {
  const Vec2 along = planar_graph.points[edge.to] - planar_graph.points[edge.from];
  const bool forward = std::abs(along.x) > std::abs(along.y) ? along.x > 0 : along.y > 0;
  return forward ? std::array{edge.from, edge.to} : std::array{edge.to, edge.from};
}

/// Calls visit(points, box around them) for all points of a planar graph, each once, in groups that
/// lie close together. `order` is a spatial one of the edges and, counted on, the lone points; of
/// some neighbouring edges the first ends are a group and the last ones are another, as edges may
/// be long.
template <class Visit>
void for_each_group(const PlanarGraph& planar_graph, const std::vector<std::uint32_t>& order,
                    Visit&& visit) {
  constexpr std::size_t together = 8;
  const std::size_t edges = planar_graph.edges.size();
  std::vector<bool> seen(planar_graph.points.size());
  std::vector<std::uint32_t> points;
  for (std::size_t begin = 0; begin < order.size(); begin += together) {
    for (const std::size_t end : {0UL, 1UL}) {
      points.clear();
      Box around = Box::nothing();
      for (std::size_t i = begin; i < std::min(begin + together, order.size()); ++i) {
        const std::uint32_t one = order[i];
        const std::uint32_t point = one < edges
                                        ? ends_by_place(planar_graph, planar_graph.edges[one])[end]
                                        : planar_graph.lone_points[one - edges].point;
        if (seen[point]) continue;
        seen[point] = true;
        points.push_back(point);
        around.add(planar_graph.points[point]);
      }
      if (!points.empty()) visit(points, around);
    }
  }
}

Error error_of_close_point(const PlanarGraph& planar_graph, std::uint32_t point) {
  const VertexSource source = planar_graph.point_sources[point];
  Error error{
      ErrorCode::unsupported,
      "a point is nearer to another one, or to an edge, than rounding can separate: move it away",
      {}};
  error.place.ring = source.ring;
  error.place.vertex = source.vertex;
  error.place.point = planar_graph.points[point];
  return error;
}

/// Whether a point is surely further than `least` from an arc's whole circle: the box around a long
/// arc holds much else.
bool is_off_circle(Vec2 p, const BulgeArc& arc, double least) {
  const double squared = arc.bulge * arc.bulge, share = 1 / (4 * arc.bulge);
  const Vec2 center = midpoint(arc.start, arc.end) + (1 - squared) * share * left_of(arc.chord());
  const double radius = (1 + squared) * std::abs(share) * norm(arc.chord());
  return std::abs(distance(p, center) - radius) > 2 * least + 0x1p-48 * radius;
}

/// An error that names the first point which is nearer than that to another one, or to an edge that
/// does not end there, if there is one and edges. O(n log n).
std::optional<Error> too_close(const PlanarGraph& planar_graph, double least) {
  const auto edges = static_cast<std::uint32_t>(planar_graph.edges.size());
  std::vector<Box> boxes;  // of edges, then of lone points
  boxes.reserve(edges + planar_graph.lone_points.size());
  const auto add = [&](Vec2 a, Vec2 b, double beside) {
    boxes.push_back({{std::min(a.x, b.x) - beside, std::min(a.y, b.y) - beside},
                     {std::max(a.x, b.x) + beside, std::max(a.y, b.y) + beside}});
  };
  for (const PlanarGraphEdge& edge : planar_graph.edges) {
    const Vec2 a = planar_graph.points[edge.from], b = planar_graph.points[edge.to];
    add(a, b, edge.bulge == 0 ? least : 0.5 * std::abs(edge.bulge) * distance(a, b) + least);
  }
  for (const LonePoint& lone : planar_graph.lone_points)
    add(planar_graph.points[lone.point], planar_graph.points[lone.point], least);
  const std::vector<std::uint32_t> order = z_order(BoxTree::places_of(boxes));
  const BoxTree tree(boxes, order);
  std::uint32_t first = none;
  const auto look_at = [&](std::uint32_t point, std::uint32_t k) {
    const Vec2 p = planar_graph.points[point];
    const auto& [low, high] = boxes[k];
    if (point >= first || p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y) return;
    const std::uint32_t other = k < edges ? k : planar_graph.lone_points[k - edges].point;
    if (k < edges ? planar_graph.edges[k].from == point || planar_graph.edges[k].to == point
                  : other == point)
      return;
    if (k < edges && planar_graph.edges[k].bulge != 0) {
      const PlanarGraphEdge& edge = planar_graph.edges[k];
      const BulgeArc arc{planar_graph.points[edge.from], planar_graph.points[edge.to], edge.bulge};
      if (is_off_circle(p, arc, least)) return;
    }
    const std::uint32_t site =
        k < edges ? static_cast<std::uint32_t>(planar_graph.points.size()) + k : other;
    if (distance(foot(voronoi::site_of_planar_graph(planar_graph, site), p), p) < least)
      first = point;
  };
  for_each_group(planar_graph, order,
                 [&](const std::vector<std::uint32_t>& points, const Box& around) {
                   tree.find(around, [&](std::uint32_t k) {
                     for (const std::uint32_t point : points) look_at(point, k);
                   });
                 });
  if (first == none) return std::nullopt;
  return error_of_close_point(planar_graph, first);
}

/// The axis without its edges, which are returned apart, and without its sites.
template <class E>
Result<MedialAxis> run_around(const PlanarGraph& planar_graph, const Problem& surroundings,
                              std::vector<E>& edges) {
  auto [axis, is_certain] = disks::run_around(surroundings, edges);
  if (surroundings.is_cancelled()) return Error{ErrorCode::cancelled, "cancelled", {}};
  // Decisions in double may be wrong if elements are too close.
  if (!is_certain)
    if (auto error = too_close(planar_graph, told_apart * surroundings.tolerance))
      return std::move(*error);
  if (!has_right_topology(surroundings.shape, axis.nodes, edges))
    return Error{ErrorCode::internal,
                 "the diagram is not connected as it should be: please report this input",
                 {}};
  return std::move(axis);
}

/// With all corners, however flat, next to arcs: a joint without a branch would have a straight
/// spoke. Of shapes with arcs, the axis has its sites.
Result<MedialAxis> run_with_corners(const PlanarGraph& planar_graph, const Shape& surroundings,
                                    const Options& options, std::vector<VoronoiEdge>& edges,
                                    site::SiteNumbers& numbers) {
  const bool has_arcs = !surroundings.bulges.empty();
  Options all = options;
  if (has_arcs) all.corner_angle = 0;
  Problem problem(surroundings, all);
  auto axis = run_around(planar_graph, problem, edges);
  if (axis && has_arcs) axis->sites = problem.result_sites();
  numbers = std::move(problem).numbers();
  return axis;
}

/// An internal error where points are so near to others that they may have misled the walk, as an
/// error that names one of them.
Error explained(Error error, const PlanarGraph& planar_graph, double tolerance) {
  if (error.code == ErrorCode::internal)
    if (auto close = too_close(planar_graph, doubtful * tolerance)) return std::move(*close);
  return error;
}

/// Whether two arcs that end in one point lie on one circle, or nearly so, or may, where very many
/// of one radius do. O(n log n).
bool has_arcs_of_one_circle(const PlanarGraph& planar_graph) {
  constexpr double near = 1e-6;  // of the radius
  constexpr std::size_t very_many = 64;
  struct Circle {
    std::uint32_t point;  ///< on it, where the arc ends
    double radius;
    Vec2 center;
  };
  std::vector<Circle> circles;
  for (const PlanarGraphEdge& edge : planar_graph.edges) {
    if (edge.bulge == 0) continue;
    const BulgeArc arc{planar_graph.points[edge.from], planar_graph.points[edge.to], edge.bulge};
    const double radius = 1 / curvature(arc);
    const Vec2 center = arc.start + radius * left_of(start_tangent(arc));
    for (const std::uint32_t point : {edge.from, edge.to})
      circles.push_back({point, std::abs(radius), center});
  }
  std::sort(circles.begin(), circles.end(), [](const Circle& a, const Circle& b) {
    return std::tie(a.point, a.radius) < std::tie(b.point, b.radius);
  });
  for (std::size_t i = 0; i < circles.size(); ++i) {
    const Circle& own = circles[i];
    const double most = near * own.radius;
    for (std::size_t k = i + 1; k < circles.size() && circles[k].point == own.point &&
                                circles[k].radius <= own.radius + most;
         ++k)
      if (k > i + very_many || distance(own.center, circles[k].center) <= most) return true;
  }
  return false;
}

/// Points next to arcs, or in their centres, may mislead the walk, and so may the common centre of
/// arcs that follow each other: such a diagram is measured. An error where the certificate refuses
/// it.
std::optional<Error> refused_next_to_arcs(const PlanarGraph& planar_graph,
                                          const VoronoiDiagram& diagram, const Options& options) {
  const bool has_arcs = ranges::any_of(planar_graph.edges,
                                       [](const PlanarGraphEdge& edge) { return edge.bulge != 0; });
  if (!has_arcs) return std::nullopt;
  const auto close = [&] { return too_close(planar_graph, doubtful * diagram.tolerance); };
  VerifyOptions demands;
  demands.threads = options.threads;
  if (planar_graph.lone_points.empty() && !close()) {
    if (!has_arcs_of_one_circle(planar_graph)) return std::nullopt;
    demands.samples_per_edge = 1;  // nodes are wrong there, if anything is
  }
  const VoronoiCertificate certificate = verify(planar_graph, diagram, demands);
  if (certificate.passed) return std::nullopt;
  if (auto error = close()) return error;
  Error error{
      ErrorCode::unsupported,
      "rounding alone decides what a disk touches next to arcs here: move the ends near it apart",
      {}};
  error.place.point = certificate.worst;
  return error;
}

}  // namespace

Result<MedialAxis> axis_around(const PlanarGraph& planar_graph, const Shape& surroundings,
                               const Options& options, bool divided) {
  try {
    if (auto error = refuse(planar_graph, options)) return std::move(*error);
    if (auto error = beyond_limits(surroundings)) return std::move(*error);
    const Problem problem(surroundings, options);
    const double tolerance = problem.tolerance;
    std::vector<Edge> edges;
    auto axis = on_threads(options.threads, [&] {
      auto found = run_around(planar_graph, problem, edges);
      if (found) found->sites = problem.result_sites();
      return found;
    });
    if (!axis) return explained(std::move(axis).error(), planar_graph, tolerance);
    if (divided)
      if (Status split = voronoi::split_long_edges(*axis, edges, true); !split)
        return std::move(split).error();
    axis->edges = std::move(edges);
    return axis;
  } catch (...) {
    return error_in_flight();
  }
}

Result<VoronoiDiagram> voronoi_diagram(const PlanarGraph& planar_graph, const Options& options,
                                       const std::optional<Box>& enclosure) {
  try {
    if (auto error = refuse(planar_graph, options)) return std::move(*error);
    auto box = enclosure_for(planar_graph, options, enclosure);
    if (!box) return std::move(box).error();
    const Box far = voronoi::far_enclosure(*box);
    if (auto error = beyond_limits(planar_graph, far)) return std::move(*error);
    const double tolerance = tolerance_for(far, options.tolerance);

    Result<VoronoiDiagram> diagram = on_threads(options.threads, [&]() -> Result<VoronoiDiagram> {
      if (planar_graph.edges.empty()) {
        auto of_points = voronoi::diagram_of_points(planar_graph, options, *box);
        if (options.cancel != nullptr && options.cancel->load())
          return Error{ErrorCode::cancelled, "cancelled", {}};
        return of_points;
      }
      const Shape shape = around(planar_graph, far);
      std::vector<VoronoiEdge> edges;
      site::SiteNumbers numbers;
      auto axis = run_with_corners(planar_graph, shape, options, edges, numbers);
      if (!axis) return std::move(axis).error();
      if (!shape.bulges.empty())
        if (Status split = voronoi::split_long_edges(*axis, edges, false); !split)
          return std::move(split).error();
      return voronoi::diagram_of(planar_graph, shape, numbers, std::move(axis).value(),
                                 std::move(edges), *box);
    });

    if (!diagram) return explained(std::move(diagram).error(), planar_graph, tolerance);
    if (auto error = refused_next_to_arcs(planar_graph, *diagram, options))
      return std::move(*error);
    diagram->statistics.threads = effective_threads(options.threads);
    if (options.progress) options.progress(1);
    return diagram;
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
