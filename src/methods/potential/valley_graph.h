#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "base/disjoint_sets.h"
#include "methods/potential/skeleton.h"

namespace medial::potential {

constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();

/// The links of a skeleton near a place: a hash of cells whose size depends on the distance to the
/// boundary, as the length of steps does.
class LinkIndex {
 public:
  void add(std::uint32_t link, Vec2 a, Vec2 b, double scale);
  /// The links in the cells that meet the square of size `reach` around p; some occur more than
  /// once.
  template <class Take>
  void near(Vec2 p, double reach, double scale, const Take& take) const;

 private:
  template <class Visit>
  static void visit(int level, Vec2 low, Vec2 high, const Visit& act);
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// A growing skeleton: its points by place, its connected parts, and the minima.
class ValleyGraph {
 public:
  /// `step` is the longest step.
  explicit ValleyGraph(double step) : limit_(step) {}

  /// The length of a step at the distance `radius` from the boundary.
  double reach(double radius) const { return std::min(limit_, radius); }

  std::uint32_t add_point(const ValleyPoint& point);
  void add_link(std::uint32_t from, std::uint32_t to);
  /// The minimum at this place, known or newly added.
  std::uint32_t minimum_at(const ValleyPoint& point);

  /// The valley that a line joins at q if it is closer than `share` of a step: the valley's next
  /// point downward. It must lead in the same direction, unless `any_way`.
  std::uint32_t joined(Vec2 q, double radius, Vec2 direction, double share, bool any_way) const;

  /// The valley that the step from p to q crosses: the nearer end of its link.
  std::uint32_t crossed(Vec2 p, Vec2 q, double radius) const;

  /// The places along a way between two connected points, including both ends. O(points).
  std::vector<Vec2> way(std::uint32_t from, std::uint32_t to) const;
  std::uint32_t part(std::uint32_t point) { return parts_.find(point); }
  bool connected(std::uint32_t a, std::uint32_t b) { return parts_.find(a) == parts_.find(b); }
  std::size_t parts() const { return parts_.count(); }
  std::size_t cycles() const { return skeleton.links.size() + parts() - skeleton.points.size(); }

  Skeleton skeleton;

 private:
  double limit_;
  LinkIndex links_;
  std::vector<std::uint32_t> first_;  ///< of each point, an end of a link: 2 link + side
  std::vector<std::uint32_t> next_;   ///< of each end of a link, the next one at its point
  DisjointSets parts_;                ///< connected points
  std::vector<std::uint32_t> minima_;
};

}  // namespace medial::potential
