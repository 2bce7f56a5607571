#pragma once

// The curves on which an axis has a given radius on its sides: the level sets of the clearance.

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

/// A closed curve of all points of one clearance, with the larger clearance on its left.
struct OffsetRing {
  Ring ring;
  std::uint32_t node = 0;  ///< of the axis: in the region on the left
  /// One that the loop is an offset of; no_site for a circle around a node without edges.
  std::uint32_t site = 0;
};

/// Walks around an exact axis, the axis on its left and the boundary on its right.
class LevelWalk {
 public:
  /// O(n). Keeps a reference to the axis.
  explicit LevelWalk(const MedialAxis& axis);

  /// The smallest radius along an edge, less the axis's tolerance.
  double lowest(std::uint32_t edge) const { return lowest_[edge]; }

  /// Calls take(k, loops) for every level from the last to the first. Levels increase strictly.
  /// A node is inside where its radius exceeds the level by more than the tolerance, an edge where
  /// its lowest radius does: so what is exactly at the level is outside, whatever rounding did.
  template <class Take>
  void run(std::span<const double> levels, const Take& take) {
    bin_crossings(levels);
    for (std::size_t k = levels.size(); k-- > 0;) take(k, loops_at(levels[k], k));
  }

 private:
  struct Face {
    HalfEdge last;  ///< behind which the right site is another one, if that is anywhere
    double lowest;  ///< of its edges
  };
  class RingBuilder;
  enum class Part : std::uint8_t { start, end };

  void bin_crossings(std::span<const double> levels);
  std::vector<OffsetRing> loops_at(double level, std::size_t k);
  void find_crossing(std::uint32_t edge, double level);
  OffsetRing loop_from(HalfEdge first, double level);
  OffsetRing loop_around(HalfEdge last, double level) const;
  void pass_node(HalfEdge half, double level, RingBuilder& builder) const;
  bool pass_joints(std::uint32_t before, std::uint32_t after, double level,
                   RingBuilder& builder) const;
  Vec2 offset_at(std::uint32_t site, const Disk& disk, double level, Part part) const;
  double height(std::uint32_t node) const {
    return axis_.nodes[node].disk.radius - axis_.tolerance;
  }
  /// Whether a walk along the half edge leaves what is above the level.
  bool falls(HalfEdge half, double level) const {
    return !(height(halves_.to(half)) > level) || !(lowest_[half / 2] > level);
  }

  const MedialAxis& axis_;
  const HalfEdges halves_;
  std::vector<double> lowest_;        ///< of each edge
  std::vector<Face> faces_;           ///< one for each loop of the boundary that has edges
  std::vector<std::uint32_t> alone_;  ///< nodes without edges
  std::vector<std::uint32_t> bin_begin_, bin_edges_;  ///< of each level: the edges that cross it
  std::vector<Vec2> rise_;   ///< where each half edge rises above the level under way
  std::vector<bool> risen_;  ///< and whether it does, and was not walked yet
};

}  // namespace medial::ops
