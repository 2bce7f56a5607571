#include "medial/compute.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/arc.h"
#include "base/box_tree.h"
#include "base/in_flight.h"
#include "base/limits.h"
#include "base/threads.h"
#include "base/tolerance.h"
#include "engines/axis_around.h"
#include "engines/biarc_dc/biarc_dc.h"
#include "engines/brushfire/brushfire.h"
#include "engines/disks/disks.h"
#include "engines/drop_frame.h"
#include "engines/lee/lee.h"
#include "engines/potential/force.h"
#include "engines/potential/potential.h"
#include "engines/ridge/ridge.h"
#include "engines/voronoi/long_edges.h"
#include "engines/voronoi/points_diagram.h"
#include "engines/voronoi/soup_diagram.h"
#include "medial/query.h"
#include "medial/voronoi.h"
#include "shape/around.h"
#include "shape/exterior.h"
#ifdef MEDIAL_HAS_EXACT
#include "exact/certify.h"
#endif

namespace medial {
namespace {

/// Whether every component has one outer loop, and every hole lies in one of them.
bool has_one_outer_loop_each(const Shape& shape) {
  std::vector<bool> bounded(shape.component_count(), false);
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const std::uint32_t component = shape.component[i];
    if (component >= bounded.size()) return false;
    if (shape.hole[i]) continue;
    if (bounded[component]) return false;
    bounded[component] = true;
  }
  return true;
}

/// Whether the arrays of a hand-made shape fit together well enough to walk along them.
bool is_consistent(const Shape& shape) {
  const std::size_t loops = shape.component.size();
  if (shape.sources.size() != shape.points.size() || shape.hole.size() != loops ||
      shape.loop_begin.size() != loops + 1 || loops == 0 || shape.loop_begin.front() != 0 ||
      shape.loop_begin.back() != shape.points.size() ||
      !(shape.bulges.empty() || shape.bulges.size() == shape.points.size()))
    return false;
  if (!has_one_outer_loop_each(shape)) return false;
  for (const double bulge : shape.bulges)
    if (!(std::abs(bulge) <= 1)) return false;
  for (std::size_t i = 0; i < loops; ++i) {
    if (shape.loop_begin[i] > shape.loop_begin[i + 1] ||
        shape.loop_begin[i + 1] > shape.points.size())
      return false;
    const std::span<const Vec2> points = shape.loop(i);
    if (points.size() < (shape.bulges.empty() ? 3 : 2)) return false;
    double doubled = 0;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const Vec2 start = points[j], end = points[j + 1 == points.size() ? 0 : j + 1];
      if (start == end) return false;
      doubled += cross(start - points[0], end - points[0]);
      doubled += 2 * area_beside_chord({start, end, shape.bulge(shape.loop_begin[i] + j)});
    }
    if (!(shape.hole[i] ? doubled <= 0 : doubled >= 0)) return false;
  }
  return true;
}

std::optional<Error> refuse(const PotentialOptions& options) {
  const auto invalid = [](const char* text) { return Error{ErrorCode::invalid_option, text, {}}; };
  const auto is_order = [](double n) { return n >= 1 && n <= potential::largest_order; };
  if (!(options.order == 0 || is_order(options.order)) ||
      !(options.base_order == 0 || is_order(options.base_order)))
    return invalid("the order of the potential must be in [1, 4096]");
  if (!(options.step >= 1e-4 && options.step <= 0.1))
    return invalid("the step must be in [1e-4, 0.1]");
  if (!(options.coarse >= 0 && options.coarse <= 0.2))
    return invalid("the coarse polygon's distance must be in [0, 0.2]");
  if (!(options.angle > 0 && options.angle <= 90))
    return invalid("the angle must be in (0, 90] degrees");
  if (!(options.movement > 0 && options.movement <= 0.1))
    return invalid("the movement must be in (0, 0.1]");
  return std::nullopt;
}

/// What the engine cannot take, if anything.
std::optional<Error> refuse(const Shape& shape, const Options& options) {
  if (!(options.tolerance >= 0 && options.tolerance <= 1e-3))
    return Error{ErrorCode::invalid_option, "the tolerance must be in [0, 1e-3]", {}};
  if (!(options.corner_angle >= 0 && options.corner_angle <= 10))
    return Error{ErrorCode::invalid_option, "the corner angle must be in [0, 10] degrees", {}};
  if (options.threads < 0 || options.threads > most_threads)
    return Error{ErrorCode::invalid_option, "the number of threads must be in [0, 1024]", {}};
  if (shape.points.empty()) return Error{ErrorCode::empty, "the shape is empty", {}};
  // Every point is at most two sites, and every site bounds at most three nodes.
  if (shape.points.size() > std::numeric_limits<std::uint32_t>::max() / 8)
    return Error{ErrorCode::too_large, "the shape has more than 2^29 vertices", {}};
  if (auto error = beyond_limits(shape)) return error;
  if (!is_consistent(shape))
    return Error{ErrorCode::malformed, "the shape was not made by build_shape()", {}};
  const bool sampled = options.method == Method::ridge || options.method == Method::potential ||
                       options.method == Method::brushfire;
  if (options.exact && sampled)
    return Error{ErrorCode::invalid_option, "exact decisions are for exact methods only", {}};
#ifndef MEDIAL_HAS_EXACT
  if (options.exact) return Error{ErrorCode::unsupported, "this build has no exact decisions", {}};
#endif
  if (options.method == Method::biarc_dc && shape.hole_count() > 0)
    return Error{ErrorCode::unsupported,
                 "the method biarc-dc takes shapes without holes only: use the method disks",
                 {}};
  if (options.method == Method::lee && shape.hole_count() > 0)
    return Error{ErrorCode::unsupported,
                 "the method lee takes polygons without holes only: use the method disks",
                 {}};
  if (options.method == Method::lee &&
      std::any_of(shape.bulges.begin(), shape.bulges.end(), [](double b) { return b != 0; }))
    return Error{ErrorCode::unsupported,
                 "the method lee takes straight edges only: use the method disks",
                 {}};
  if (options.method == Method::ridge) return ridge::refuse(shape, options);
  if (options.method == Method::potential) return refuse(options.potential);
  if (options.method == Method::brushfire) return brushfire::refuse(shape, options);
  return std::nullopt;
}

/// The axis of the frame less the shape, without what touches the frame.
Result<MedialAxis> compute_exterior(const Shape& shape, const Options& options) {
  if (options.method == Method::brushfire)
    return Error{ErrorCode::unsupported,
                 "the method brushfire does not know what touches the frame: use ridge",
                 {}};
  const auto margin = checked_margin_for(bounding_box(shape), options.margin);
  if (!margin) return margin.error();
  auto exterior = exterior_of(shape, *margin);
  if (!exterior) return std::move(exterior).error();
  Options inside = options;
  inside.exterior = false;
  auto axis = compute(exterior->shape, inside);
  if (!axis) return axis;
  // The sites of the frame: those that begin and end in its corners, however a method numbers them.
  std::vector<Vec2> corners;
  for (std::size_t i = 0; i < exterior->of_frame.size(); ++i)
    if (exterior->of_frame[i]) corners.push_back(exterior->shape.points[i]);
  const auto is_corner = [&](Vec2 p) {
    return std::find(corners.begin(), corners.end(), p) != corners.end();
  };
  std::vector<bool> of_frame;
  for (const Site& site : axis->sites)
    of_frame.push_back(is_corner(site.start) && is_corner(site.end));
  drop_frame(of_frame, *axis);
  axis->exterior = *margin;
  return axis;
}

/// The Euler characteristic: one connected part for each component, one cycle for each hole.
bool has_right_topology(const Shape& shape, const MedialAxis& axis) {
  const auto signed_size = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  return signed_size(axis.nodes.size()) - signed_size(axis.edges.size()) ==
         signed_size(shape.component_count()) - signed_size(shape.hole_count());
}

Result<MedialAxis> run(const Shape& shape, const Options& options, bool& in_centers) {
  switch (options.method) {
    case Method::potential:
      return potential::run(shape, options);
    case Method::biarc_dc:
      return biarc_dc::run(shape, options);
    case Method::lee:
      return lee::run(shape, options);
    case Method::ridge:
      return ridge::run(shape, options);
    case Method::brushfire:
      return brushfire::run(shape, options);
    case Method::disks:
      break;
  }
  return disks::run(shape, options, &in_centers);
}

constexpr std::array<std::pair<Method, const char*>, 6> method_names = {
    {{Method::disks, "disks"},
     {Method::biarc_dc, "biarc-dc"},
     {Method::lee, "lee"},
     {Method::ridge, "ridge"},
     {Method::potential, "potential"},
     {Method::brushfire, "brushfire"}}};

}  // namespace

const char* name_of(Method method) {
  for (const auto& [known, name] : method_names)
    if (known == method) return name;
  return "";
}

std::optional<Method> method_from(std::string_view name) {
  for (const auto& [method, known] : method_names)
    if (name == known) return method;
  return std::nullopt;
}

Result<MedialAxis> compute(const Shape& shape, const Options& options) {
  try {
    if (auto error = refuse(shape, options)) return std::move(*error);
    if (options.exterior) return compute_exterior(shape, options);
    bool in_centers = false;
    auto result = on_threads(options.threads, [&] { return run(shape, options, in_centers); });
    if (!result) return std::move(result).error();
    MedialAxis& axis = *result;
    const bool one_thread = options.method == Method::biarc_dc || options.method == Method::ridge ||
                            options.method == Method::brushfire;
    axis.statistics.threads = one_thread ? 1 : effective_threads(options.threads);
    if (options.cancel != nullptr && options.cancel->load())
      return Error{ErrorCode::cancelled, "cancelled", {}};
    const bool whole =
        axis.resolution == 0 || (options.method == Method::potential && options.potential.whole());
    if (whole && !has_right_topology(shape, axis))
      return disks::error_of_wrong_axis(
          axis, "the axis does not have one cycle for each hole: please report this shape");
#ifdef MEDIAL_HAS_EXACT
    if (options.exact) {
      Status certain =
          on_threads(options.threads, [&] { return exact::certify(shape, options, axis); });
      if (!certain) return std::move(certain).error();
      if (in_centers)
        if (auto refused = disks::error_if_refused(shape, options, axis))
          return std::move(*refused);
    }
#endif
    if (options.progress) options.progress(1);
    return result;
  } catch (...) {
    return error_in_flight();
  }
}

Result<VoronoiDiagram> voronoi_diagram(const Shape& shape, const Options& options) {
  try {
    Options own = options;
    own.method = Method::lee;
    if (auto error = refuse(shape, own)) return std::move(*error);
    auto diagram = on_threads(own.threads, [&] { return lee::voronoi_diagram(shape, own); });
    if (!diagram) return diagram;
    diagram->statistics.threads = effective_threads(own.threads);
    if (own.cancel != nullptr && own.cancel->load())
      return Error{ErrorCode::cancelled, "cancelled", {}};
    if (own.progress) own.progress(1);
    return diagram;
  } catch (...) {
    return error_in_flight();
  }
}

namespace {

/// The frame that a soup's diagram is cut off at; an error where it does not hold the soup.
Result<Box> frame_for(const Soup& soup, const Options& options, const std::optional<Box>& frame) {
  constexpr double most = 1e6;  // of the soup's size, or of its coordinates'
  const Box box = bounding_box(soup);
  const double size = diagonal(box);
  const double largest = std::max(
      {std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y), size});
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
  if (!(options.tolerance >= 0 && options.tolerance <= 1e-3))
    return Error{ErrorCode::invalid_option, "the tolerance must be in [0, 1e-3]", {}};
  if (options.threads < 0 || options.threads > most_threads)
    return Error{ErrorCode::invalid_option, "the number of threads must be in [0, 1024]", {}};
  if (soup.points.empty()) return Error{ErrorCode::empty, "there is no point", {}};
  if (soup.half_edges.size() + soup.lone_points.size() >
      std::numeric_limits<std::uint32_t>::max() / 16)
    return Error{ErrorCode::too_large, "there are more than 2^28 edges and points", {}};
  return std::nullopt;
}

bool is_cancelled(const Options& options) {
  return options.cancel != nullptr && options.cancel->load();
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
      auto axis = run_around(shape, options, false);
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
