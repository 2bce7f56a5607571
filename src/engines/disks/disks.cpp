#include <atomic>
#include <chrono>
#include <exception>
#include <limits>
#include <new>
#include <optional>

#include "base/frame.h"
#include "base/limits.h"
#include "base/threads.h"
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

/// The engine: sites, holes connected, tree, walk, graph.
MedialAxis run_disks(const Shape& shape, const Options& options) {
  using namespace disks;
  MedialAxis axis;
  axis.method = "disks";
  Statistics& statistics = axis.statistics;
  Stopwatch all, watch;

  const Box box = bounding_box(shape);
  const Frame frame = frame_of(box);
  axis.tolerance = tolerance_for(box, options.tolerance);
  // Where the shape lies far from the origin, only going back there rounds: the local frame knows
  // its coordinates better.
  const Box local{frame.to_local(box.low), frame.to_local(box.high)};
  const double tolerance = tolerance_for(local, options.tolerance);

  const double corner_angle = options.corner_angle * std::acos(-1.0) / 180;
  SiteNumbers numbers = number_sites(shape, frame, corner_angle);
  Boundary boundary = loops_boundary(shape, numbers, frame);
  statistics.seconds_sites = watch.lap();

  const std::vector<Cut> cuts = connecting_disks(shape, boundary, tolerance, statistics.queries);
  if (!cuts.empty()) boundary = connect(shape, boundary, cuts);
  statistics.cuts = cuts.size();
  statistics.seconds_connect = watch.lap();

  auto tree = std::make_unique<index::BoundaryTree>(boundary.sites);
  statistics.seconds_tree = watch.lap();

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

/// Whether the arrays of a hand-made shape fit together well enough to walk along them.
bool is_consistent(const Shape& shape) {
  const std::size_t loops = shape.component.size();
  if (shape.sources.size() != shape.points.size() || shape.hole.size() != loops ||
      shape.loop_begin.size() != loops + 1 || loops == 0 || shape.loop_begin.front() != 0 ||
      shape.loop_begin.back() != shape.points.size() ||
      !(shape.bulges.empty() || shape.bulges.size() == shape.points.size()))
    return false;
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
      doubled += cross(start - points[0], end - points[0]);
      const double bulge = shape.bulge(shape.loop_begin[i] + j);
      if (bulge == 0) continue;
      const double radius = distance(start, end) * (1 + bulge * bulge) / (4 * bulge);
      const double angle = 4 * std::atan(bulge);
      doubled += radius * radius * (angle - std::sin(angle));
    }
    if (!(shape.hole[i] ? doubled <= 0 : doubled >= 0)) return false;
  }
  return true;
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
  return std::nullopt;
}

/// The Euler characteristic: one connected part for each component, one cycle for each hole.
bool has_right_topology(const Shape& shape, const MedialAxis& axis) {
  const auto signed_size = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  return signed_size(axis.nodes.size()) - signed_size(axis.edges.size()) ==
         signed_size(shape.component_count()) - signed_size(shape.hole_count());
}

}  // namespace

Result<MedialAxis> compute(const Shape& shape, const Options& options) {
  try {
    if (auto error = refuse(shape, options)) return std::move(*error);
    MedialAxis axis = on_threads(options.threads, [&] { return run_disks(shape, options); });
    axis.statistics.threads = effective_threads(options.threads);
    if (options.cancel != nullptr && options.cancel->load())
      return Error{ErrorCode::cancelled, "cancelled", {}};
    if (!has_right_topology(shape, axis))
      return Error{ErrorCode::internal,
                   "the axis does not have one cycle for each hole: please report this shape",
                   {}};
    if (options.progress) options.progress(1);
    return axis;
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::out_of_memory, "memory ran out", {}};
  } catch (const std::exception& exception) {
    return Error{ErrorCode::internal, exception.what(), {}};
  }
}

}  // namespace medial
