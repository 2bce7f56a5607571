#pragma once

// The level sets of the clearance, from an axis.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "axis/curve.h"
#include "medial/axis.h"
#include "medial/query.h"
#include "medial/shape.h"
#include "ops/half_edges.h"

namespace medial::ops {

/// A closed level curve of the clearance, with larger clearances on its left.
struct OffsetRing {
  Ring ring;
  std::uint32_t node = 0;  ///< a node of the axis in the region on the left
  /// A site that the loop is an offset of; no_site for a circle around a node without edges.
  std::uint32_t site = 0;
};

/// Walks around an exact axis, the axis on its left and the boundary on its right.
class LevelWalk {
 public:
  /// O(n). Keeps a reference to the axis.
  explicit LevelWalk(const MedialAxis& axis);

  /// The smallest radius along an edge, minus the axis's tolerance.
  double lowest(std::uint32_t edge) const { return lowest_[edge]; }

  /// The approximate number of points of the loops of all levels.
  std::uint64_t points_at(std::span<const double> levels) const;

  /// Calls take(k, loops) for every level from the last to the first. Levels increase strictly. A
  /// node is inside if its radius exceeds the level by more than the tolerance, an edge if its
  /// lowest radius does. So places exactly at the level are outside, in spite of rounding.
  template <class Take>
  void run(std::span<const double> levels, const Take& take) {
    crossed_.clear();
    waiting_ = crossings_of(levels);
    std::stable_sort(waiting_.begin(), waiting_.end(),
                     [](const Crossing& a, const Crossing& b) { return a.end < b.end; });
    for (std::size_t k = levels.size(); k-- > 0;) {
      go_down_to(k);
      take(k, loops_at(levels[k]));
    }
  }

 private:
  struct Face {
    HalfEdge last;  ///< after it, the right site changes, if it changes anywhere
    double lowest;  ///< of its edges
  };
  /// The levels that an edge crosses: those in [lowest, largest of its radii).
  struct Crossing {
    std::uint32_t edge;
    std::size_t begin, end;
  };
  class RingBuilder;
  enum class Part : std::uint8_t { start, end };

  std::vector<Crossing> crossings_of(std::span<const double> levels) const;
  void go_down_to(std::size_t k);
  std::vector<OffsetRing> loops_at(double level);
  void find_crossing(std::uint32_t edge, double level);
  OffsetRing loop_from(HalfEdge first, double level);
  OffsetRing loop_around(HalfEdge last, double level) const;
  void pass_node(HalfEdge half, double level, RingBuilder& builder) const;
  bool pass_joints(std::uint32_t before, std::uint32_t after, const Disk& disk, double level,
                   RingBuilder& builder) const;
  Vec2 offset_at(std::uint32_t site, const Disk& disk, double level, Part part) const;
  double height(std::uint32_t node) const {
    return axis_.nodes[node].disk.radius - axis_.tolerance;
  }
  /// Whether a walk along the half edge leaves the region above the level.
  bool falls(HalfEdge half, double level) const {
    return !(height(halves_.to(half)) > level) || !(lowest_[half / 2] > level);
  }

  const MedialAxis& axis_;
  const HalfEdges halves_;
  double largest_ = 0;                ///< largest absolute coordinate
  std::vector<double> lowest_;        ///< of each edge
  std::vector<Face> faces_;           ///< one for each loop of the boundary that has edges
  std::vector<std::uint32_t> alone_;  ///< nodes without edges
  std::vector<Crossing> waiting_;     ///< edges below the current level, the highest one last
  std::vector<Crossing> crossed_;     ///< edges that cross it, in the order of the edges
  std::vector<Vec2> rise_;            ///< where each half edge rises above the current level
  std::vector<bool> risen_;           ///< whether it does, and has not been walked yet
};

}  // namespace medial::ops
