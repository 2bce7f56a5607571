#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "methods/potential/force.h"
#include "methods/potential/region.h"

namespace medial::potential {

/// A point of a potential valley.
struct ValleyPoint {
  enum class Kind : std::uint8_t {
    corner,
    valley,
    minimum,
    saddle,
    junction  ///< of the medial axis: a branching, or a leaf that is not a corner
  };
  Vec2 place;
  double radius = 0;  ///< distance to the boundary
  Vec2 tangent;       ///< unit vector along the valley; (0, 0) at a corner
  Kind kind = Kind::valley;
};

/// Whether a point stays in place when successors are computed.
inline bool is_fixed(const ValleyPoint& point) {
  return point.kind == ValleyPoint::Kind::corner || point.kind == ValleyPoint::Kind::junction;
}

/// Valleys of the potential as a graph.
struct Skeleton {
  std::vector<ValleyPoint> points;
  std::vector<std::array<std::uint32_t, 2>> links;  ///< from the higher potential to the lower one
  std::uint64_t minima = 0;
  std::uint64_t forces = 0;  ///< number of forces computed
  std::uint64_t work = 0;    ///< their cost: Evaluator::work()
  double order = 1;          ///< of the potential
  bool whole = true;         ///< connected, with one cycle for each hole
};

struct SkeletonOptions {
  double order = 1;  ///< of the potential
  double step = 0;   ///< longest, in units of the frame
  double bend = 0;   ///< the slope that chords of arcs may give to the floor of a valley
  /// The least turn, in radians, of bends from which lines start. A bend that turns by less than a
  /// quarter ends no valley of low order, but may end a branch of the axis.
  double least_turn = 0.25;
  /// Returns the exact axis, as the limit of high orders, along which parts that lines leave apart
  /// are connected. Without it they stay apart. Called at most once.
  std::function<const Skeleton*()> axis = nullptr;
  /// The limit on the cost of forces; parts that are not connected by then stay apart.
  std::uint64_t most_work = std::numeric_limits<std::uint64_t>::max();
  const std::atomic<bool>* cancel = nullptr;  ///< ends the work early: the skeleton is not whole
};

/// MAT-Newtonian-Polygon ([ahuja1997], Section 4.1.3): force lines from the convex corners down to
/// the minima of the potential, and from the saddles between the minima down to both sides. The
/// potential has no maxima, so minima and saddles make a connected graph with one cycle per hole:
/// the paper's traversal from every minimum. Parts that it leaves unconnected are connected through
/// the saddles at which lines from adjacent places of the exact axis diverge.
Skeleton trace_valleys(const Region& region, const Charges& charges,
                       const SkeletonOptions& options);

}  // namespace medial::potential
