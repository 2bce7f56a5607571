#include "methods/checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/arc.h"
#include "base/disjoint_sets.h"
#include "base/threads.h"
#include "base/tolerance.h"
#include "methods/problem.h"
#include "shape/limits.h"

namespace medial {
namespace {

/// Whether every component has one outer loop, and every hole is in a component.
bool has_one_outer_loop_each(const Shape& shape) {
  std::vector<bool> bounded(shape.component_count(), false);
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const std::uint32_t component = shape.component[i];
    if (component >= bounded.size()) return false;
    if (shape.hole[i]) continue;
    if (bounded[component]) return false;
    bounded[component] = true;
  }
  return true;
}

/// Whether the arrays of a hand-made shape fit together well enough to walk along them.
bool is_consistent(const Shape& shape) {
  const std::size_t loops = shape.component.size();
  if (shape.sources.size() != shape.points.size() || shape.hole.size() != loops ||
      shape.loop_begin.size() != loops + 1 || loops == 0 || shape.loop_begin.front() != 0 ||
      shape.loop_begin.back() != shape.points.size() ||
      !(shape.bulges.empty() || shape.bulges.size() == shape.points.size()))
    return false;
  if (!has_one_outer_loop_each(shape)) return false;
  for (const double bulge : shape.bulges)
    if (!(std::abs(bulge) <= 1)) return false;
  for (std::size_t i = 0; i < loops; ++i) {
    if (shape.loop_begin[i] > shape.loop_begin[i + 1] ||
        shape.loop_begin[i + 1] > shape.points.size())
      return false;
    const std::span<const Vec2> points = shape.loop(i);
    if (points.size() < (shape.bulges.empty() ? 3 : 2)) return false;
    double doubled = 0, size = 0;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const Vec2 start = points[j], end = points[j + 1 == points.size() ? 0 : j + 1];
      if (start == end) return false;
      const Vec2 a = start - points[0], b = end - points[0];
      doubled += cross(a, b);
      size += std::abs(a.x * b.y) + std::abs(a.y * b.x);
      if (!shape.bulges.empty())
        doubled += 2 * area_beside_chord({start, end, shape.bulges[shape.loop_begin[i] + j]});
    }
    // Rounding may reverse the orientation of a needle.
    const double rounding =
        static_cast<double>(points.size()) * std::numeric_limits<double>::epsilon() * size;
    if (!(shape.hole[i] ? doubled <= rounding : doubled >= -rounding)) return false;
  }
  return true;
}

/// The error if the method does not support the options, by the table.
std::optional<Error> refuse_untaken(const Options& options) {
  const MethodInfo& takes = info_of(options.method);
  if (options.exact && !takes.exact())
    return Error{
        ErrorCode::invalid_option,
        std::string("exact decisions are for the methods disks, biarc-dc, lee and auto, not ") +
            takes.name,
        {}};
  if (takes.exterior || !options.exterior) return std::nullopt;
  return Error{ErrorCode::invalid_option,
               std::string("the method ") + takes.name +
                   " does not compute the exterior: use the method disks",
               {}};
}

}  // namespace

std::optional<Error> refuse(const Options& options) {
  if (!(options.tolerance >= 0 && options.tolerance <= largest_relative_tolerance))
    return Error{ErrorCode::invalid_option, "the tolerance must be in [0, 1e-3]", {}};
  if (options.threads < 0 || options.threads > most_threads)
    return Error{ErrorCode::invalid_option, "the number of threads must be in [0, 1024]", {}};
  return std::nullopt;
}

std::optional<Error> refuse(const Shape& shape, const Options& options) {
  if (auto error = refuse(options)) return error;
  if (!(options.corner_angle >= 0 && options.corner_angle <= 10))
    return Error{ErrorCode::invalid_option, "the corner angle must be in [0, 10] degrees", {}};
  if (shape.points.empty()) return Error{ErrorCode::empty, "the shape is empty", {}};
  // Every point makes at most two sites, and every site bounds at most three nodes.
  if (shape.points.size() > std::numeric_limits<std::uint32_t>::max() / 8)
    return Error{ErrorCode::too_large, "the shape has more than 2^29 vertices", {}};
  if (auto error = beyond_limits(shape)) return error;
  if (!is_consistent(shape))
    return Error{ErrorCode::malformed, "the shape was not made by build_shape()", {}};
  return refuse_untaken(options);
}

bool has_arcs(const Shape& shape) {
  return std::any_of(shape.bulges.begin(), shape.bulges.end(), [](double b) { return b != 0; });
}

bool is_tiny_edge(const BulgeArc& local) {
  // The local frame is about one unit large. An angle of 2^-50 (some roundings) over 2^-26 has half
  // the square 2^-49, which is less than the tolerance; so is half the square of 2^-26.
  constexpr double smallest = 0x1p-26;
  return squared_norm(local.chord()) < smallest * smallest ||
         std::abs(curvature(local)) * smallest > 1;
}

bool is_almost_smooth(site::Joint joint, const BulgeArc& before, const BulgeArc& after,
                      double tolerance) {
  if (before.bulge == 0 && after.bulge == 0) return false;
  const Vec2 arriving = end_tangent(before), leaving = start_tangent(after);
  if (!(dot(arriving, leaving) > 0)) return false;
  const double turn = cross(arriving, leaving), sine = std::abs(turn);
  const double curved = std::max(std::abs(curvature(before)), std::abs(curvature(after)));
  if (joint == site::Joint::smooth) {
    const double bend = std::abs(curvature(before) - curvature(after));
    const double reach = sine * sine / (2 * tolerance);
    return turn < 0 && 2 * reach > bend && curved + reach > 1;  // no disk is larger
  }
  return sine * sine <= 2 * tolerance * curved ||
         sine * std::min(norm(before.chord()), norm(after.chord())) <= tolerance;
}

namespace {

/// Calls look(point, before, after) for all points of a shape with arcs, with the edges before and
/// after it in local units. O(n).
template <class Look>
void for_each_joint(const Problem& problem, const Look& look) {
  const Shape& shape = problem.shape;
  if (shape.bulges.empty()) return;
  for (std::size_t l = 0; l < shape.loop_count(); ++l) {
    const site::LoopEdges loop(shape, l, problem.frame);
    const auto edge = [&](std::uint32_t i) -> BulgeArc {
      return {loop.local(i), loop.local(loop.next(i)), loop.bulge(i)};
    };
    BulgeArc before = edge(loop.size() - 1);
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      const BulgeArc after = edge(i);
      look(loop.begin() + i, before, after);
      before = after;
    }
  }
}

}  // namespace

std::vector<std::size_t> tiny_edges(const Problem& problem) {
  std::vector<std::size_t> found;
  for_each_joint(problem, [&](std::size_t point, const BulgeArc&, const BulgeArc& after) {
    if (is_tiny_edge(after)) found.push_back(point);
  });
  return found;
}

std::vector<std::size_t> almost_smooth_joints(const Problem& problem,
                                              const site::SiteNumbers& numbers) {
  std::vector<std::size_t> found;
  for_each_joint(problem, [&](std::size_t point, const BulgeArc& before, const BulgeArc& after) {
    if (is_almost_smooth(numbers.joints[point], before, after, problem.fine_tolerance))
      found.push_back(point);
  });
  return found;
}

namespace {

/// The findings of has_right_topology() in a block of edges.
struct TopologyFindings {
  std::uint64_t joined = 0;
  bool stays = true;                  ///< no edge leaves its component
  std::vector<std::uint32_t> others;  ///< between blocks; joined after all threads have finished
  /// The number of edges of each component, in runs, as most blocks are in one component.
  std::vector<std::pair<std::uint32_t, std::uint64_t>> edges;
};

}  // namespace

template <class E>
bool has_right_topology(const Shape& shape, std::span<const Node> nodes, std::span<const E> edges) {
  struct Count {
    std::uint64_t nodes = 0, edges = 0, holes = 0;
  };
  std::vector<Count> counts(shape.component_count());
  for (std::size_t i = 0; i < shape.loop_count(); ++i)
    if (shape.hole[i]) ++counts[shape.component[i]].holes;
  for (const Node& node : nodes) {
    if (node.component >= counts.size()) return false;
    ++counts[node.component].nodes;
  }
  // Most edges connect nodes whose numbers are close to the edge's. Each thread joins these within
  // a block of nodes.
  constexpr std::size_t block = 1 << 14;
  // Each component has one node more than edges, so the numbers drift apart.
  const double share = static_cast<double>(edges.size()) / static_cast<double>(nodes.size());
  const auto block_of = [&](std::uint32_t node) {
    return static_cast<std::uint32_t>(share * node) / block;
  };
  DisjointSets parts(nodes.size());
  const auto look_at = [&](std::size_t e, TopologyFindings& found) {
    const auto [from, to] = edges[e].node;
    const std::uint32_t component = nodes[from].component;
    if (component != nodes[to].component) found.stays = false;
    if (counts.size() > 1) {
      if (found.edges.empty() || found.edges.back().first != component)
        found.edges.emplace_back(component, 0);
      ++found.edges.back().second;
    }
    if (edges.size() <= block || (block_of(from) == e / block && block_of(to) == e / block))
      found.joined += parts.join_uncounted(from, to) ? 1 : 0;
    else
      found.others.push_back(static_cast<std::uint32_t>(e));
  };
  if (counts.size() == 1) counts[0].edges = edges.size();
  std::uint64_t joined = 0;
  bool stays = true;
  const auto add = [&](const TopologyFindings& found) {
    stays = stays && found.stays;
    joined += found.joined;
    for (const auto& [component, count] : found.edges) counts[component].edges += count;
    for (const std::uint32_t e : found.others)
      joined += parts.join_uncounted(edges[e].node[0], edges[e].node[1]) ? 1 : 0;
  };
  if (edges.size() <= block) {  // small shapes would notice the cost of a list
    TopologyFindings all;
    for (std::size_t e = 0; e < edges.size(); ++e) look_at(e, all);
    add(all);
  } else {
    for (const TopologyFindings& found : in_blocks<TopologyFindings>(edges.size(), block, look_at))
      add(found);
  }
  if (!stays) return false;
  // No edge leaves its component and each component has a node, so each is one part; a connected
  // graph has edges - nodes + 1 independent cycles.
  return nodes.size() - joined == counts.size() &&
         std::all_of(counts.begin(), counts.end(), [](const Count& count) {
           return count.nodes > 0 && count.edges + 1 == count.nodes + count.holes;
         });
}

template bool has_right_topology(const Shape&, std::span<const Node>, std::span<const Edge>);
template bool has_right_topology(const Shape&, std::span<const Node>, std::span<const VoronoiEdge>);

}  // namespace medial
