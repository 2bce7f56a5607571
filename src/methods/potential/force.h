#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "methods/potential/charges.h"
#include "methods/potential/integral.h"

namespace medial::potential {

constexpr int largest_order = 4096;

/// The n-force at a point and its derivatives by the point's coordinates, in units in which the
/// distance d to the nearest charge is 1: the force itself is `force` / d^n, its derivatives are
/// (xx, xy; xy, yy) / d^(n + 1). So no order overflows. The force is minus the gradient of the
/// potential (7) divided by n, so the derivatives are symmetric, and their trace is -n times the
/// potential of order n + 2.
struct Force {
  Vec2 force;
  double xx = 0, xy = 0, yy = 0;

  /// The potential of order + 2, in the same units; approximately the force next to one side alone.
  double potential(double order) const { return -(xx + yy) / order; }
  double determinant() const { return xx * yy - xy * xy; }
  Vec2 derivative(Vec2 v) const { return {xx * v.x + xy * v.y, xy * v.x + yy * v.y}; }
  /// The force at `way` from here, in units of the distance to the nearest charge, which changes by
  /// the factor `ratio`. First order; the derivatives stay the same.
  Force moved(Vec2 way, double ratio, double order) const {
    const double scale = std::pow(ratio, order), steep = scale * ratio;
    return {scale * (force + derivative(way)), steep * xx, steep * xy, steep * yy};
  }
};

/// Forces of all charges together ([ahuja1997], (5), (6), (8), (9)).
///
/// Each piece adds, with x along it, y across it, r^2 = x^2 + y^2 and n the order,
/// ([r^-n] / n, y J(n)), where J(n), the integral of dx / r^(n + 2), follows from J(n - 2) by the
/// recurrence (9), or at one high order alone from HighOrder, in the same time for any. The
/// recurrence is stable upward while |y| is not small against the distance to the nearest charge;
/// other pieces are passed sideways (they lie on the point's own line, nearly), and have J(n) from
/// SteepTail, and so have all that it takes at one order of 12 or more alone. Pieces far away are
/// summed by their moments, or left out, as their bounds allow: the error is below `far_field` in
/// the units of Force. Keeps a reference to the charges, and scratch memory of its own: use one
/// evaluator a thread.
class Evaluator {
 public:
  explicit Evaluator(const Charges& charges) : charges_(charges) {}

  /// Sets the place of the next forces. Returns the nearest charge.
  Charges::Nearest place(Vec2 p);

  /// The n-force at the place. Requires that no charge is at the place, and order in [1,
  /// largest_order].
  Force force(double order);
  /// The same if only its direction matters: the error is at most rough_share of its size, or the
  /// error of force().
  Force direction(double order);
  /// Computes the forces of the orders first, first + 1, ... as many as `forces` has, in one pass.
  void forces(int first, std::span<Force> forces);
  struct Field {
    Force force;
    double log_potential = 0;  ///< the logarithm of the potential (7)
  };
  /// The force and the potential of one order at the place. Requires order in [1, largest_order].
  Field field(double order);

  static constexpr double far_field = 1e-7;
  static constexpr double rough_field = 5e-4, rough_share = 2e-3;

  /// The cost of all forces: the number of charges that were summed one by one, plus
  /// `cost_of_force` per force and `cost_of_set` per set that was summed by moments. Independent of
  /// the machine.
  std::uint64_t work() const { return work_; }
  static constexpr std::uint64_t cost_of_force = 16, cost_of_set = 12;

 private:
  /// Chooses the pieces to sum one by one and the sets to sum by moments, for orders in [low,
  /// high].
  void gather(double low, double high);
  void add_far(double order, Force& sum) const;
  /// The logarithm of the potential of an order up to 2, piece by piece.
  double low_log_potential(double order) const;
  /// Adds the forces of the near pieces for the orders start, start + 2, ... from `low` on;
  /// forces[i] is that of order low + i.
  void sum(double start, double low, std::span<Force> forces);
  /// Adds the force of the near pieces for one order: without the recurrence if the integral itself
  /// is as fast.
  void sum_one(double order, Force& sum);
  void sum_steep(std::uint32_t piece, double start, double low, std::span<Force> forces) const;

  struct Range {
    std::uint32_t begin, end;
  };
  const Charges& charges_;
  Vec2 place_;
  double inverse_ = 1;             ///< of the distance to the nearest charge
  double error_ = far_field;       ///< that the far field may add
  std::optional<LowOrder> start_;  ///< start of the recurrence at fractional orders
  std::optional<SteepTail> tail_;  ///< of the last order that was computed alone
  std::optional<HighOrder> high_;
  std::uint64_t work_ = 0;
  std::vector<Range> near_;
  std::array<std::vector<std::uint32_t>, Moments::degree + 1>
      far_;  ///< sets by the degree that is sufficient
};

}  // namespace medial::potential
