#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <variant>

#include "axis/statistics.h"
#include "base/disjoint_sets.h"
#include "base/threads.h"
#include "load/progress.h"
#include "load/threads_of.h"
#include "medial/load.h"
#include "methods/raster/finer_grid.h"

namespace medial {
namespace {

/// By how much the numbers of parts and cycles of an interior's axis of pixels differ from the
/// numbers of components and holes of its shape.
std::uint64_t unresolved_in(const AxisItem& item) {
  const Shape& shape = item.shape;
  const MedialAxis& axis = item.axis;
  if (!is_of_pixels(axis.method) || axis.exterior > 0) return 0;
  std::vector<std::int64_t> parts(shape.component_count(), -1), cycles(shape.component_count());
  for (std::size_t i = 0; i < shape.loop_count(); ++i)
    if (shape.hole[i]) --cycles[shape.component[i]];
  for (const Node& node : axis.nodes) ++parts[node.component];
  DisjointSets sets(axis.nodes.size());
  for (const Edge& edge : axis.edges) {
    const std::uint32_t component = axis.nodes[edge.node[0]].component;
    if (sets.join(edge.node[0], edge.node[1]))
      --parts[component];
    else
      ++cycles[component];
  }
  std::int64_t off = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) off += std::abs(parts[i]) + std::abs(cycles[i]);
  return static_cast<std::uint64_t>(off);
}

/// The number of pixels that would suffice if the given ones do not; see AxesReport.
std::uint32_t pixels_for(const AxisItem& item) {
  const MedialAxis& axis = item.axis;
  const std::uint32_t pixels = raster::pixels_that_do(item.shape, axis.method, axis.resolution);
  return pixels > 0 ? pixels : std::numeric_limits<std::uint32_t>::max();
}

}  // namespace

Result<Document<AxisItem>> compute_axes(Document<ShapeItem> shapes, AxesOptions options,
                                        AxesReport* report) {
  std::visit(
      [&](auto& own) {
        if constexpr (requires { own.grid; })
          if (own.grid.resolution == 0 && own.grid.pixels == 0) own.grid.resolution = shapes.pixel;
      },
      options.method);
  std::vector<double> weights;
  for (const ShapeItem& item : shapes.items)
    weights.push_back(static_cast<double>(item.shape.points.size()));
  SharedProgress progress(options.progress, std::accumulate(weights.begin(), weights.end(), 0.0));
  Document<AxisItem> axes{shapes, std::vector<AxisItem>(shapes.items.size())};
  const auto compute_one = [&](std::size_t i, int threads) -> Status {
    ShapeItem& from = shapes.items[i];
    Options own = options;
    own.threads = threads;
    own.progress = progress.part(weights[i]);
    auto axis = compute(from.shape, own, from.contours);
    if (own.progress) own.progress(1.0);
    if (!axis) return std::move(axis).error();
    axes.items[i] = {std::move(from.shape), std::move(axis).value(), std::move(from.attributes)};
    return success();
  };
  // A sampled method may be slow for a shape of few points.
  const bool sampled = info_of(options.method).sampling != Sampling::curves;
  const int threads = sampled ? options.threads : threads_of(weights, options);
  AxesReport sum;
  auto* left_out = options.skip_invalid && report != nullptr ? &sum.left_out : nullptr;
  const auto kept = for_each_feature(axes, weights, threads, compute_one, left_out, options.cancel);
  if (!kept) return kept.error();
  axes.keep(*kept);

  const std::string_view asked = name_of(options.method);
  for (AxisItem& item : axes.items) {
    sum.statistics += item.axis.statistics;
    if (asked != "auto" && item.axis.method != asked) ++sum.by_disks;
    const std::uint64_t unresolved = unresolved_in(item);
    sum.unresolved += unresolved;
    if (unresolved > 0 && report != nullptr) sum.pixels = std::max(sum.pixels, pixels_for(item));
  }
  sum.statistics.threads = effective_threads(options.threads);
  if (report != nullptr) *report = sum;
  return axes;
}

}  // namespace medial
