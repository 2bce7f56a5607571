#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "curve/bezier.h"
#include "medial/contour.h"
#include "medial/error.h"

namespace medial::curve_axis {

/// A point of the boundary; the shape lies to the left of the tangent. Ways are lengths, but in the
/// fan of a reflex vertex, whose one point has all normals in between: there a way is an angle.
struct BoundaryPoint {
  double u = 0;  ///< parameter: piece plus parameter on it; any multiple of the period may be added
  Vec2 point;
  Vec2 tangent;      ///< unit length, towards increasing u
  double speed = 0;  ///< way by u
  double along = 1;  ///< length of boundary by way: 0 in a fan
  double turn = 0;   ///< of the tangent by way: the curvature, positive where the shape is convex
  Vec2 normal() const { return left_of(tangent); }  ///< inwards
  /// Along less turn times radius: 1 - K R, positive before the centre of curvature.
  double slack(double radius) const { return along - turn * radius; }
};

/// A part of the boundary that one parameter runs along.
struct Piece {
  enum class Kind : std::uint8_t {
    curve,
    fan,  ///< of a reflex vertex
    gap,  ///< from one foot of a bridge to the other: on either half the loop of its end goes on
  };
  Kind kind = Kind::curve;
  curve::Bezier curve;
  Vec2 point, tangent;     ///< of a fan: the vertex, and the tangent that arrives there
  double from = 0;         ///< of a curve: the parameters of this part of it;
  double to = 1;           ///< of a fan: angles, turned from that tangent
  std::size_t source = 0;  ///< number of the contour's piece; of a gap: of its bridge
};

/// The point at a share of the way along a curve or a fan. `fan_way`: of a radian.
BoundaryPoint point_of(const Piece& piece, double share, double fan_way);

/// The pieces of a contour as normalized() gives it, with fans at its reflex vertices.
std::vector<Piece> pieces_of(const Contour& contour);

/// Where a branch begins, with both feet: see the branch's first disk.
struct Tip {
  enum class Kind : std::uint8_t {
    maximum,  ///< of the curvature: both feet are one
    corner,   ///< convex: the disk has no radius
    arc,      ///< a circular arc, more curved than what is next to it: from its end to its end
    bridge,   ///< the disk touches two loops
  };
  Kind kind = Kind::maximum;
  double left = 0, right = 0;
  double u = 0;  ///< in the middle, in [0, period)
};

/// A closed boundary as a function of one cyclic parameter: a loop counter-clockwise, or several
/// that gaps connect. Pieces of a loop join in one direction, in a fan or in a convex corner.
class Boundary {
 public:
  /// `spent`: evaluations that count as done already.
  explicit Boundary(std::vector<Piece> pieces, std::uint64_t spent = 0);
  /// One loop, as normalized() gives it.
  explicit Boundary(const Contour& contour) : Boundary(pieces_of(contour)) {}

  double period() const { return static_cast<double>(pieces_.size()); }
  /// In a joint, as the piece behind it has it, or as the one before.
  BoundaryPoint at(double u) const;
  BoundaryPoint before(double u) const;
  /// In a joint, as the more curved one of the two has it.
  BoundaryPoint sharper_at(double u) const;
  /// The parameter about this way further along the boundary (backwards if negative), to the first
  /// order: with the speed at u, and behind each joint that lies on the way with the speed there,
  /// for the parameter's speed jumps where pieces join.
  double advanced(double u, double way) const;
  /// The way to the next joint where fans begin or end or the curvature jumps; infinite if that is
  /// not the next one.
  double way_to_jump(double u, bool forward) const;
  /// By increasing u.
  const std::vector<Tip>& tips() const { return tips_; }
  Vec2 low() const { return low_; }
  Vec2 high() const { return high_; }
  double size() const { return distance(low_, high_); }
  /// Points of all pieces, no farther apart along the boundary than this, nearly.
  std::vector<Vec2> samples(double spacing) const;
  const Piece& piece(double u) const { return pieces_[index_of(u)]; }
  /// The number of the contours' piece plus the parameter on it.
  double source_of(double u) const;

  /// How often a piece was evaluated so far: the work done.
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
  std::vector<bool> corner_, jump_;  ///< where each piece begins
  std::vector<Tip> tips_;
  mutable std::uint64_t evaluations_ = 0;  ///< one thread at a time has a boundary
  Vec2 low_, high_;
  double way_ = 0;  ///< of a radian in fans, and through gaps
};

/// The contour counter-clockwise, arcs as rational quadratics, closed.
Contour normalized(const Contour& contour);

/// What keeps a contour from being followed, with the place: a cusp, or numbers that are not
/// finite; success if nothing does.
Status find_cusp(const Contour& contour);

}  // namespace medial::curve_axis
