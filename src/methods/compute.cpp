#include "medial/compute.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/arc.h"
#include "base/compat.h"
#include "base/in_flight.h"
#include "base/threads.h"
#include "base/tolerance.h"
#include "methods/biarc_dc/biarc_dc.h"
#include "methods/checks.h"
#include "methods/disks/disks.h"
#include "methods/disks/refusal.h"
#include "methods/drop_frame.h"
#include "methods/lee/lee.h"
#include "methods/potential/potential.h"
#include "methods/raster/brushfire/brushfire.h"
#include "methods/raster/ridge/ridge.h"
#include "shape/exterior.h"
#ifdef MEDIAL_HAS_EXACT
#include "methods/exact/certify.h"
#endif

namespace medial {
namespace {

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

/// Where rounding alone may decide what disks touch, if anywhere: at an arc so small that its
/// directions have few digits, or at one that the next arc continues on almost the same circle.
/// O(n).
std::optional<Vec2> doubtful_place(const Shape& shape) {
  if (shape.bulges.empty()) return std::nullopt;
  constexpr double few_digits = 0x1p-24;   // of the size
  constexpr double near_circle = 1 << 12;  // tolerances
  const Box box = bounding_box(shape);
  const double least = few_digits * diagonal(box), near = near_circle * tolerance_for(box, 0);
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
    const auto points = shape.loop(loop);
    const auto curvature_of = [&](std::size_t i) {
      return curvature(
          {points[i], points[(i + 1) % points.size()], shape.bulge(shape.loop_begin[loop] + i)});
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double one = curvature_of(i), next = curvature_of((i + 1) % points.size());
      const bool small = std::abs(one) * least > 1;
      if (small || (one > 0 && next > 0 && std::abs(one - next) <= near * one * next))
        return points[i];
    }
  }
  return std::nullopt;
}

/// Whether a disk is touched by so many sites that rounding may decide what it is.
bool has_large_ties(const MedialAxis& axis) {
  constexpr std::uint32_t many = 8;
  std::vector<std::uint32_t> degree(axis.nodes.size());
  return ranges::any_of(axis.edges, [&](const Edge& edge) {
    return ++degree[edge.node[0]] > many || ++degree[edge.node[1]] > many;
  });
}

/// The method biarc-dc. Where its axis is doubtful it is certified, begun anew from other random
/// places, and refused if none stands.
Result<MedialAxis> run_biarc_dc(const Shape& shape, Options options) {
  constexpr int most_beginnings = 4;
  const std::optional<Vec2> doubtful = doubtful_place(shape);
  std::optional<Error> error;
  for (int i = 0; i < most_beginnings; ++i, ++options.seed) {
    error = Error{ErrorCode::unsupported, "", {}};
    error->place.point = doubtful;
    try {
      MedialAxis axis = biarc_dc::run(shape, options);
      const bool certain = !doubtful && (shape.bulges.empty() || !has_large_ties(axis));
      if (certain || is_cancelled(options)) return axis;
      error = disks::error_if_refused(shape, options, axis);
      if (!error) return axis;
    } catch (const std::runtime_error&) {
      if (!doubtful) throw;
    }
  }
  error->text = "rounding alone tells what a disk touches here";
  return std::move(*error);
}

Result<MedialAxis> run(const Shape& shape, const Options& options, bool& in_centers) {
  switch (options.method) {
    case Method::potential:
      return potential::run(shape, options);
    case Method::biarc_dc:
      return run_biarc_dc(shape, options);
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

#ifdef MEDIAL_HAS_EXACT
/// Makes the combinatorics of an axis certain. Where disks are in the centres of several arcs, the
/// result is measured, and joints that count as smooth are taken as they stand if it fails so.
std::optional<Error> make_certain(const Shape& shape, const Options& options, bool in_centers,
                                  MedialAxis& axis) {
  const auto attempt = [&](bool part_joints) -> std::optional<Error> {
    Status certain = on_threads(options.threads,
                                [&] { return exact::certify(shape, options, part_joints, axis); });
    if (!certain) return std::move(certain).error();
    return in_centers ? disks::error_if_refused(shape, options, axis) : std::nullopt;
  };
  if (!in_centers) return attempt(false);
  MedialAxis copy = axis;
  auto error = attempt(false);
  if (!error) return error;
  axis = std::move(copy);
  return attempt(true);
}
#endif

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
    if (is_cancelled(options)) return Error{ErrorCode::cancelled, "cancelled", {}};
    const bool whole =
        axis.resolution == 0 || (options.method == Method::potential && options.potential.whole());
    if (whole && !has_right_topology(shape, axis.nodes.size(), axis.edges.size()))
      return disks::error_of_wrong_axis(
          axis, "the axis does not have one cycle for each hole: please report this shape");
#ifdef MEDIAL_HAS_EXACT
    if (options.exact)
      if (auto error = make_certain(shape, options, in_centers, axis)) return std::move(*error);
#endif
    if (options.progress) options.progress(1);
    return result;
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
