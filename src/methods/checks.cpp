#include "methods/checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/arc.h"
#include "shape/limits.h"
#include "base/threads.h"
#include "methods/potential/force.h"
#include "methods/raster/brushfire/brushfire.h"
#include "methods/raster/ridge/ridge.h"

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

}  // namespace

std::optional<Error> refuse(const Options& options) {
  if (!(options.tolerance >= 0 && options.tolerance <= 1e-3))
    return Error{ErrorCode::invalid_option, "the tolerance must be in [0, 1e-3]", {}};
  if (options.threads < 0 || options.threads > most_threads)
    return Error{ErrorCode::invalid_option, "the number of threads must be in [0, 1024]", {}};
  return std::nullopt;
}

std::optional<Error> refuse(const Shape& shape, const Options& options) {
  if (auto error = refuse(options)) return error;
  if (!(options.corner_angle >= 0 && options.corner_angle <= 10))
    return Error{ErrorCode::invalid_option, "the corner angle must be in [0, 10] degrees", {}};
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

bool has_right_topology(const Shape& shape, std::size_t nodes, std::size_t edges) {
  const auto signed_size = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  return signed_size(nodes) - signed_size(edges) ==
         signed_size(shape.component_count()) - signed_size(shape.hole_count());
}

bool is_cancelled(const Options& options) {
  return options.cancel != nullptr && options.cancel->load();
}

}  // namespace medial
