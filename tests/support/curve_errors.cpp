#include "support/curve_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/numbers.h"
#include "curve/bernstein.h"

namespace medial::test {

using namespace curve;

namespace {

/// The distance from the circle of curvature k to a point with F = k |c|^2 - 2 (v x c).
double distance_of(double f, double k) {
  const double root = 1 + k * f;
  return root > 0 ? std::abs(f) / (1 + std::sqrt(root)) : infinity;
}

double circle_function(const Arc& arc, Vec2 tangent, double k, Vec2 point) {
  const Vec2 c = point - arc.begin;
  return k * squared_norm(c) - 2 * cross(tangent, c);
}

double value_at(const Polynomial& p, double t) {
  double value = 0;
  for (int i = 0; i <= p.degree; ++i) {
    value += p.c[i] * std::pow(t, i) * std::pow(1 - t, p.degree - i);
  }
  return value;
}

}  // namespace

double sampled_error(const Bezier& curve, const Biarc& biarc, int samples) {
  const std::optional<double> t =
      projected_joint(curve, biarc.first.end, tangent_at_end(biarc.first));
  if (!t) return infinity;
  double largest = 0;
  const auto sample = [&](const Arc& arc, double from, double to) {
    const Vec2 tangent = tangent_at_begin(arc);
    const double k = curvature(arc);
    for (int i = 0; i <= samples + 1; ++i) {
      const double at = from + (to - from) * i / (samples + 1);
      const double f = circle_function(arc, tangent, k, evaluate(curve, at).point);
      largest = std::max(largest, distance_of(f, k));
    }
  };
  sample(biarc.first, 0, *t);
  sample(biarc.second, *t, 1);
  return largest;
}

double extremal_error(const Bezier& curve, const Biarc& biarc) {
  const std::optional<double> t =
      projected_joint(curve, biarc.first.end, tangent_at_end(biarc.first));
  if (!t) return infinity;
  Bezier parts[2];
  split(curve, *t, parts[0], parts[1]);
  double largest = 0;
  for (int part = 0; part < 2; ++part) {
    const Bezier& piece = parts[part];
    const Arc& arc = part == 0 ? biarc.first : biarc.second;
    const Vec2 tangent = tangent_at_begin(arc);
    const double k = curvature(arc);
    // F = N / W^2 has the derivative (N'W - 2NW') / W^3.
    Fixed<double, max_degree + 1> cx, cy, side, w;
    for (int i = 0; i <= piece.degree; ++i) {
      w[i] = piece.weight(i);
      cx[i] = piece.x[i] - w[i] * arc.begin.x;
      cy[i] = piece.y[i] - w[i] * arc.begin.y;
      side[i] = tangent.x * cy[i] - tangent.y * cx[i];
    }
    const Polynomial x = from_bernstein(cx.data(), piece.degree);
    const Polynomial y = from_bernstein(cy.data(), piece.degree);
    const Polynomial weight = from_bernstein(w.data(), piece.degree);
    Polynomial n = sum(product(x, x), 1, product(y, y));
    for (int i = 0; i <= n.degree; ++i) n.c[i] *= k;
    n.magnitude *= std::abs(k);
    n = sum(n, -2, product(from_bernstein(side.data(), piece.degree), weight));
    const Polynomial slope =
        piece.rational ? sum(product(derivative(n), weight), -2, product(n, derivative(weight)))
                       : derivative(n);
    Roots at = roots(slope);
    at.add(0);
    at.add(1);
    for (int i = 0; i < at.count; ++i) {
      const Vec2 point = evaluate(piece, at.t[i]).point;
      largest = std::max(largest, distance_of(circle_function(arc, tangent, k, point), k));
    }
  }
  return largest;
}

double curvature_derivative(const Bezier& curve, double t) {
  // d/dt (E W^2 S^(-3/2)) = W ((E'W + 2EW') S - 3/2 E W S') S^(-5/2).
  const CurvaturePolynomials polynomials = curvature_polynomials(curve);
  const double w = curve.rational ? value_at(from_bernstein(curve.w.data(), curve.degree), t) : 1;
  return w * value_at(polynomials.apex, t) * std::pow(value_at(polynomials.speed, t), -2.5);
}

}  // namespace medial::test
