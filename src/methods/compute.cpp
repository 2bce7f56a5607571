#include "medial/compute.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "axis/statistics.h"
#include "base/in_flight.h"
#include "base/threads.h"
#include "methods/checks.h"
#include "methods/disks/disks.h"
#include "methods/drop_enclosure.h"
#include "methods/problem.h"
#include "methods/refusal.h"
#include "methods/small_components.h"
#include "methods/table.h"
#include "methods/whole_part.h"
#include "shape/exterior.h"

namespace medial {
namespace {

/// The contours of the exterior's boundary, one for each loop, if those of the shape are known.
std::vector<Contour> exterior_contours(const Problem& problem, const Exterior& exterior) {
  std::vector<Contour> contours;
  if (problem.contours.size() != problem.shape.loop_count()) return contours;
  std::vector<Vec2> enclosure;
  for (std::size_t i = 0; i < exterior.of_enclosure.size(); ++i)
    if (exterior.of_enclosure[i]) enclosure.push_back(exterior.shape.points[i]);
  contours.push_back(contour_of(enclosure, {}, true));
  for (const Contour& contour : problem.contours) {
    contours.push_back(contour);
    contours.back().role = RingRole::any;
  }
  return contours;
}

/// The axis of the enclosure less the shape, without the parts that touch the enclosure.
Result<MedialAxis> compute_exterior(const Problem& problem) {
  const Options& options = problem.options;
  const auto margin = checked_margin_for(problem.box, options.margin);
  if (!margin) return margin.error();
  auto exterior = exterior_of(problem.shape, *margin);
  if (!exterior) return std::move(exterior).error();
  Options inside = options;
  inside.exterior = false;
  const std::vector<Contour> contours = exterior_contours(problem, *exterior);
  auto axis = compute(exterior->shape, inside, contours);
  if (!axis) return axis;
  // The sites of the enclosure begin and end in its corners, however a method numbers them.
  std::vector<Vec2> corners;
  for (std::size_t i = 0; i < exterior->of_enclosure.size(); ++i)
    if (exterior->of_enclosure[i]) corners.push_back(exterior->shape.points[i]);
  const auto is_corner = [&](Vec2 p) {
    return std::find(corners.begin(), corners.end(), p) != corners.end();
  };
  std::vector<bool> of_enclosure;
  for (const Site& site : axis->sites)
    of_enclosure.push_back(is_corner(site.start) && is_corner(site.end));
  drop_enclosure(of_enclosure, bounding_box(exterior->shape), *axis);
  axis->exterior = *margin;
  return axis;
}

}  // namespace

Result<MedialAxis> compute(const Shape& shape, const Options& options,
                           std::span<const Contour> contours) {
  try {
    if (auto error = refuse(shape, options)) return std::move(*error);
    const Problem problem(shape, options, contours);
    const MethodRow& method = row_of(options.method);
    if (auto error = method.refuse(problem)) return std::move(*error);
    if (options.exterior) return compute_exterior(problem);
    const auto divided = small_components(problem);
    bool is_right = true;
    auto outcome = on_threads(options.threads, [&] {
      auto found = divided ? run_divided(problem, *divided) : solver_of(options).run(problem);
      if (found && found->to_check && !problem.is_cancelled())
        is_right = has_right_topology(shape, found->axis.nodes, found->axis.edges);
      return found;
    });
    if (!outcome) return std::move(outcome).error();
    MedialAxis& axis = outcome->axis;
    axis.statistics.threads = method.info.threads ? effective_threads(options.threads) : 1;
    if (problem.is_cancelled()) return Error{ErrorCode::cancelled, "cancelled", {}};
    if (!is_right)
      return error_of_wrong_axis(
          axis,
          "the axis does not have one part for each component and one cycle for each hole: please "
          "report this shape");
    if (options.progress) options.progress(1);
    return std::move(axis);
  } catch (...) {
    return error_in_flight();
  }
}

bool comes_in_parts(const Shape& shape, const Options& options) {
  return std::holds_alternative<method::Disks>(options.method) && !options.exact &&
         !options.exterior && !has_arcs(shape);
}

Result<MedialAxis> compute_in_parts(const Shape& shape, const Options& options,
                                    const AxisSink& sink) {
  try {
    if (auto error = refuse(shape, options)) return std::move(*error);
    Options again = options;
    if (comes_in_parts(shape, options)) {
      Options first = options;
      first.progress = part_of_progress(options.progress, 0, attempt_share);
      again.progress = part_of_progress(options.progress, attempt_share, 1 - attempt_share);
      const Problem problem(shape, first);
      const auto divided = small_components(problem);
      auto axis = on_threads(options.threads, [&] {
        return divided ? run_divided_in_parts(problem, *divided, sink)
                       : disks::run_in_parts(problem, sink);
      });
      if (!axis) return std::move(axis).error();
      if (problem.is_cancelled()) return Error{ErrorCode::cancelled, "cancelled", {}};
      if (*axis) {
        (*axis)->statistics.threads = effective_threads(options.threads);
        if (options.progress) options.progress(1);
        return std::move(**axis);
      }
    }
    auto axis = compute(shape, again);
    if (!axis) return axis;
    if (Status handed = sink(whole_part(*axis)); !handed) return std::move(handed).error();
    return axis;
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
