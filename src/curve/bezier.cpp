#include "curve/bezier.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/arc.h"

namespace medial::curve {
namespace {

/// A first derivative below this part of the largest is zero: the radius of curvature there is
/// below 1e-16 of the curve's size.
constexpr double singular = 1e-8;

/// Value and derivatives of one coordinate at t.
struct Values {
  double value = 0;
  double first = 0;
  double second = 0;
};

Values casteljau(const Fixed<double, max_degree + 1>& c, int any_degree, double t) {
  return with_degree(any_degree, [&](auto degree) {
    Fixed<double, max_degree + 1> b{};
    std::copy_n(c.begin(), degree + 1, b.begin());
    const double n = degree;
    for (int level = degree; level > 2; --level) {
      for (int i = 0; i < level; ++i) b[i] += t * (b[i + 1] - b[i]);
    }
    Values values;
    if (degree >= 2) {
      values.second = n * (n - 1) * ((b[2] - b[1]) - (b[1] - b[0]));
      b[0] += t * (b[1] - b[0]);
      b[1] += t * (b[2] - b[1]);
    }
    values.first = n * (b[1] - b[0]);
    values.value = b[0] + t * (b[1] - b[0]);
    return values;
  });
}

void split(const Fixed<double, max_degree + 1>& c, int any_degree, double t,
           Fixed<double, max_degree + 1>& before, Fixed<double, max_degree + 1>& after) {
  with_degree(any_degree, [&](auto degree) {
    Fixed<double, max_degree + 1> b;
    std::copy_n(c.begin(), degree + 1, b.begin());
    for (int level = 0; level <= degree; ++level) {
      before[level] = b[0];
      after[degree - level] = b[degree - level];
      for (int i = 0; i < degree - level; ++i) b[i] += t * (b[i + 1] - b[i]);
    }
  });
}

double largest_step(const Bezier& curve) {
  double largest = 0;
  for (int i = 0; i < curve.degree; ++i) {
    const Vec2 step = curve.point(i + 1) - curve.point(i);
    largest = std::max({largest, std::abs(step.x), std::abs(step.y)});
  }
  return largest;
}

/// The direction in which the curve leaves its first control point, or arrives at its last: towards
/// the next control point that differs.
Vec2 end_direction(const Bezier& curve, Side side, double same) {
  const int n = curve.degree;
  const Vec2 end = curve.point(side == Side::after ? 0 : n);
  for (int i = 1; i <= n; ++i) {
    const Vec2 d = side == Side::after ? curve.point(i) - end : end - curve.point(n - i);
    const double length = norm(d);
    if (length > same) return (1 / length) * d;
  }
  return {1, 0};
}

}  // namespace

Bezier make_bezier(std::span<const Vec2> points, std::span<const double> weights) {
  Bezier curve;
  curve.degree = static_cast<int>(points.size()) - 1;
  curve.rational = std::any_of(weights.begin(), weights.end(),
                               [&](double weight) { return weight != weights[0]; });
  for (int i = 0; i <= curve.degree; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double w = curve.rational ? weights[at] / weights[0] : 1;
    curve.x[i] = w * points[at].x;
    curve.y[i] = w * points[at].y;
    if (curve.rational) curve.w[i] = w;
  }
  return curve;
}

Bezier bezier_of(const Contour& contour, const CurvePiece& piece) {
  const std::span<const Vec2> points(contour.points.data() + piece.first, piece.degree + 1);
  if (contour.weights.empty()) return make_bezier(points);
  return make_bezier(points, {contour.weights.data() + piece.first, piece.degree + 1});
}

std::vector<Vec2> polygon_of(const Contour& contour) {
  std::vector<Vec2> points;
  for (const CurvePiece& piece : contour.pieces) {
    const Vec2 start = contour.points[piece.first], end = contour.points[piece.first + 1];
    points.push_back(start);
    if (piece.degree == 1 && piece.bulge == 0) continue;
    for (const double share : {0.25, 0.5, 0.75})
      points.push_back(piece.degree == 1 ? point_at_share(BulgeArc{start, end, piece.bulge}, share)
                                         : evaluate(bezier_of(contour, piece), share).point);
  }
  return points;
}

Jet evaluate(const Bezier& curve, double t) {
  const auto values = [&](const Fixed<double, max_degree + 1>& c) {
    return casteljau(c, curve.degree, t);
  };
  const Values x = values(curve.x), y = values(curve.y);
  if (!curve.rational) return {{x.value, y.value}, {x.first, y.first}, {x.second, y.second}};
  const Values w = values(curve.w);
  const double scale = 1 / w.value;
  const Vec2 point = scale * Vec2{x.value, y.value};
  const Vec2 first = scale * (Vec2{x.first, y.first} - w.first * point);
  const Vec2 second = scale * (Vec2{x.second, y.second} - w.second * point - 2 * w.first * first);
  return {point, first, second};
}

void split(const Bezier& curve, double t, Bezier& before, Bezier& after) {
  const int degree = curve.degree;
  const bool rational = curve.rational;
  split(curve.x, degree, t, before.x, after.x);
  split(curve.y, degree, t, before.y, after.y);
  if (rational) split(curve.w, degree, t, before.w, after.w);
  before.degree = after.degree = degree;
  before.rational = after.rational = rational;
}

double curvature(const Jet& jet) {
  const double speed = norm(jet.first);
  return cross(jet.first, jet.second) / (speed * speed * speed);
}

CurvaturePolynomials curvature_polynomials(const Bezier& curve) {
  const Polynomial x = from_bernstein(curve.x.data(), curve.degree);
  const Polynomial y = from_bernstein(curve.y.data(), curve.degree);
  CurvaturePolynomials result;
  Polynomial& e = result.inflection;
  Polynomial& s = result.speed;
  const auto finish = [&](const Polynomial& u, const Polynomial& v) {
    e = wronskian(v, u);
    s = sum(product(u, u), 1, product(v, v));
  };
  if (!curve.rational) {
    finish(derivative(x), derivative(y));
    // A parabola's E is a constant.
    result.apex = e.degree == 0 ? product(e, derivative(s))
                                : sum(product(derivative(e), s), -1.5, product(e, derivative(s)));
    if (e.degree == 0) {
      for (int i = 0; i <= result.apex.degree; ++i) result.apex.c[i] *= -1.5;
      result.apex.magnitude *= 1.5;
    }
    return result;
  }
  const Polynomial w = from_bernstein(curve.w.data(), curve.degree);
  finish(wronskian(x, w), wronskian(y, w));
  // Curvature is homogeneous of degree zero in t and 1 - t, so that its derivative is the partial
  // one by t, over 1 - t. The last coefficient is zero, and dropping it divides.
  const Polynomial turning = sum(product(by_t(e), w), 2, product(e, by_t(w)));
  result.apex = sum(product(turning, s), -1.5, product(product(e, w), by_t(s)));
  --result.apex.degree;
  return result;
}

Station station_at(const Bezier& curve, double t, Side side) {
  const Jet jet = evaluate(curve, t);
  const double speed = norm(jet.first);
  const double largest = largest_step(curve);
  if (speed > singular * curve.degree * largest) {
    return {t, jet.point, (1 / speed) * jet.first, curvature(jet)};
  }
  Bezier before, after;
  split(curve, t, before, after);
  const Vec2 tangent =
      end_direction(side == Side::after ? after : before, side, singular * largest);
  return {t, jet.point, tangent, std::numeric_limits<double>::infinity()};
}

}  // namespace medial::curve
