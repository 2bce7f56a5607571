#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "curve/bezier.h"
#include "medial/contour.h"
#include "medial/error.h"

namespace medial::curve_axis {

/// A point of the boundary; the shape is to the left of the tangent. Distances along the boundary
/// ("ways") are lengths, except in the fan of a reflex vertex: its single point has all normals in
/// between, and a way is an angle there.
struct BoundaryPoint {
  double u = 0;  ///< piece plus parameter on it; modulo the period
  Vec2 point;
  Vec2 tangent;      ///< unit length, towards increasing u
  double speed = 0;  ///< derivative of the way by u
  double along = 1;  ///< derivative of the boundary length by the way: 0 in a fan
  double turn =
      0;  ///< rotation of the tangent per way: the curvature, positive where the shape is convex
  Vec2 normal() const { return left_of(tangent); }  ///< inwards
  /// 1 - K R, which is positive before the centre of curvature; in general `along` - `turn` *
  /// radius.
  double slack(double radius) const { return along - turn * radius; }
};

/// A part of the boundary with one range of the parameter.
struct Piece {
  enum class Kind : std::uint8_t {
    curve,
    fan,  ///< of a reflex vertex
    gap,  ///< from one foot of a bridge to the other: each half continues the loop at its end
  };
  Kind kind = Kind::curve;
  curve::Bezier curve;
  Vec2 point, tangent;     ///< of a fan: the vertex, and the tangent of the arriving edge
  double from = 0;         ///< of a curve: the parameters of this part of it;
  double to = 1;           ///< of a fan: angles, turned from that tangent
  std::size_t source = 0;  ///< number of the contour's piece; of a gap: of its bridge
};

/// The point at a share of the way along a curve or a fan. `fan_way` is the way per radian in fans.
BoundaryPoint point_of(const Piece& piece, double share, double fan_way);

/// The pieces of a contour from normalized(), with fans at its reflex vertices.
std::vector<Piece> pieces_of(const Contour& contour);

/// The start of a branch, with both feet: see the first disk of the branch.
struct Tip {
  enum class Kind : std::uint8_t {
    maximum,  ///< of the curvature: both feet are one
    corner,   ///< convex: the disk has no radius
    arc,      ///< a circular arc, more curved than its neighbours; the feet are its ends
    bridge,   ///< the disk touches two loops
  };
  Kind kind = Kind::maximum;
  double left = 0, right = 0;
  double u = 0;  ///< in the middle, in [0, period)
};

/// A closed boundary as a function of one cyclic parameter: a counter-clockwise loop, or several
/// loops that gaps connect. Consecutive pieces of a loop join smoothly, in a fan, or in a convex
/// corner.
class Boundary {
 public:
  /// `spent` is a number of evaluations to start counting from.
  explicit Boundary(std::vector<Piece> pieces, std::uint64_t spent = 0);
  /// One loop from normalized().
  explicit Boundary(const Contour& contour) : Boundary(pieces_of(contour)) {}

  double period() const { return static_cast<double>(pieces_.size()); }
  /// The point at u. At a joint, that of the piece after or before it.
  BoundaryPoint at(double u) const;
  BoundaryPoint before(double u) const;
  /// The point at u. At a joint, that of the more curved piece.
  BoundaryPoint sharper_at(double u) const;
  /// The parameter about `way` further along the boundary (backwards if negative), to first order:
  /// uses the speed at u, and after each joint on the way the speed there, since the speed jumps at
  /// joints.
  double advanced(double u, double way) const;
  /// The way to the next joint, if fans begin or end or the curvature jumps there; infinite
  /// otherwise.
  double way_to_jump(double u, bool forward) const;
  /// By increasing u.
  const std::vector<Tip>& tips() const { return tips_; }
  Vec2 low() const { return low_; }
  Vec2 high() const { return high_; }
  double size() const { return distance(low_, high_); }
  /// Points on all pieces, with at most about this spacing along the boundary.
  std::vector<Vec2> samples(double spacing) const;
  const Piece& piece(double u) const { return pieces_[index_of(u)]; }
  /// The number of the contour's piece plus the parameter on it.
  double source_of(double u) const;

  /// The number of evaluations of pieces so far: a measure of the work.
  std::uint64_t evaluations() const { return evaluations_; }

  /// The value congruent to u in [base, base + period).
  double above(double u, double base) const;

 private:
  std::size_t index_of(double u) const;
  BoundaryPoint evaluate(std::size_t piece, double share) const;
  void find_frame();
  void find_jumps();
  void find_tips();
  void extend(Vec2 p);

  std::vector<Piece> pieces_;
  std::vector<bool> corner_, jump_;  ///< at the beginning of each piece
  std::vector<Tip> tips_;
  mutable std::uint64_t evaluations_ = 0;  ///< a boundary is used by one thread at a time
  Vec2 low_, high_;
  double way_ = 0;  ///< per radian in fans, and across gaps
};

/// The contour counter-clockwise, arcs as rational quadratics, closed.
Contour normalized(const Contour& contour);

/// Returns an error with the place if a contour has a cusp, or numbers that are not finite, so that
/// the method cannot follow it.
Status find_cusp(const Contour& contour);

}  // namespace medial::curve_axis
