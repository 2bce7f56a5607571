#include "axis/curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "medial/query.h"

namespace medial {
namespace {

/// Most samples of one edge, whatever the caller asks for.
constexpr double kMostPieces = 100000;

/// The Bernstein polynomials with the weights 1, w, 1, normalised to the sum 1.
struct Basis {
  double b0, b1, b2;
  Basis(double t, double weight) {
    const double s = 1 - t;
    const double denominator = s * s + 2 * s * t * weight + t * t;
    b0 = s * s / denominator;
    b1 = 2 * s * t * weight / denominator;
    b2 = t * t / denominator;
  }
};

/// Length of the parabola's arc with derivative 2 (a + t b), t in [0, 1].
///
/// Along b, with u the coordinate in its direction and h the distance of a from it, this is the
/// integral of 2 sqrt(u^2 + h^2) / |b| over an interval of width |b|. Its closed form divides a
/// difference by |b|, so a nearly straight arc (|b| <= |a| / 4) takes Gauss-Legendre's rule
/// instead: the integrand's singularities lie at least 6 half widths away, where the error of eight
/// points is below 12^-16.
double arc_length(Vec2 a, Vec2 b) {
  const double size = std::hypot(b.x, b.y);
  const double start_speed = std::hypot(a.x, a.y);
  if (size <= 0.25 * start_speed) {
    static constexpr std::array<double, 4> abscissa{0.1834346424956498, 0.5255324099163290,
                                                    0.7966664774136267, 0.9602898564975363};
    static constexpr std::array<double, 4> factor{0.3626837833783620, 0.3137066458778873,
                                                  0.2223810344533745, 0.1012285362903763};
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2 before = a + (0.5 - 0.5 * abscissa[i]) * b;
      const Vec2 after = a + (0.5 + 0.5 * abscissa[i]) * b;
      sum += factor[i] * (std::hypot(before.x, before.y) + std::hypot(after.x, after.y));
    }
    return sum;
  }
  const Vec2 direction = (1 / size) * b;
  const double h = std::abs(cross(direction, a));
  const double u0 = dot(direction, a);
  const auto primitive = [h](double u) {
    const double quotient = u / h;
    return u * std::hypot(u, h) + (std::isfinite(quotient) ? h * h * std::asinh(quotient) : 0.0);
  };
  return (primitive(u0 + size) - primitive(u0)) / size;
}

/// A root of `f` in [low, high], where it changes its sign; by Newton's steps kept in the bracket.
/// `f` returns the value and the derivative.
template <class Function>
double bracketed_root(Function f, double low, double high) {
  const bool rising = f(low).first < 0;
  double t = 0.5 * (low + high);
  // Every second step halves the bracket at least when Newton's steps do not converge.
  for (int i = 0; i < 120 && low < high; ++i) {
    const auto [value, slope] = f(t);
    if (value == 0) return t;
    ((value < 0) == rising ? low : high) = t;
    double next = t - value / slope;
    if (i % 2 == 1 || !(next > low && next < high)) next = 0.5 * (low + high);
    if (i % 2 == 0 && std::abs(next - t) <= 0.25 * std::numeric_limits<double>::epsilon())
      return next;
    if (next == t) return t;
    t = next;
  }
  return t;
}

std::size_t piece_count(double count) {
  return count >= 1 ? static_cast<std::size_t>(std::min(std::ceil(count), kMostPieces)) : 1;
}

}  // namespace

Vec2 Curve::offset(double t) const {
  if (t == 1) return p2;
  const Basis basis(t, weight);
  // Relative to the nearer end: the result is exact there and its error shrinks towards it.
  if (t <= 0.5) return basis.b1 * p1 + basis.b2 * p2;
  return p2 - (basis.b0 * p2 + basis.b1 * (p2 - p1));
}

Disk Curve::at(double t) const {
  if (t == 0) return {origin, r0};
  if (t == 1) return {end, r2};
  const Basis basis(t, weight);
  const double radius = basis.b0 * r0 + basis.b1 * r1 + basis.b2 * r2;
  if (t <= 0.5) return {origin + (basis.b1 * p1 + basis.b2 * p2), radius};
  return {end - (basis.b0 * p2 + basis.b1 * (p2 - p1)), radius};
}

Curve::Derivatives Curve::derivatives(double t) const {
  // C = N / D gives C' = (N' - C D') / D and C'' = (N'' - 2 C' D' - C D'') / D.
  const double s = 1 - t;
  const double d = s * s + 2 * s * t * weight + t * t;
  const double d_first = 2 * (weight - 1) * (s - t);
  const double d_second = 4 * (1 - weight);
  const Vec2 value = offset(t);
  const Basis basis(t, weight);
  // Radii relative to the first one, as the centres are.
  const double q1 = r1 - r0, q2 = r2 - r0;
  const double q = basis.b1 * q1 + basis.b2 * q2;
  Derivatives out;
  out.first = (1 / d) * (2 * (s - t) * weight * p1 + 2 * t * p2 - d_first * value);
  out.second = (1 / d) * (-4 * weight * p1 + 2 * p2 - 2 * d_first * out.first - d_second * value);
  out.radius_first = (2 * (s - t) * weight * q1 + 2 * t * q2 - d_first * q) / d;
  out.radius_second =
      (-4 * weight * q1 + 2 * q2 - 2 * d_first * out.radius_first - d_second * q) / d;
  return out;
}

bool Curve::straight() const { return weight != 1 || cross(p1, p2) == 0; }

double Curve::length(double t) const {
  if (weight != 1) {
    const Vec2 d = offset(t);
    return std::hypot(d.x, d.y);
  }
  const Vec2 a = p1, b = p2 - 2 * p1;
  return arc_length(t * a, (t * t) * b);
}

double Curve::at_length(double s) const {
  if (s <= 0) return 0;
  if (s >= length()) return 1;
  return bracketed_root(
      [&](double t) { return std::pair(length(t) - s, norm(derivatives(t).first)); }, 0, 1);
}

double Curve::nearest(Vec2 p) const {
  const Vec2 target = p - origin;
  if (straight()) {
    const double size = std::hypot(p2.x, p2.y);
    if (!(size > 0)) return 0;
    const double along = dot(target, (1 / size) * p2);
    return along <= 0 ? 0 : along >= size ? 1 : at_length(along);
  }
  // The squared distance has the derivative 4 f with the cubic f(t) = (C(t) - p) . (a + t b), where
  // C(t) = 2 t a + t^2 b. Between the zeros of f' it is monotone: a minimum of the distance is
  // where f rises through zero, or an end.
  const Vec2 a = p1, b = p2 - 2 * p1;
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b);
  const double c0 = -dot(target, a), c1 = 2 * aa - dot(target, b), c2 = 3 * ab, c3 = bb;
  const auto f = [&](double t) {
    return std::pair(((c3 * t + c2) * t + c1) * t + c0, (3 * c3 * t + 2 * c2) * t + c1);
  };
  std::array<double, 4> bound{0, 0, 0, 1};
  std::size_t bounds = 1;
  const double discriminant = c2 * c2 - 3 * c3 * c1;
  if (discriminant > 0 && c3 > 0) {
    const double q = -(c2 + std::copysign(std::sqrt(discriminant), c2));
    double first = q / (3 * c3), second = q != 0 ? c1 / q : 0;
    if (first > second) std::swap(first, second);
    if (first > 0 && first < 1) bound[bounds++] = first;
    if (second > 0 && second < 1) bound[bounds++] = second;
  }
  bound[bounds++] = 1;
  double best_t = 0, best = squared_norm(target);
  const auto consider = [&](double t) {
    const double d = squared_norm(offset(t) - target);
    if (d < best) {
      best = d;
      best_t = t;
    }
  };
  consider(1);
  for (std::size_t i = 0; i + 1 < bounds; ++i)
    if (f(bound[i]).first < 0 && f(bound[i + 1]).first > 0)
      consider(bracketed_root(f, bound[i], bound[i + 1]));
  return best_t;
}

Disk disk_at(const MedialAxis& axis, const Edge& edge, double t) {
  return curve_of(axis, edge).at(t);
}

Vec2 foot(const Site& site, Vec2 p) {
  const Vec2 d = site.end - site.start;
  const double size = squared_norm(d);
  if (!(size > 0)) return site.start;
  const double t = dot(p - site.start, d) / size;
  // From the nearer end, so that the foot at an end is that end exactly.
  if (t <= 0) return site.start;
  if (t >= 1) return site.end;
  return t <= 0.5 ? site.start + t * d : site.end - (1 - t) * d;
}

double length(const MedialAxis& axis, const Edge& edge) { return curve_of(axis, edge).length(); }

double total_length(const MedialAxis& axis) {
  // Compensated (Neumaier), so that millions of edges do not add up their roundings.
  double sum = 0, lost = 0;
  for (const Edge& edge : axis.edges) {
    const double term = length(axis, edge);
    const double next = sum + term;
    lost += std::abs(sum) >= std::abs(term) ? (sum - next) + term : (term - next) + sum;
    sum = next;
  }
  return sum + lost;
}

std::vector<Disk> sample_by_chord(const MedialAxis& axis, const Edge& edge, double chord) {
  const Curve curve = curve_of(axis, edge);
  chord = std::max(chord, std::numeric_limits<double>::min());
  const double w = curve.weight;
  double pieces = 1, angle = 0;
  if (w > 1 && std::isfinite(w)) {
    // Along the straight line of centres, at h, the radius is a hyperbola: h = d sinh u and
    // r = d cosh u, and the weight is the cosh of `angle`, half the range of u. A chord over a
    // range of 2 v departs from it by d (cosh v - 1) = 2 d sinh^2(v / 2) at most.
    const double sinh_angle = std::sqrt((w - 1) * (w + 1));
    const double run = norm(curve.p2), rise = std::abs(curve.r2 - curve.r0);
    const double d = std::sqrt(std::max(0.0, run - rise) * (run + rise)) / (2 * sinh_angle);
    angle = std::acosh(w);
    pieces = angle / (2 * std::asinh(std::sqrt(chord / (2 * d))));
  } else {
    // A chord over a range dt of t departs from a polynomial by its second difference * dt^2 / 4.
    const double bend = std::max(norm(curve.p2 - 2 * curve.p1),
                                 std::abs((curve.r2 - curve.r1) - (curve.r1 - curve.r0)));
    pieces = std::sqrt(bend / (4 * chord));
  }
  const std::size_t n = piece_count(pieces);
  std::vector<Disk> out;
  out.reserve(n + 1);
  for (std::size_t i = 0; i <= n; ++i) {
    double t = static_cast<double>(i) / static_cast<double>(n);
    if (angle > 0 && i > 0 && i < n) {
      // Equal steps of u.
      const double before = std::sinh(angle * t), after = std::sinh(angle * (1 - t));
      t = before / (before + after);
    }
    out.push_back(curve.at(t));
  }
  return out;
}

std::vector<Disk> sample_by_step(const MedialAxis& axis, const Edge& edge, double step) {
  const Curve curve = curve_of(axis, edge);
  const double total = curve.length();
  const std::size_t n = piece_count(total / std::max(step, std::numeric_limits<double>::min()));
  std::vector<Disk> out;
  out.reserve(n + 1);
  out.push_back(curve.at(0));
  for (std::size_t i = 1; i < n; ++i)
    out.push_back(
        curve.at(curve.at_length(total * (static_cast<double>(i) / static_cast<double>(n)))));
  out.push_back(curve.at(1));
  return out;
}

}  // namespace medial
