#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/box_tree.h"
#include "base/in_flight.h"
#include "base/limits.h"
#include "base/threads.h"
#include "base/tolerance.h"
#include "engines/axis_around.h"
#include "engines/checks.h"
#include "engines/disks/disks.h"
#include "engines/voronoi/long_edges.h"
#include "engines/voronoi/points_diagram.h"
#include "engines/voronoi/soup_diagram.h"
#include "medial/query.h"
#include "medial/voronoi.h"
#include "shape/around.h"
#include "shape/exterior.h"

namespace medial {
namespace {

/// The frame that a soup's diagram is cut off at; an error where it does not hold the soup.
Result<Box> frame_for(const Soup& soup, const Options& options, const std::optional<Box>& frame) {
  constexpr double most = 1e6;  // of the soup's size, or of its coordinates'
  const Box box = bounding_box(soup);
  const double size = diagonal(box);
  const double largest = std::max(largest_coordinate_in(box), size);
  if (frame) {
    const bool holds = frame->low.x < box.low.x && frame->low.y < box.low.y &&
                       frame->high.x > box.high.x && frame->high.y > box.high.y;
    if (!holds || !(diagonal(*frame) <= most * std::max(largest, 1.0)))
      return Error{ErrorCode::invalid_option, "the frame must hold all of the input inside", {}};
    return *frame;
  }
  double margin = margin_for(box, options.margin);
  if (margin == 0) margin = largest > 0 ? 0.5 * largest : 1;
  if (!(options.margin >= 0 && margin >= 1e-6 * size && margin <= most * std::max(largest, 1.0)))
    return Error{ErrorCode::invalid_option,
                 "the margin must be 0 or in [1e-6, 1e6] of the input's diagonal",
                 {}};
  return Box{box.low - Vec2{margin, margin}, box.high + Vec2{margin, margin}};
}

std::optional<Error> refuse(const Soup& soup, const Options& options) {
  if (auto error = refuse(options)) return error;
  if (soup.points.empty()) return Error{ErrorCode::empty, "there is no point", {}};
  if (soup.half_edges.size() + soup.lone_points.size() >
      std::numeric_limits<std::uint32_t>::max() / 16)
    return Error{ErrorCode::too_large, "there are more than 2^28 edges and points", {}};
  return std::nullopt;
}

Result<MedialAxis> run_around(const Shape& surroundings, const Options& options,
                              bool divide_parabolas) {
  MedialAxis axis = disks::run_two_sided(surroundings, options);
  if (is_cancelled(options)) return Error{ErrorCode::cancelled, "cancelled", {}};
  if (!has_right_topology(surroundings, axis))
    return Error{ErrorCode::internal,
                 "the diagram is not connected as it should be: please report this input",
                 {}};
  voronoi::split_long_edges(axis, divide_parabolas);
  return axis;
}

/// Whether the disks of nodes touch the sites of their edges, but for far more than rounding.
bool touches_its_sites(const MedialAxis& axis) {
  const double slack = 0x1p20 * axis.tolerance;
  return std::ranges::all_of(axis.edges, [&](const Edge& edge) {
    return std::ranges::all_of(edge.node, [&](std::uint32_t node) {
      const Disk& disk = axis.nodes[node].disk;
      return std::ranges::all_of(edge.site, [&](std::uint32_t site) {
        const Vec2 touch = foot(axis.sites[site], disk.center);
        return std::abs(distance(touch, disk.center) - disk.radius) <= slack;
      });
    });
  });
}

/// With all corners, however flat: a joint without a branch would have a straight spoke. Where the
/// walk loses its way among flat ones, as the options have it: spokes are off by less.
Result<MedialAxis> run_with_corners(const Shape& surroundings, const Options& options) {
  if (!surroundings.bulges.empty()) {
    Options all = options;
    all.corner_angle = 0;
    auto axis = run_around(surroundings, all, false);
    const bool failed = !axis && axis.error().code == ErrorCode::internal;
    if (!failed && (!axis || touches_its_sites(*axis))) return axis;
  }
  return run_around(surroundings, options, false);
}

/// In tolerances: what is nearer to each other may be one for some disks; and what may at least
/// have misled a walk that failed.
constexpr double told_apart = 64, doubtful = 0x1p20;

/// An error that names the first point which is nearer than that to another one, or to an edge that
/// does not end there, if there is one and edges. O(n log n).
std::optional<Error> too_close(const Soup& soup, double least) {
  const auto edges = static_cast<std::uint32_t>(soup.edges.size());
  std::vector<Box> boxes;  // of edges, then of lone points
  boxes.reserve(edges + soup.lone_points.size());
  const auto add = [&](Vec2 a, Vec2 b, double beside) {
    boxes.push_back({{std::min(a.x, b.x) - beside, std::min(a.y, b.y) - beside},
                     {std::max(a.x, b.x) + beside, std::max(a.y, b.y) + beside}});
  };
  for (const SoupEdge& edge : soup.edges) {
    const Vec2 a = soup.points[edge.from], b = soup.points[edge.to];
    add(a, b, edge.bulge == 0 ? least : 0.5 * std::abs(edge.bulge) * distance(a, b) + least);
  }
  for (const LonePoint& lone : soup.lone_points)
    add(soup.points[lone.point], soup.points[lone.point], least);
  const BoxTree tree(boxes);
  for (std::uint32_t i = 0; i < soup.points.size(); ++i) {
    const Vec2 p = soup.points[i];
    bool is_close = false;
    const auto look_at = [&](std::uint32_t k) {
      const std::uint32_t other = k < edges ? k : soup.lone_points[k - edges].point;
      if (k < edges ? soup.edges[k].from == i || soup.edges[k].to == i : other == i) return;
      const std::uint32_t site =
          k < edges ? static_cast<std::uint32_t>(soup.points.size()) + k : other;
      is_close = is_close || distance(foot(voronoi::site_of_soup(soup, site), p), p) < least;
    };
    tree.find({p, p}, look_at);
    if (!is_close) continue;
    const VertexSource source = soup.point_sources[i];
    Error error{ErrorCode::unsupported,
                "a point is nearer to another one, or to an edge, than rounding tells apart",
                {}};
    error.place.ring = source.ring;
    error.place.vertex = source.vertex;
    error.place.point = p;
    return error;
  }
  return std::nullopt;
}

/// An internal error where points are so near to others that they may have misled the walk, as an
/// error that names one of them.
Error explained(Error error, const Soup& soup, double tolerance) {
  if (error.code == ErrorCode::internal)
    if (auto close = too_close(soup, doubtful * tolerance)) return std::move(*close);
  return error;
}

}  // namespace

Result<MedialAxis> axis_around(const Soup& soup, const Shape& surroundings,
                               const Options& options) {
  try {
    if (auto error = refuse(soup, options)) return std::move(*error);
    if (auto error = beyond_limits(surroundings)) return std::move(*error);
    const double tolerance = tolerance_for(bounding_box(surroundings), options.tolerance);
    if (auto error = too_close(soup, told_apart * tolerance)) return std::move(*error);
    auto axis =
        on_threads(options.threads, [&] { return run_around(surroundings, options, true); });
    if (!axis) return explained(std::move(axis).error(), soup, tolerance);
    return axis;
  } catch (...) {
    return error_in_flight();
  }
}

Result<VoronoiDiagram> voronoi_diagram(const Soup& soup, const Options& options,
                                       const std::optional<Box>& frame) {
  try {
    if (auto error = refuse(soup, options)) return std::move(*error);
    auto box = frame_for(soup, options, frame);
    if (!box) return std::move(box).error();
    const Box far = voronoi::far_frame(*box);
    if (auto error = beyond_limits(soup, far)) return std::move(*error);
    const double tolerance = tolerance_for(far, options.tolerance);
    if (!soup.edges.empty())
      if (auto error = too_close(soup, told_apart * tolerance)) return std::move(*error);
    Result<VoronoiDiagram> diagram = on_threads(options.threads, [&]() -> Result<VoronoiDiagram> {
      if (soup.edges.empty()) {
        VoronoiDiagram of_points = voronoi::diagram_of_points(soup, options, *box);
        if (is_cancelled(options)) return Error{ErrorCode::cancelled, "cancelled", {}};
        return of_points;
      }
      const Shape shape = around(soup, far);
      auto axis = run_with_corners(shape, options);
      if (!axis) return std::move(axis).error();
      try {
        return voronoi::diagram_of(soup, shape, std::move(axis).value(), *box);
      } catch (const std::runtime_error& error) {
        return Error{ErrorCode::internal, error.what(), {}};
      }
    });
    if (!diagram) return explained(std::move(diagram).error(), soup, tolerance);
    diagram->statistics.threads = effective_threads(options.threads);
    if (options.progress) options.progress(1);
    return diagram;
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
