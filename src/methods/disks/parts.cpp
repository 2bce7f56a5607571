#include <algorithm>
#include <atomic>
#include <functional>
#include <optional>

#include "axis/statistics.h"
#include "base/stopwatch.h"
#include "base/threads.h"
#include "methods/disks/boundary.h"
#include "methods/disks/connect.h"
#include "methods/disks/disks.h"
#include "methods/disks/open_graph.h"
#include "methods/disks/walk.h"
#include "site/boundary_tree.h"

namespace medial::disks {
namespace {

/// A part is made of at least so many tasks, which is enough for the threads.
constexpr std::size_t tasks_in_part = 16;

/// Walks all tasks and hands out what is final. Whether the axis is right as far as the walk knows.
Result<bool> walk_in_parts(const WalkContext& context, const AxisSink& sink, std::size_t part_nodes,
                           OpenGraph& open) {
  open.begin(put_off_walk(context));
  while (open.has_tasks()) {
    std::vector<OpenGraph::Task> tasks = open.take(part_nodes);
    parallel_for(tasks.size(), [&](std::size_t i) { tasks[i].chunk->walk(); });
    if (context.is_cancelled()) return true;
    for (OpenGraph::Task& task : tasks) open.add(std::move(task));
    if (!open.is_lost() && (open.is_full(part_nodes) || !open.has_tasks())) {
      AxisPart part = open.next_part();
      if (!open.is_lost())
        if (Status taken = sink(std::move(part)); !taken) return std::move(taken).error();
    }
    if (open.is_lost()) return false;
  }
  return open.has_right_cycles();
}

}  // namespace

Result<std::optional<MedialAxis>> run_in_parts(const Problem& problem, const AxisSink& sink,
                                               std::size_t part_nodes) {
  MedialAxis axis;
  axis.method = "disks";
  axis.tolerance = problem.tolerance;
  Statistics& statistics = axis.statistics;
  Stopwatch all, watch;
  const SiteNumbers& numbers = problem.numbers();
  Boundary boundary = loops_boundary(problem, numbers, Sides::one);
  statistics.seconds_sites = watch.lap();
  const ExactSites sites(problem, numbers, boundary);
  connect_holes(problem.shape, WalkContext::fine_share * problem.fine_tolerance, sites, {},
                boundary);
  statistics.queries += statistics.bridges = boundary.bridges.size();
  statistics.seconds_connect = watch.lap();
  if (problem.is_cancelled()) return std::optional(std::move(axis));
  const site::BoundaryTree tree(boundary.sites, site::BoundaryTree::Chords::beyond_8_sites,
                                boundary.longest_run());
  statistics.seconds_tree = watch.lap();

  std::atomic<std::uint64_t> finished = 0;
  const auto report = [&, count = static_cast<double>(boundary.sites.size())](std::uint64_t more) {
    problem.options.progress(std::min(1.0, static_cast<double>(finished += more) / count));
  };
  WalkContext context(sites, tree);
  context.cancel = problem.options.cancel;
  if (problem.options.progress) context.finished_sites = report;
  context.most_nodes = static_cast<std::uint32_t>(part_nodes / tasks_in_part);
  OpenGraph open(problem, numbers, tree, sites);
  const auto walked = walk_in_parts(context, sink, part_nodes, open);
  if (!walked) return walked.error();
  if (!*walked) return std::optional<MedialAxis>();
  statistics += open.statistics();
  statistics.largest_residual *= problem.frame.inverse;
  statistics.seconds_walk += watch.lap();
  statistics.seconds = all.lap();
  return std::optional(std::move(axis));
}

}  // namespace medial::disks
