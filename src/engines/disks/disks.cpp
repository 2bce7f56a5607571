#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <limits>

#include "base/frame.h"
#include "base/tolerance.h"
#include "engines/disks/boundary.h"
#include "engines/disks/collect.h"
#include "engines/disks/connect.h"
#include "engines/disks/walk.h"
#include "index/boundary_tree.h"
#include "medial/compute.h"

namespace medial {
namespace {

/// Seconds since the last call.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// No disk inside the shape has a larger radius: half of the box's smaller side, with room for
/// rounding.
double radius_limit(const Box& box, const Frame& frame) {
  const double width = box.high.x - box.low.x, height = box.high.y - box.low.y;
  return frame.scale * 0.5 * std::min(width, height) * (1 + 0x1p-20);
}

/// The engine: sites, tree, holes connected, walk, graph.
MedialAxis run_disks(const Shape& shape, const Options& options) {
  using namespace disks;
  MedialAxis axis;
  axis.method = "disks";
  Statistics& statistics = axis.statistics;
  Stopwatch all, watch;

  const Box box = bounding_box(shape);
  const Frame frame = frame_of(box);
  axis.tolerance = tolerance_for(box, options.tolerance);
  const double tolerance = frame.scale * axis.tolerance;

  SiteNumbers numbers = number_sites(shape);
  Boundary boundary = loops_boundary(shape, numbers, frame);
  statistics.seconds_sites = watch.lap();
  auto tree = std::make_unique<index::BoundaryTree>(boundary.sites);
  statistics.seconds_tree = watch.lap();

  std::vector<Cut> cuts = connecting_disks(shape, boundary, *tree, tolerance, statistics.queries);
  if (!cuts.empty()) {
    tree.reset();
    boundary = connect(shape, boundary, cuts);
    tree = std::make_unique<index::BoundaryTree>(boundary.sites);
  }
  statistics.cuts = cuts.size();
  statistics.seconds_connect = watch.lap();

  std::atomic<std::uint64_t> finished = 0;
  std::function<void(std::uint64_t)> report;
  if (options.progress) {
    report = [&](std::uint64_t sites) {
      options.progress(std::min(1.0, static_cast<double>(finished += sites) /
                                         static_cast<double>(boundary.sites.size())));
    };
  }
  auto chunks = walk({boundary, cuts, *tree, tolerance, radius_limit(box, frame), options.cancel,
                      std::move(report)});
  tree.reset();
  statistics.seconds_walk = watch.lap();

  collect(chunks, boundary, cuts.size(), frame, axis);
  boundary = {};
  axis.sites = result_sites(shape, numbers);
  statistics.seconds_collect = watch.lap();
  statistics.seconds = all.lap();
  return axis;
}

}  // namespace

Result<MedialAxis> compute(const Shape& shape, const Options& options) {
  if (!(options.tolerance >= 0 && options.tolerance <= 1e-3))
    return Error{ErrorCode::invalid_option, "the tolerance must be in [0, 1e-3]", {}};
  if (options.threads < 0)
    return Error{ErrorCode::invalid_option, "the number of threads must not be negative", {}};
  if (shape.points.empty()) return Error{ErrorCode::empty, "the shape is empty", {}};
  // Every point is at most two sites, and every site bounds at most three nodes.
  if (shape.points.size() > std::numeric_limits<std::uint32_t>::max() / 8)
    return Error{ErrorCode::too_large, "the shape has more than 2^29 vertices", {}};

  const int threads =
      options.threads == 0 ? tbb::this_task_arena::max_concurrency() : options.threads;
  // An arena larger than the machine needs leave to have its threads.
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  MedialAxis axis = arena.execute([&] { return run_disks(shape, options); });
  axis.statistics.threads = threads;
  if (options.cancel != nullptr && options.cancel->load())
    return Error{ErrorCode::cancelled, "cancelled", {}};
  return axis;
}

}  // namespace medial
