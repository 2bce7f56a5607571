#include "methods/biarc_dc/biarc_dc.h"

#include "base/local_frame.h"
#include "base/stopwatch.h"
#include "base/tolerance.h"
#include "methods/biarc_dc/conquer.h"
#include "methods/biarc_dc/divide.h"
#include "methods/biarc_dc/maximal_disk.h"
#include "methods/biarc_dc/outline.h"

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

}  // namespace

/// Aichholzer et al., Section 3: sites, divide by random maximal disks, conquer, curves.
MedialAxis run(const Shape& shape, const Options& options, Report* report) {
  MedialAxis axis;
  axis.method = name_of(Method::biarc_dc);
  Stopwatch all, watch;

  const Box box = bounding_box(shape);
  const LocalFrame frame = frame_of(box);
  axis.tolerance = tolerance_for(box, options.tolerance);
  const Box local{frame.to_local(box.low), frame.to_local(box.high)};

  const sites::SiteNumbers numbers = sites::number_sites(shape, frame, options.corner_angle);
  const Outline outline = outline_of(shape, numbers, frame);
  Context context{outline, tolerance_for(local, options.tolerance), radius_limit(box, frame)};
  context.statistics.seconds_sites = watch.lap();

  const Division division = divide(context, options.seed, options.cancel, options.progress);
  if (report != nullptr) *report = report_of(division);
  context.statistics.seconds_walk = watch.lap();

  const Skeleton skeleton = conquer(context, division);
  axis.statistics = context.statistics;
  add_curves(skeleton, context, frame, axis);
  axis.sites = sites::result_sites(shape, numbers);
  axis.statistics.seconds_collect = watch.lap();
  axis.statistics.seconds = all.lap();
  return axis;
}

}  // namespace medial::biarc_dc
