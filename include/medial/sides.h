#pragma once

// The boundary on the two sides of an axis, and whether it can be an axis at all: Shaked and
// Bruckstein, "The Curve Axis", 1996, Sections 2 and 3. Numbers in brackets are the paper's
// equations; `a` is the length along the axis, subscripts are derivatives by it.

#include "medial/contour.h"
#include "medial/query.h"

namespace medial {

/// The axis near one of its points.
struct AxisFrame {
  Disk disk;
  Vec2 tangent;            ///< A_a, of length 1
  double radius_rate = 0;  ///< R_a, no unit; beyond [-1, 1] no shape has such an axis
  double radius_bend = 0;  ///< R_aa, 1 / length
  double curvature = 0;    ///< K_A, 1 / length, positive where the axis turns left
  double rate_error = 0;   ///< of R_a, by rounding, or of packs their own; 0 on other samples
  double bend_error = 0;   ///< of R_aa and K_A in the same way

  /// The same in the other direction.
  AxisFrame reversed() const {
    AxisFrame back = *this;
    back.tangent = -tangent;
    back.radius_rate = -radius_rate;
    back.curvature = -curvature;
    return back;
  }
};

/// The frame at t in [0, 1] of an edge; of length 0 the tangent is 0 and the rest undefined.
AxisFrame frame_at(const MedialAxis& axis, const Edge& edge, double t);

/// The boundary at a foot of a disk, followed in the direction of the axis.
struct BoundaryFrame {
  Vec2 point;            ///< (3)
  Vec2 tangent;          ///< (5), of length 1
  double rate = 0;       ///< (6): length of boundary by length of axis; 0 at a reflex vertex
  double curvature = 0;  ///< (7), 1 / length, positive where the shape is convex; infinite at a
                         ///< reflex vertex; NaN where nothing decides it (|R_a| = 1)
  double radius_of_curvature() const { return 1 / curvature; }  ///< (8), with its sign
};

enum class Side : std::uint8_t { left, right };

/// One side of the axis. Requires |R_a| <= 1; values beyond are taken for 1.
BoundaryFrame boundary_at(const AxisFrame& frame, Side side);

/// The curvature of the boundary on one side at t in (0, 1) of an edge, and its first `order`
/// derivatives by the boundary's own length; by power series, so exact but for rounding. Not finite
/// at a reflex vertex. O(order^2).
std::vector<double> boundary_curvatures(const MedialAxis& axis, const Edge& edge, double t,
                                        Side side, int order);

/// The frames along a branch in its direction, but on edges of length 0: of an exact axis
/// `samples_per_edge` inside of every edge, of a sampled one at every inner node from its
/// neighbours, seven nodes of a curve axis and three of others.
std::vector<AxisFrame> frames_along(const MedialAxis& axis, const Branch& branch,
                                    int samples_per_edge = 8);

/// The boundary of an axis as closed contours with the interior on the left, by increasing lowest
/// edge: segments and arcs of an exact axis, straight pieces between the points of (3) of a sampled
/// one, a circle around a node without edges. Arcs of its disks close gaps. O(edges log(degree)).
std::vector<Contour> boundary_of(const MedialAxis& axis);

/// The two conditions that every axis meets.
struct Legality {
  double steepness = 0;  ///< (9): largest |R_a| - 1; above 0 no axis
  double bend = 0;  ///< (10): largest |K_A| R s - (1 - R_a^2 - R R_aa), s^2 = 1 - R_a^2; above 0
                    ///< no axis, 0 along a reflex vertex
  std::uint64_t frames = 0;  ///< how many counted: those that rounding does not decide
  AxisFrame steepest;        ///< where
  AxisFrame sharpest;        ///< where
  /// Whether both hold up to `slack` (no unit: rounding, or the noise of samples).
  bool legal(double slack) const { return steepness <= slack && bend <= slack; }
  /// Whether both hold with room to spare: then every short piece is the axis of its own disks.
  bool strictly_legal(double slack) const { return steepness < -slack && bend < -slack; }
};

/// One for each of branches(axis), in that order. O(edges).
std::vector<Legality> legality(const MedialAxis& axis, int samples_per_edge = 8);

}  // namespace medial
