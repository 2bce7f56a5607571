#include "methods/raster/brushfire/layers.h"

#include <algorithm>
#include <utility>

#include "base/disjoint_sets.h"

namespace medial::brushfire {
namespace {

using raster::PixelRun;
using Runs = std::vector<PixelRun>;

/// Calls visit(i, j) for each two runs, i < j, that touch each other: side by side or in rows next
/// to each other, in a corner at least.
template <class Visit>
void for_each_touching(const Runs& runs, const Visit& visit) {
  std::size_t above = 0, begin = 0;  // the first runs of the row before and of this one
  for (std::size_t j = 0; j < runs.size(); ++j) {
    const PixelRun& run = runs[j];
    if (run.row != runs[begin].row) {
      above = begin;
      begin = j;
    }
    if (j > begin && runs[j - 1].last + 1 == run.first) visit(j - 1, j);
    if (runs[above].row + 1 != run.row) continue;
    while (above < begin && runs[above].last + 1 < run.first) ++above;
    for (std::size_t i = above; i < begin && runs[i].first <= run.last + 1; ++i) visit(i, j);
  }
}

/// Runs of one set side by side as one.
Runs joined(const Runs& runs) {
  Runs all;
  for (const PixelRun& run : runs) {
    const bool is_next = !all.empty() && all.back().row == run.row && all.back().set == run.set &&
                         all.back().last + 1 == run.first;
    if (is_next)
      all.back().last = run.last;
    else
      all.push_back(run);
  }
  return all;
}

}  // namespace

std::vector<Runs> layers_of(const Runs& runs) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> touching;  // a set, and one below it
  std::uint32_t sets = 0;
  for (const PixelRun& run : runs) sets = std::max(sets, run.set + 1);
  for_each_touching(runs, [&](std::size_t i, std::size_t j) {
    const std::uint32_t a = runs[i].set, b = runs[j].set;
    if (a != b) touching.push_back({std::max(a, b), std::min(a, b)});
  });
  if (touching.empty()) return {runs};
  std::sort(touching.begin(), touching.end());
  // Each set goes into the first layer that has none of those below it that it touches.
  std::vector<std::uint32_t> layer(sets);
  std::vector<bool> taken;
  std::uint32_t count = 1;
  for (std::size_t i = 0; i < touching.size();) {
    const std::uint32_t set = touching[i].first;
    taken.assign(count + 1, false);
    for (; i < touching.size() && touching[i].first == set; ++i)
      taken[layer[touching[i].second]] = true;
    layer[set] =
        static_cast<std::uint32_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
    count = std::max(count, layer[set] + 1);
  }
  std::vector<Runs> layers(count);
  for (const PixelRun& run : runs) layers[layer[run.set]].push_back(run);
  return layers;
}

bool is_resolved(const Shape& shape, const Runs& all) {
  struct Count {
    std::uint64_t parts = 0, runs = 0, touching = 0, holes = 0;
  };
  const Runs runs = joined(all);
  std::vector<Count> counts(shape.component_count());
  for (std::size_t i = 0; i < shape.loop_count(); ++i)
    if (shape.hole[i]) ++counts[shape.component[i]].holes;
  for (const PixelRun& run : runs) ++counts[run.set].runs, ++counts[run.set].parts;
  DisjointSets sets(runs.size());
  for_each_touching(runs, [&](std::size_t i, std::size_t j) {
    Count& count = counts[runs[i].set];
    if (runs[i].set != runs[j].set) return;
    ++count.touching;
    if (sets.join(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j))) --count.parts;
  });
  // Runs and the places where they touch are a graph, whose bounded faces are the holes.
  return std::all_of(counts.begin(), counts.end(), [](const Count& count) {
    return count.parts == 1 && 1 + count.touching == count.runs + count.holes;
  });
}

}  // namespace medial::brushfire
