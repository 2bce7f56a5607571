#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "curve/bernstein.h"
#include "medial/contour.h"
#include "medial/geometry.h"

namespace medial::curve {

/// A Bezier curve: control point i times its weight in (x[i], y[i]), the weight in w[i] where the
/// curve is rational.
struct Bezier {
  int degree = 0;
  bool rational = false;
  Fixed<double, max_degree + 1> x;
  Fixed<double, max_degree + 1> y;
  Fixed<double, max_degree + 1> w;

  // Not initialised: only [0, degree] is ever used.
  Bezier() {}  // NOLINT(modernize-use-equals-default)

  double weight(int i) const { return rational ? w[i] : 1; }
  Vec2 point(int i) const { return rational ? Vec2{x[i] / w[i], y[i] / w[i]} : Vec2{x[i], y[i]}; }
};

/// Calls `work` with a degree: for those of most curves with a constant, so that its loops unroll.
template <class Work>
auto with_degree(int degree, const Work& work) {
  if (degree == 2) return work(std::integral_constant<int, 2>());
  if (degree == 3) return work(std::integral_constant<int, 3>());
  return work(degree);
}

/// A curve with these control points and positive weights (empty, or all alike: not rational).
Bezier make_bezier(std::span<const Vec2> points, std::span<const double> weights = {});

/// A piece of a contour that is no arc.
Bezier bezier_of(const Contour& contour, const CurvePiece& piece);

/// A contour as a polygon: where its pieces begin, and three points on each curved one.
std::vector<Vec2> polygon_of(const Contour& contour);

/// Point and derivatives at t, by de Casteljau's algorithm.
struct Jet {
  Vec2 point;
  Vec2 first;
  Vec2 second;
};
Jet evaluate(const Bezier& curve, double t);

/// The parts before and after t. `before` or `after` may be `curve` itself.
void split(const Bezier& curve, double t, Bezier& before, Bezier& after);

/// Signed curvature of a jet, positive where it turns to the left. Infinite at a cusp.
double curvature(const Jet& jet);

/// The polynomials whose zeros split a curve into spirals. With homogeneous coordinates (X, Y, W),
/// the tangent is along (U, V) = (X'W - XW', Y'W - YW'), and with S = U^2 + V^2 and E = UV' - VU'
/// the curvature is E W^2 / S^(3/2), so that
///   an inflection is a zero of E,
///   an apex is a zero of (E'W + 2EW') S - 3/2 E W S' (for a cubic: of degree 5),
///   a cusp is a zero of S, hence of S'.
struct CurvaturePolynomials {
  Polynomial inflection;
  Polynomial apex;
  Polynomial speed;  ///< S
};
CurvaturePolynomials curvature_polynomials(const Bezier& curve);

/// Where a curve is split, and how it passes there.
struct Station {
  double t = 0;
  Vec2 point;
  Vec2 tangent;          ///< unit length, in the direction of travel
  double curvature = 0;  ///< infinite: a cusp, or an end where the first derivative is zero
  double tilt = 0;       ///< the small angle from the tangent to the curve's own
};

/// Which part of the curve a tangent belongs to; they differ at cusps only.
enum class Side { before, after };
Station station_at(const Bezier& curve, double t, Side side);

}  // namespace medial::curve
