#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "curve/bezier.h"
#include "medial/contour.h"
#include "medial/error.h"

namespace medial::curve_axis {

/// A point of the boundary; the shape lies to the left of the tangent.
struct BoundaryPoint {
  double u = 0;  ///< parameter: piece plus parameter on it; any multiple of the period may be added
  Vec2 point;
  Vec2 tangent;                                     ///< unit length, towards increasing u
  double speed = 0;                                 ///< length of boundary by u
  double curvature = 0;                             ///< positive where the shape is convex
  Vec2 normal() const { return left_of(tangent); }  ///< inwards
};

/// A smooth closed curve, counter-clockwise, as a function of one cyclic parameter.
class SmoothBoundary {
 public:
  /// Requires pieces that join smoothly: see find_roughness().
  explicit SmoothBoundary(const Contour& contour);

  double period() const { return static_cast<double>(pieces_.size()); }
  BoundaryPoint at(double u) const;
  /// The parameter about `length` further along the boundary (backwards if negative), to the first
  /// order: with the speed at u, and behind each joint that lies on the way with the speed there,
  /// for the parameter's speed jumps where pieces join.
  double advanced(double u, double length) const;
  /// Positive local maxima of curvature by increasing u in [0, period).
  const std::vector<double>& maxima() const { return maxima_; }
  Vec2 low() const { return low_; }
  Vec2 high() const { return high_; }
  double size() const { return distance(low_, high_); }

  /// How often a piece was evaluated so far: the work done.
  std::uint64_t evaluations() const { return evaluations_; }

  /// The value congruent to u in [base, base + period).
  double above(double u, double base) const;

 private:
  void find_maxima();
  void extend(Vec2 p);

  std::vector<curve::Bezier> pieces_;
  std::vector<double> maxima_;
  mutable std::uint64_t evaluations_ = 0;  ///< one thread at a time has a boundary
  Vec2 low_, high_;
};

/// The contour counter-clockwise, arcs as rational quadratics, closed.
Contour normalized(const Contour& contour);

/// What makes a contour not smooth enough, with the place; success if nothing does.
Status find_roughness(const Contour& contour);

}  // namespace medial::curve_axis
