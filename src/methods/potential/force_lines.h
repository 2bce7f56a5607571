#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "methods/potential/force.h"
#include "methods/potential/valley_graph.h"

namespace medial::potential {

/// A force line, from its start to its end at a minimum or in a known valley.
struct Trail {
  std::vector<ValleyPoint> points;
  std::uint32_t end = no_point;  ///< a point of the skeleton; none: the line has no end
};

/// v / |v|; (0, 0) if v is (0, 0).
Vec2 unit(Vec2 v);

bool contains(const Box& box, Vec2 p);

/// The unit direction of a valley at a place near its floor: the eigenvector of the larger
/// eigenvalue of the derivatives, without the mere growth along the force. The other eigenvalue,
/// across the valley, is negative.
Vec2 valley_direction(const Force& force, double order);

/// Follows force lines of one order, and adds them to a skeleton, in which they end.
class ForceLines {
 public:
  /// `budget` is the number of forces that may be computed; after that, lines end early.
  ForceLines(const Charges& charges, const SkeletonOptions& options, ValleyGraph& graph,
             std::uint64_t budget)
      : options_(options), graph_(graph), evaluator_(charges), budget_(budget) {}

  Force force_at(Vec2 p, double& radius) {
    ++graph_.skeleton.forces;
    radius = evaluator_.place(p).distance;
    return evaluator_.direction(options_.order);
  }
  std::uint64_t work() const { return evaluator_.work(); }
  double distance_at(Vec2 p) { return evaluator_.place(p).distance; }
  double reach(double radius) const { return graph_.reach(radius); }
  bool exhausted() const {
    return graph_.skeleton.forces > budget_ || evaluator_.work() > options_.most_work ||
           (options_.cancel != nullptr && options_.cancel->load(std::memory_order_relaxed));
  }

  /// Whether the force is lost in noise: between parallel sides it falls below the rounding errors
  /// as the order grows, or below the error of the chords of arcs.
  bool lost(const Force& force) const {
    return norm(force.force) <
           std::max(least_force, options_.bend) * force.potential(options_.order);
  }

  /// One step along the force line, from p to a point q at about the distance `step`. The force at
  /// q points along q - p, or in the opposite direction past a minimum: an implicit step, which
  /// stays in narrow valleys. Returns false if no such point is found.
  bool advance(Vec2 p, Vec2 direction, double step, Vec2& q, Force& force, double& radius);

  /// The minimum (or saddle) that Newton's method finds from p without leaving the disk of this
  /// radius around it.
  std::optional<ValleyPoint> critical_point(
      Vec2 p, bool minimum, double furthest = std::numeric_limits<double>::infinity());

  /// Moves p straight to the floor of a narrow valley, and turns the direction along it. Returns
  /// false if the valley is not narrow.
  bool settle(Vec2& p, double& radius, Force& force, Vec2& direction);

  enum class Start : std::uint8_t {
    downward,  ///< in the direction of the force
    either,    ///< also against the force, until it turns
  };
  /// Follows the force from p, initially in `direction`. If `share` is above 0, the line ends when
  /// it is this close to a known valley, in units of a step.
  Trail follow(Vec2 p, Vec2 direction, double share, Start start = Start::downward);

  /// Adds a line to the skeleton; it starts at the point `from`.
  void keep(std::uint32_t from, const Trail& trail);

  static constexpr double merge_share = 0.25;

 private:
  class Walk;

  /// The least significant force, as a share of the force next to one side alone.
  static constexpr double least_force = 100 * Evaluator::far_field;

  const SkeletonOptions& options_;
  ValleyGraph& graph_;
  Evaluator evaluator_;
  std::uint64_t budget_;
};

}  // namespace medial::potential
