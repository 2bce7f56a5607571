#include "voronoi/chain_order.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "base/compat.h"

namespace medial::voronoi {
namespace {

using Step = ChainStep;
using FootOf = std::function<double(const Step&)>;

/// As put_in_order(), of many steps.
bool put_many_in_order(std::span<Step> steps) {
  std::vector<Step> sorted(steps.begin(), steps.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const Step& a, const Step& b) { return a.from < b.from; });
  std::vector<std::uint32_t> to;
  for (const Step& step : sorted) to.push_back(step.to);
  std::sort(to.begin(), to.end());
  const auto begin = std::find_if(sorted.begin(), sorted.end(), [&](const Step& step) {
    return !std::binary_search(to.begin(), to.end(), step.from);
  });
  Step at = begin == sorted.end() ? sorted.front() : *begin;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i] = at;
    if (i + 1 == steps.size()) break;
    const auto next =
        std::lower_bound(sorted.begin(), sorted.end(), at.to,
                         [](const Step& step, std::uint32_t node) { return step.from < node; });
    if (next == sorted.end() || next->from != at.to) return false;
    at = *next;
  }
  return true;
}

/// Whether the steps come through a node more than once: where all around the cell of a point it
/// is one node within the tolerance.
bool passes_twice(std::span<const Step> steps) {
  std::vector<std::uint32_t> from;
  for (const Step& step : steps) from.push_back(step.from);
  std::sort(from.begin(), from.end());
  return std::adjacent_find(from.begin(), from.end()) != from.end();
}

/// Like put_in_order(), if several steps begin at some nodes. Orders steps by their feet along the
/// own site; a step that returns to a node comes before a step that leaves it (Hierholzer).
bool put_loops_in_order(std::span<Step> steps, const FootOf& foot_of) {
  std::map<std::uint32_t, std::vector<std::size_t>> open;  // from each node, the first at the end
  std::map<std::uint32_t, int> surplus;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    open[steps[i].from].push_back(i);
    ++surplus[steps[i].from];
    --surplus[steps[i].to];
  }
  for (auto& [node, some] : open)
    if (some.size() > 1 && foot_of)
      ranges::sort(some, {}, [&](std::size_t i) { return -foot_of(steps[i]); });
  const auto begin = ranges::find_if(surplus, [](const auto& node) { return node.second > 0; });
  const auto most =
      ranges::max_element(open, {}, [](const auto& node) { return node.second.size(); });
  std::vector<std::size_t> way, backward;
  std::uint32_t node = begin != surplus.end() ? begin->first : most->first;
  for (;;) {
    if (auto& some = open[node]; !some.empty()) {
      way.push_back(some.back());
      some.pop_back();
      node = steps[way.back()].to;
    } else {
      if (way.empty()) break;
      backward.push_back(way.back());
      node = steps[way.back()].from;
      way.pop_back();
    }
  }
  if (backward.size() < steps.size()) return false;
  const std::vector<Step> all(steps.begin(), steps.end());
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = all[backward[steps.size() - 1 - i]];
  for (std::size_t i = 1; i < steps.size(); ++i)
    if (steps[i - 1].to != steps[i].from) return false;
  return true;
}

}  // namespace

bool put_in_order(std::span<Step> steps, bool has_arcs, const FootOf& foot_of) {
  if (steps.size() == 1) return true;
  constexpr std::size_t few = 24;
  if (has_arcs && passes_twice(steps)) return put_loops_in_order(steps, foot_of);
  if (steps.size() > few) return put_many_in_order(steps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool begins = std::none_of(steps.begin(), steps.end(),
                                     [&](const Step& other) { return other.to == steps[i].from; });
    if (begins) {
      std::swap(steps[0], steps[i]);
      break;
    }
  }
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const auto next =
        std::find_if(steps.begin() + static_cast<std::ptrdiff_t>(i), steps.end(),
                     [&](const Step& other) { return other.from == steps[i - 1].to; });
    if (next == steps.end()) return false;
    std::swap(steps[i], *next);
  }
  return true;
}

}  // namespace medial::voronoi
