#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial/error.h"
#include "medial/shape.h"
#include "medial/vec2.h"

namespace medial {

/// A piece of a contour: a Bezier curve of any degree, or a circular arc.
struct CurvePiece {
  std::uint32_t first = 0;   ///< its first control point; its last one is `first + degree`
  std::uint32_t degree = 1;  ///< 1: straight, or an arc
  double bulge = 0;          ///< of an arc (degree 1): see Ring
};

/// A closed free-form boundary as it was read: pieces end to end, each beginning at the last
/// control point of the one before. Where the last piece does not end at the first control point, a
/// straight piece closes the contour.
struct Contour {
  std::vector<Vec2> points;     ///< control points; neighbouring pieces share one
  std::vector<double> weights;  ///< of each control point, positive; empty: all 1
  std::vector<CurvePiece> pieces;
  RingRole role = RingRole::any;
  bool open = false;  ///< of a loose curve: nothing closes it (see Feature::chains)

  /// Starts an empty contour.
  void start_at(Vec2 point);
  /// Each appends one piece that begins at the last control point.
  void line_to(Vec2 end);
  void arc_to(Vec2 end, double bulge);
  /// `control` without the first point; `weights` of control points 1.., empty: all 1. A rational
  /// piece is scaled so that its first weight is that of the piece before.
  void bezier_to(std::span<const Vec2> control, std::span<const double> control_weights = {});
  /// The weights of a piece's control points but the first one, relative to that one, as
  /// bezier_to() takes them.
  std::vector<double> weights_of(const CurvePiece& piece) const;
  /// An elliptical arc around `center` with half axes `u` and `v` (conjugate), from the angle
  /// `begin` to `end` (radians; more than a whole turn is an error of the caller): rational
  /// quadratics of at most a quarter turn each. The contour ends at the point of angle `begin`, or
  /// is empty.
  void ellipse_to(Vec2 center, Vec2 u, Vec2 v, double begin, double end);
  /// A B-spline or NURBS: `knots` has degree + 1 more than `control`. Errors: malformed.
  Status spline_to(std::uint32_t degree, std::span<const double> knots,
                   std::span<const Vec2> control, std::span<const double> control_weights = {});
};

/// The edges of a ring (closed) or of an open chain as pieces; those without length are left out.
/// `bulges` of the edges, as of a Ring; empty: all are straight.
Contour contour_of(std::span<const Vec2> points, std::span<const double> bulges, bool closed);

/// The same points, from the last to the first.
Contour reversed(const Contour& contour);

struct ArcOptions {
  /// Largest distance between a contour and its arcs; relative to the diagonal of the bounding box,
  /// or in units of the input. Above 0.
  double tolerance = 1e-6;
  bool relative = true;
  /// Threads to use; 0: all of the machine. The result is the same, byte for byte.
  int threads = 0;
};

/// What approximate_by_arcs() did.
struct ArcReport {
  std::uint64_t pieces = 0;    ///< of the contours
  std::uint64_t spirals = 0;   ///< pieces of monotone curvature without inflection
  std::uint64_t arcs = 0;      ///< of the result
  std::uint64_t segments = 0;  ///< straight edges of the result
  double tolerance = 0;        ///< in units of the input; not below the coordinates' rounding
  double largest_error = 0;    ///< certified Hausdorff distance, in units of the input
};

/// Contours as rings of arcs and segments, by spiral biarcs (Aichholzer et al., Algorithms 1 and
/// 2): tangent continuous inside pieces and wherever two pieces join smoothly, within the tolerance
/// of the contour. Straight pieces and arcs stay as they are. Errors: not_finite, invalid_option,
/// malformed, unsupported (a weight that is not positive, a degree above 32), no_area.
Result<std::vector<Ring>> approximate_by_arcs(std::span<const Contour> contours,
                                              const ArcOptions& options = {},
                                              ArcReport* report = nullptr);

/// A closed curve with continuous curvature through the points of a polygon: the periodic cubic
/// spline over the length of the chords, with points added on edges until it is within `tolerance`
/// (units of the input) of the polygon and back. Errors: not_finite, too_few_points,
/// invalid_option, unsupported (no such curve with 2^20 points).
Result<Contour> fit_smooth_contour(std::span<const Vec2> polygon, double tolerance);

}  // namespace medial
