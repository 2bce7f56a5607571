#pragma once

#include "medial/shape.h"

namespace medial {

/// A piece of a contour: a Bezier curve of any degree, or a circular arc.
struct CurvePiece {
  std::uint32_t first = 0;   ///< its first control point; the last one is `first + degree`
  std::uint32_t degree = 1;  ///< 1: straight, or an arc
  double bulge = 0;          ///< of an arc (degree 1): see Ring
};

/// A curve of pieces end to end. If its ends differ, a straight piece closes it.
struct Contour {
  std::vector<Vec2> points;     ///< control points; neighbouring pieces share one
  std::vector<double> weights;  ///< of each control point, positive; empty: all 1
  std::vector<CurvePiece> pieces;
  RingRole role = RingRole::any;
  bool open = false;  ///< a loose curve, which stays open (see Feature::chains)

  /// Starts an empty contour. The functions below append to it, from its last control point.
  void start_at(Vec2 point);
  void line_to(Vec2 end);
  void arc_to(Vec2 end, double bulge);
  /// Takes the control points, and their weights (empty: all 1), except the first. A rational piece
  /// is scaled so that its first weight is the last one of the previous piece.
  void bezier_to(std::span<const Vec2> control, std::span<const double> control_weights = {});
  /// The weights of a piece in the form of bezier_to(): relative to its first weight, without it.
  std::vector<double> weights_of(const CurvePiece& piece) const;
  /// An elliptical arc around `center` with conjugate half axes `u` and `v`, from the angle `begin`
  /// to `end` (radians, at most a whole turn apart), as rational quadratics of at most a quarter
  /// turn each. The contour must be empty or end at the point of angle `begin`.
  void ellipse_to(Vec2 center, Vec2 u, Vec2 v, double begin, double end);
  /// A B-spline or NURBS; takes degree + 1 more `knots` than `control` points. Errors: malformed.
  Status spline_to(std::uint32_t degree, std::span<const double> knots,
                   std::span<const Vec2> control, std::span<const double> control_weights = {});
};

/// The edges of a closed ring or an open chain, except those of length 0; `bulges` as in Ring.
Contour contour_of(std::span<const Vec2> points, std::span<const double> bulges, bool closed);
Contour reversed(const Contour& contour);  ///< keeps the role

struct ArcOptions {
  std::optional<double> tolerance = {};  ///< largest distance of arcs; none: 1e-6, relative
  bool relative = true;  ///< to the bounding box's diagonal; else in units of the input
  int threads = 0;       ///< see Options
};

struct ArcReport {
  std::uint64_t pieces = 0;              ///< of the contours
  std::uint64_t spirals = 0;             ///< pieces of monotone curvature without inflection
  std::uint64_t arcs = 0, segments = 0;  ///< edges of the result
  // In units of the input.
  double tolerance = 0;      ///< at least the rounding of coordinates
  double largest_error = 0;  ///< certified Hausdorff distance
};

/// Approximates contours by arcs and segments within the tolerance, by spiral biarcs (Aichholzer et
/// al., Algorithms 1 and 2). The result is smooth except at corners; straight pieces and arcs stay
/// unchanged. Errors: not_finite, invalid_option, malformed, no_area, unsupported (weight, degree).
Result<std::vector<Ring>> approximate_by_arcs(std::span<const Contour> contours,
                                              const ArcOptions& options = {},
                                              ArcReport* report = nullptr);

/// The periodic cubic spline of continuous curvature that fits a polygon by least squares; adds
/// knots until both are within `tolerance` (units of the input) of each other. Misses vertices,
/// rounds smaller detail. Errors: not_finite, too_few_points, invalid_option, unsupported.
Result<Contour> fit_smooth_contour(std::span<const Vec2> polygon, double tolerance);

}  // namespace medial
