#include "methods/biarc_dc/biarc_dc.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/arc.h"
#include "base/stopwatch.h"
#include "methods/biarc_dc/conquer.h"
#include "methods/biarc_dc/divide.h"
#include "methods/biarc_dc/maximal_disk.h"
#include "methods/biarc_dc/outline.h"
#include "methods/refusal.h"

namespace medial::biarc_dc {
namespace {

Report report_of(const Division& division) {
  Report report;
  for (const BaseShape& base : division.base_shapes)
    ++report.base_cases[static_cast<std::size_t>(base.base_case)];
  report.base_cases[static_cast<std::size_t>(BaseCase::cap)] = division.caps;
  report.random_disks = division.random_disks;
  report.branching_disks = division.branching_disks;
  report.multi_branchings = division.multi_branchings;
  report.only_vertices = division.only_vertices;
  return report;
}

/// Where rounding alone may decide what disks touch, if anywhere: at an arc so small that its
/// directions have few digits, or at one that the next arc continues on almost the same circle.
/// O(n).
std::optional<Vec2> doubtful_place(const Problem& problem) {
  const Shape& shape = problem.shape;
  if (shape.bulges.empty()) return std::nullopt;
  constexpr double few_digits = 0x1p-24;   // of the size
  constexpr double near_circle = 1 << 12;  // tolerances
  const double least = few_digits * diagonal(problem.box);
  const double near = near_circle * problem.joint_tolerance;
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
  return std::any_of(axis.edges.begin(), axis.edges.end(), [&](const Edge& edge) {
    return ++degree[edge.node[0]] > many || ++degree[edge.node[1]] > many;
  });
}

/// Aichholzer et al., Section 3: sites, divide by random maximal disks, conquer, curves.
Result<MedialAxis> attempt(const Problem& problem, std::uint64_t seed, Report* report) {
  MedialAxis axis;
  axis.method = "biarc-dc";
  axis.tolerance = problem.tolerance;
  Stopwatch all, watch;

  const SiteOutline outline = outline_of(problem);
  Context context{outline, problem.fine_tolerance, problem.radius_limit};
  context.statistics.seconds_sites = watch.lap();

  const auto division = divide(context, seed, problem.options.cancel, problem.options.progress);
  if (!division)
    return Error{
        ErrorCode::internal, "a part of the shape cannot be divided: please report this shape", {}};
  if (report != nullptr) *report = report_of(*division);
  context.statistics.seconds_walk = watch.lap();

  const Skeleton skeleton = conquer(context, *division);
  axis.statistics = context.statistics;
  add_curves(skeleton, context, problem.frame, axis);
  axis.sites = problem.result_sites();
  axis.statistics.seconds_collect = watch.lap();
  axis.statistics.seconds = all.lap();
  return axis;
}

}  // namespace

Result<MedialAxis> run(const Problem& problem, Report* report) {
  constexpr std::uint64_t most_attempts = 4;
  const std::optional<Vec2> doubtful = doubtful_place(problem);
  Error refused{ErrorCode::unsupported, "what a disk touches here depends on rounding alone", {}};
  refused.place.point = doubtful;
  for (std::uint64_t i = 0; i < most_attempts; ++i) {
    auto axis = attempt(problem, problem.own<method::BiarcDc>().seed + i, report);
    if (!axis && !doubtful) return axis;
    refused.place.point = doubtful;
    if (!axis) continue;
    const bool certain = !doubtful && (problem.shape.bulges.empty() || !has_large_ties(*axis));
    if (certain || problem.is_cancelled()) return axis;
    const auto error = error_if_refused(problem, *axis);
    if (!error) return axis;
    refused.place = error->place;
  }
  return refused;
}

}  // namespace medial::biarc_dc
