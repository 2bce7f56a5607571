#include "medial/verify.h"

#include <cstdarg>
#include <cstdio>
#include <numbers>

#include "shape/exterior.h"
#include "verify/arc_feet.h"
#include "verify/checks.h"

namespace medial {
namespace verify_detail {

std::string sentence(const char* format, ...) {
  char text[512];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

namespace {

/// What residuals are judged against: `relative` to the diagonal (1e-14 where it is 0), but never
/// less than four spacings of doubles at the largest coordinate, to which centres are rounded; and
/// the axis's own tolerance where its user asked for a larger one.
double tolerance_of(const Box& box, double relative, const MedialAxis& axis) {
  constexpr double default_relative = 1e-14;
  const double judged = relative > 0 ? relative : default_relative;
  return std::max({judged * diagonal(box), 4 * spacing_in(box), axis.tolerance});
}

void run_checks(const Shape& original, const MedialAxis& axis, const VerifyOptions& options,
                Certificate& certificate) {
  if (!check_shape(original, certificate)) return;
  Exterior around;
  if (axis.exterior != 0) {
    auto exterior = axis.exterior > 0 ? exterior_of(original, axis.exterior)
                                      : Error{ErrorCode::invalid_option, "a negative margin", {}};
    if (!exterior) {
      certificate.failures.push_back(
          "The exterior cannot be checked: " + to_string(exterior.error()) + ".");
      return;
    }
    around = std::move(exterior).value();
  }
  const Shape& shape = axis.exterior != 0 ? around.shape : original;
  const Box box = bounding_box(shape);
  if (!check_values(shape, box, axis, certificate)) return;
  Problem problem(shape, axis, box);
  problem.tolerance = tolerance_of(box, options.tolerance, axis);
  certificate.tolerance = problem.tolerance;
  certificate.resolution = axis.resolution;
  if (axis.resolution > 0) {
    problem.tolerance = std::max(problem.tolerance, axis.resolution * std::numbers::sqrt2 / 2);
    certificate.tolerance = problem.tolerance;
  }
  prepare(problem, options.corner_angle * std::numbers::pi / 180, certificate);
  check_graph(problem, options.part, certificate);
  if (axis.resolution > 0) {
    check_sampled_disks(problem, certificate);
    return;
  }
  if (axis.exterior != 0 || options.part) {
    check_disks(problem, options.samples_per_edge, certificate);
    return;
  }
  check_vertices(problem, certificate);
  check_disks(problem, options.samples_per_edge, certificate);
  const ArcFeet feet(problem);
  const double open = check_coverage(problem, feet, certificate);
  check_area(problem, feet, open, certificate);
}

}  // namespace
}  // namespace verify_detail

Certificate verify(const Shape& shape, const MedialAxis& axis, const VerifyOptions& options) {
  Certificate certificate;
  verify_detail::certify(options.threads, certificate,
                         [&] { verify_detail::run_checks(shape, axis, options, certificate); });
  return certificate;
}

}  // namespace medial
