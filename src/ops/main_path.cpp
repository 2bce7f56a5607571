// The main path of an axis: between the two ends farthest apart.
//
// Leaves are taken off one after another, and every node remembers how far the best two removed
// paths reach from it. That finds the best path of a tree. Around holes a core without leaves
// remains, in which the two ends' distance is the core's: bounded as Takes and Kosters (2011,
// "Determining the diameter of small world networks") bound eccentricities, by searches from the
// node that may be farthest from everything.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "axis/steps.h"
#include "base/compat.h"
#include "base/numbers.h"
#include "ops/routes.h"
#include "ops/trees.h"

namespace medial {
namespace {

/// The two best ways out of the core from a node: how far they reach, and their first edges;
/// none: the way ends at the node.
struct Hanging {
  std::array<double, 2> reach;
  std::array<std::uint32_t, 2> via{none, none};

  void add(double other, std::uint32_t edge) {
    if (other > reach[0]) {
      reach[1] = reach[0];
      via[1] = via[0];
      reach[0] = other;
      via[0] = edge;
    } else if (other > reach[1]) {
      reach[1] = other;
      via[1] = edge;
    }
  }
  double both() const { return reach[0] + reach[1]; }
};

class MainPaths {
 public:
  MainPaths(const MedialAxis& axis, const MainPathOptions& options)
      : axis_(axis),
        options_(options),
        incidence_(axis),
        lengths_(axis.edges.size()),
        core_lengths_(axis.edges.size(), infinity),
        core_costs_(axis.edges.size(), infinity),
        by_length_(axis, incidence_, core_lengths_),
        by_cost_(axis, incidence_, core_costs_) {}

  std::vector<AxisPath> run() {
    for (std::size_t i = 0; i < lengths_.size(); ++i) lengths_[i] = length(axis_, axis_.edges[i]);
    take_off_hanging();
    for (std::uint32_t i = 0; i < lengths_.size(); ++i) {
      if (taken_[i]) continue;
      core_lengths_[i] = lengths_[i];
      core_costs_[i] = ops::cost_of(axis_, {i, 0, 1}, options_.route);
    }
    std::vector<AxisPath> paths;
    std::vector<bool> seen(axis_.nodes.size(), false);
    for (std::uint32_t node = 0; node < axis_.nodes.size(); ++node) {
      if (seen[node] || incidence_.degree(node) == 0) continue;
      gather(node, seen);
      paths.push_back(path_of_part());
    }
    return paths;
  }

 private:
  void take_off_hanging() {
    hanging_.resize(axis_.nodes.size());
    for (std::size_t i = 0; i < hanging_.size(); ++i) {
      const double radius = axis_.nodes[i].disk.radius;
      hanging_[i].reach = {radius, radius};
    }
    taken_.assign(axis_.edges.size(), false);
    degree_ = ops::take_off_leaves(
        axis_, [](std::uint32_t) { return false; },
        [this](std::uint32_t edge, std::uint32_t leaf, std::uint32_t inner) {
          taken_[edge] = true;
          hanging_[inner].add(hanging_[leaf].reach[0] + lengths_[edge], edge);
        });
  }

  /// The connected part around a node, and of it the core.
  void gather(std::uint32_t start, std::vector<bool>& seen) {
    part_ = {start};
    core_.clear();
    part_edges_ = 0;
    seen[start] = true;
    for (std::size_t i = 0; i < part_.size(); ++i) {
      const std::uint32_t node = part_[i];
      if (degree_[node] > 0) core_.push_back(node);
      part_edges_ += incidence_.degree(node);
      for (const std::uint32_t edge : incidence_.edges(node)) {
        const std::uint32_t next = other_end(axis_.edges[edge], node);
        if (seen[next]) continue;
        seen[next] = true;
        part_.push_back(next);
      }
    }
    part_edges_ /= 2;
  }

  AxisPath path_of_part() {
    if (part_edges_ == part_.size()) {
      if (ranges::none_of(core_, [this](auto node) { return protrudes(node); })) return cycle();
    }
    std::uint32_t top = part_.front();
    for (const std::uint32_t node : part_)
      if (hanging_[node].both() > hanging_[top].both()) top = node;
    double gap = 0;
    const auto [from, to] = core_.empty() ? std::pair(top, top) : farthest(top, gap);
    std::vector<Step> steps = hanging_way(from, from == to ? 1 : 0);
    reverse(steps);
    if (from != to) ranges::copy(core_way(from, to), std::back_inserter(steps));
    ranges::copy(hanging_way(to, 0), std::back_inserter(steps));
    AxisPath path = ops::path_of(axis_, trimmed(std::move(steps)));
    path.gap = gap;
    return path;
  }

  bool protrudes(std::uint32_t node) const {
    return hanging_[node].reach[0] > (1 + options_.trim) * axis_.nodes[node].disk.radius;
  }

  AxisPath cycle() const {
    std::vector<Step> steps;
    const std::uint32_t start = core_.front();
    std::uint32_t node = start, before = none;
    do {
      for (const std::uint32_t edge : incidence_.edges(node)) {
        if (taken_[edge] || edge == before) continue;
        steps.push_back({edge, axis_.edges[edge].node[0] == node});
        break;
      }
      if (steps.empty() || steps.back().edge == before) break;  // one edge from a node to itself
      before = steps.back().edge;
      node = head_of(axis_, steps.back());
    } while (node != start);
    AxisPath path = ops::path_of(axis_, steps);
    path.closed = true;
    return path;
  }

  /// The way down from a node, along its best hanging way or the second best.
  std::vector<Step> hanging_way(std::uint32_t node, std::size_t rank) const {
    std::vector<Step> steps;
    while (hanging_[node].via[rank] != none) {
      const std::uint32_t edge = hanging_[node].via[rank];
      steps.push_back({edge, axis_.edges[edge].node[0] == node});
      node = head_of(axis_, steps.back());
      rank = 0;
    }
    return steps;
  }

  /// The two nodes of the core whose removed paths and distance together reach farthest; or `top`
  /// twice, if the best path is not in the core.
  std::pair<std::uint32_t, std::uint32_t> farthest(std::uint32_t top, double& gap) {
    constexpr int most_searches = 100;
    constexpr double nothing_more = 1e-12;
    std::pair best(top, top);
    double reach = hanging_[top].both();
    std::vector<double> bound(core_.size(), infinity);
    std::vector<bool> searched(core_.size(), false);
    const auto hangs = [this](std::uint32_t node) { return hanging_[node].reach[0]; };
    std::size_t next = 0;
    for (std::size_t i = 0; i < core_.size(); ++i)
      if (hangs(core_[i]) > hangs(core_[next])) next = i;
    for (int count = 0; count < most_searches; ++count) {
      const std::uint32_t from = core_[next];
      searched[next] = true;
      const std::array start{ops::Start{from, 0}};
      by_length_.run(start);
      double farthest_of = 0;
      std::uint32_t end = from;
      for (const std::uint32_t node : by_length_.reached()) {
        const double there = node == from ? 0 : by_length_.cost(node) + hangs(node);
        if (!(there > farthest_of)) continue;
        farthest_of = there;
        end = node;
      }
      if (hangs(from) + farthest_of > reach) {
        reach = hangs(from) + farthest_of;
        best = {from, end};
      }
      // From a node u one reaches as far as from here, and the way here more.
      double most = 0;
      for (std::size_t i = 0; i < core_.size(); ++i) {
        const std::uint32_t node = core_[i];
        bound[i] = std::min(
            bound[i], hangs(node) + by_length_.cost(node) + std::max(farthest_of, hangs(from)));
        if (searched[i] || !(bound[i] > most)) continue;
        most = bound[i];
        next = i;
      }
      gap = std::max(0.0, most - reach);
      if (gap <= nothing_more * reach) {
        gap = 0;
        break;
      }
    }
    return best;
  }

  std::vector<Step> core_way(std::uint32_t from, std::uint32_t to) {
    const std::array start{ops::Start{from, 0}};
    by_cost_.run(start);
    return by_cost_.way_to(to);
  }

  /// How many steps to cut at the beginning of a path: up to the branching node whose disk leaves
  /// most of `trim` radii when what protrudes from it is taken away. In a corner this grows up to
  /// the node where the corner begins.
  std::size_t overhang(std::span<const Step> steps) const {
    double reach = axis_.nodes[tail_of(axis_, steps.front())].disk.radius;
    double most = 0;
    std::size_t cut = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      reach += lengths_[steps[i].edge];
      const std::uint32_t node = head_of(axis_, steps[i]);
      if (incidence_.degree(node) < 3) continue;
      const double radius = axis_.nodes[node].disk.radius;
      const double left = (1 + options_.trim) * radius - reach;
      if (left < 0) break;
      if (left <= most) continue;
      most = left;
      cut = i + 1;
    }
    return cut;
  }

  std::vector<Step> trimmed(std::vector<Step> steps) const {
    if (!(options_.trim > 0) || steps.empty()) return steps;
    const std::size_t first = overhang(steps);
    std::vector<Step> back = steps;
    reverse(back);
    const std::size_t last = overhang(back);
    if (first + last >= steps.size()) return steps;
    return {steps.begin() + static_cast<std::ptrdiff_t>(first),
            steps.end() - static_cast<std::ptrdiff_t>(last)};
  }

  const MedialAxis& axis_;
  const MainPathOptions& options_;
  const Incidence incidence_;
  std::vector<double> lengths_;
  std::vector<double> core_lengths_, core_costs_;  ///< of edges; infinite outside the core
  ops::Search by_length_, by_cost_;                ///< in the core; they serve all parts
  std::vector<Hanging> hanging_;
  std::vector<std::uint32_t> degree_;  ///< in the core; 0: hanging, or the last node of a tree
  std::vector<bool> taken_;            ///< edges outside the core
  std::vector<std::uint32_t> part_, core_;
  std::size_t part_edges_ = 0;
};

}  // namespace

std::vector<AxisPath> main_paths(const MedialAxis& axis, const MainPathOptions& options) {
  return MainPaths(axis, options).run();
}

}  // namespace medial
