#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "methods/potential/force.h"
#include "methods/potential/valley_graph.h"

namespace medial::potential {

/// A force line, from its start to where it ends: at a minimum, or in a valley that is known.
struct Trail {
  std::vector<ValleyPoint> points;
  std::uint32_t end = no_point;  ///< a point of the skeleton; none: it ends nowhere
};

/// v / |v|; (0, 0) for that.
Vec2 unit(Vec2 v);

bool contains(const Box& box, Vec2 p);

/// The unit direction of the valley at a place near its floor: the eigenvector of the derivatives'
/// larger eigenvalue, after what is but growth along the force. The other one, across the valley,
/// is negative.
Vec2 valley_direction(const Force& force, double order);

/// Force lines of one order, that end in a skeleton and become part of it.
class ForceLines {
 public:
  /// `budget`: how many forces may be computed; lines end early beyond.
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

  /// Whether the force cannot be distinguished from none: between parallel sides it falls below the
  /// arithmetic's noise as the order grows, or below what the chords of arcs add.
  bool lost(const Force& force) const {
    return norm(force.force) <
           std::max(least_force, options_.bend) * force.potential(options_.order);
  }

  /// One step along the force line, from p to a point q at the distance `step` about: the force at
  /// q points along q - p, or against it past a minimum. That is an implicit step, so it stays in
  /// narrow valleys. False where no such point is found.
  bool advance(Vec2 p, Vec2 direction, double step, Vec2& q, Force& force, double& radius);

  /// The minimum (or the saddle) that Newton's method finds from p, without ever leaving the disk
  /// of this radius around it.
  std::optional<ValleyPoint> critical_point(
      Vec2 p, bool minimum, double furthest = std::numeric_limits<double>::infinity());

  /// Moves p straight to the floor of a narrow valley, and turns the direction along it. False
  /// where the valley is not narrow.
  bool settle(Vec2& p, double& radius, Force& force, Vec2& direction);

  enum class Start : std::uint8_t {
    downward,  ///< as the force leads
    either,    ///< against the force, too, until it turns
  };
  /// Follows the force from p, at first in `direction`. With a `share` above 0 the line ends where
  /// it comes as near to a known valley, in units of a step.
  Trail follow(Vec2 p, Vec2 direction, double share, Start start = Start::downward);

  /// Makes a line part of the skeleton; `from` is the point that it leaves.
  void keep(std::uint32_t from, const Trail& trail);

  static constexpr double merge_share = 0.25;

 private:
  class Walk;

  /// What a force must be, as a share of what it would be beside one side alone.
  static constexpr double least_force = 100 * Evaluator::far_field;

  const SkeletonOptions& options_;
  ValleyGraph& graph_;
  Evaluator evaluator_;
  std::uint64_t budget_;
};

}  // namespace medial::potential
