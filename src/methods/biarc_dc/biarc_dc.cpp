#include "methods/biarc_dc/biarc_dc.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "axis/steps.h"
#include "base/arc.h"
#include "base/stopwatch.h"
#include "methods/biarc_dc/conquer.h"
#include "methods/biarc_dc/divide.h"
#include "methods/biarc_dc/maximal_disk.h"
#include "methods/biarc_dc/outline.h"
#include "methods/biarc_dc/sound.h"
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
  report.divided_elements = division.divided_elements;
  return report;
}

/// A place where rounding alone may decide what disks touch, if any: an edge so short that its
/// direction has few digits, an arc as small, or arcs of almost one circle, either three in a row
/// or two that turn by about half a circle. O(n).
std::optional<Vec2> doubtful_place(const Problem& problem) {
  const Shape& shape = problem.shape;
  constexpr double few_digits = 0x1p-24;   // of the size
  constexpr double short_edge = 0x1p-6;    // of the size of the shape
  constexpr double near_circle = 1 << 16;  // tolerances
  constexpr double far_turn = 0.75;        // sum of two bulges: about half a circle
  const double least = few_digits * diagonal(problem.box);
  const double near = near_circle * problem.joint_tolerance;
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
    const auto points = shape.loop(loop);
    const std::size_t n = points.size();
    const auto bulge = [&](std::size_t i) { return shape.bulge(shape.loop_begin[loop] + i % n); };
    const auto curvature_of = [&](std::size_t i) {
      return curvature({points[i % n], points[(i + 1) % n], bulge(i)});
    };
    const auto is_near = [&](double one, double next) {
      return one > 0 && next > 0 && std::abs(one - next) <= near * one * next;
    };
    for (std::size_t i = 0; i < n; ++i) {
      if (distance(points[i], points[(i + 1) % n]) < short_edge * least) return points[i];
      if (bulge(i) == 0) continue;
      const double one = curvature_of(i), next = curvature_of(i + 1);
      if (std::abs(one) * least > 1) return points[i];
      if (is_near(one, next) &&
          (bulge(i) + bulge(i + 1) > far_turn || is_near(next, curvature_of(i + 2))))
        return points[i];
    }
  }
  return std::nullopt;
}

Error refusal_at(std::optional<Vec2> place) {
  Error error{ErrorCode::unsupported,
              "what a disk touches here depends on rounding alone: use the method disks",
              {}};
  error.place.point = place;
  return error;
}

struct Attempt {
  MedialAxis axis;
  bool is_certain = false;
};

/// One attempt (Aichholzer et al., Section 3): sites, divide by random maximal disks, conquer,
/// curves. If the axis will be verified, its edges get their curves whatever the options say.
Result<Attempt> attempt(const Problem& problem, std::uint64_t seed, bool verified, Report* report) {
  MedialAxis axis;
  axis.method = "biarc-dc";
  axis.tolerance = problem.tolerance;
  Stopwatch all, watch;

  const SiteOutline outline = outline_of(problem, axis.statistics);
  axis.statistics.seconds_sites = watch.lap();
  const site::BoundaryTree tree(outline.sites);
  axis.statistics.seconds_tree = watch.lap();
  Context context{outline, tree, problem.fine_tolerance, problem.radius_limit, axis.statistics};

  const auto division = divide(context, seed, problem.options);
  if (!division) return refusal_at(problem.frame.to_input(*context.stuck));
  if (report != nullptr) *report = report_of(*division);
  context.statistics.seconds_walk = watch.lap();
  if (problem.is_cancelled()) return Attempt{std::move(axis), true};

  const Skeleton skeleton = conquer(context, *division);
  axis.statistics = context.statistics;
  const bool is_certain = is_sound(skeleton, context, problem.local_tolerance());
  const bool curves = problem.own<method::BiarcDc>().curves || verified || !is_certain;
  add_edges(skeleton, context, problem.frame, curves, axis);
  axis.sites = problem.result_sites();
  axis.statistics.seconds_collect = watch.lap();
  axis.statistics.seconds = all.lap();
  return Attempt{std::move(axis), is_certain};
}

/// The axis as the options request it: with its conics, or straight until conic_of() is called.
MedialAxis finished(MedialAxis axis, bool curves) {
  if (curves) return axis;
  for (Edge& edge : axis.edges) {
    edge.control = straight_edge(axis, edge.node[0], edge.node[1]).control;
    edge.weight = 1;
  }
  return axis;
}

}  // namespace

Result<MedialAxis> run(const Problem& problem, Report* report) {
  constexpr std::uint64_t most_attempts = 4;
  const method::BiarcDc& own = problem.own<method::BiarcDc>();
  const std::optional<Vec2> doubtful = doubtful_place(problem);
  std::optional<Error> refused;
  for (std::uint64_t i = 0; i < most_attempts; ++i) {
    auto tried = attempt(problem, own.seed + i, doubtful.has_value(), report);
    if (!tried) {
      refused = std::move(tried).error();
      continue;
    }
    if ((!doubtful && tried->is_certain) || problem.is_cancelled())
      return finished(std::move(tried->axis), own.curves);
    const auto error = error_if_refused(problem, tried->axis);
    if (!error) return finished(std::move(tried->axis), own.curves);
    refused = refusal_at(error->place.point);
  }
  return std::move(*refused);
}

}  // namespace medial::biarc_dc
