#include "axis/curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/arc.h"
#include "base/quadrature.h"
#include "medial/query.h"

namespace medial {
namespace {

/// The largest number of samples of one edge.
constexpr double most_pieces = 100000;

/// The rational Bernstein basis with the weights 1, w, 1; its sum is 1.
struct Basis {
  double b0, b1, b2;
  Basis(double t, double weight) : Basis(1 - t, t, weight) {}
  /// Of both shares, s = 1 - t and t.
  Basis(double s, double t, double weight) {
    const double denominator = s * s + 2 * s * t * weight + t * t;
    b0 = s * s / denominator;
    b1 = 2 * s * t * weight / denominator;
    b2 = t * t / denominator;
  }
};

/// The integral of |velocity(t)| over [0, 1] by the eight-point Gauss-Legendre rule.
template <class Velocity>
double gauss_sum(const Velocity& velocity) {
  double sum = 0;
  for (const auto& [place, weight] : gauss8) {
    const Vec2 before = velocity(0.5 - 0.5 * place);
    const Vec2 after = velocity(0.5 + 0.5 * place);
    sum += weight * (std::hypot(before.x, before.y) + std::hypot(after.x, after.y));
  }
  return 0.5 * sum;
}

/// Length of the arc of a parabola with derivative 2 (a + t b), t in [0, 1].
///
/// With the coordinate u along b and the distance h of a from the line of b, this is the integral
/// of 2 sqrt(u^2 + h^2) / |b| over an interval of width |b|. The closed form divides a difference
/// by |b|, so a nearly straight arc (|b| <= |a| / 4) is integrated by the Gauss-Legendre rule
/// instead. The integrand's singularities are at least 6 half widths away, so the error of eight
/// points is below 12^-16.
double arc_length(Vec2 a, Vec2 b) {
  const double size = std::hypot(b.x, b.y);
  const double start_speed = std::hypot(a.x, a.y);
  if (size <= 0.25 * start_speed) return gauss_sum([&](double t) { return 2 * (a + t * b); });
  const Vec2 direction = (1 / size) * b;
  const double h = std::abs(cross(direction, a));
  const double u0 = dot(direction, a);
  const auto primitive = [h](double u) {
    const double quotient = u / h;
    return u * std::hypot(u, h) + (std::isfinite(quotient) ? h * h * std::asinh(quotient) : 0.0);
  };
  return (primitive(u0 + size) - primitive(u0)) / size;
}

/// A piece of a conic from the origin to p2 with control point p1 and weights 1, weight, 1.
struct Conic {
  Vec2 p1, p2;
  double weight;

  /// The two halves of the parameter's range.
  std::array<Conic, 2> halves() const {
    const double half_weight = std::sqrt(0.5 * (1 + weight));
    const Vec2 left = (weight / (1 + weight)) * p1;
    const Vec2 middle = (0.5 / (1 + weight)) * (2 * weight * p1 + p2);
    const Vec2 right = (1 / (1 + weight)) * (weight * p1 + p2);
    return {{{left, middle, half_weight}, {right - middle, p2 - middle, half_weight}}};
  }
  /// The derivative at t.
  Vec2 velocity(double t) const {
    const double s = 1 - t;
    const double d = s * s + 2 * s * t * weight + t * t;
    return (2 / (d * d)) * (s * s * weight * p1 + s * t * p2 + t * t * weight * (p2 - p1));
  }
};

/// Length of a conic. Halves it until the velocity hardly changes along a piece, where the
/// eight-point rule is exact up to rounding. A half has the weight sqrt((1 + w) / 2) and half the
/// angle, so about ten halvings suffice for any conic.
double conic_length(const Conic& conic) {
  constexpr double calm = 0.25;
  constexpr int deepest = 40;
  struct Piece {
    Conic conic;
    int depth;
  };
  std::array<Piece, deepest + 2> stack;
  std::size_t size = 0;
  stack[size++] = {conic, 0};
  double sum = 0;
  while (size > 0) {
    const Piece piece = stack[--size];
    const Conic& c = piece.conic;
    const Vec2 first = c.weight * c.p1, last = c.weight * (c.p2 - c.p1);
    const Vec2 middle = (1 / (1 + c.weight)) * c.p2;
    const double change = std::max(norm(first - middle), norm(last - middle));
    if (change <= calm * norm(middle) || piece.depth == deepest) {
      sum += gauss_sum([&](double t) { return c.velocity(t); });
      continue;
    }
    const auto halves = c.halves();
    for (const Conic& half : {halves[1], halves[0]}) stack[size++] = {half, piece.depth + 1};
  }
  return sum;
}

/// The quartic of a curve's nearest points in Bernstein form, on a part of [0, 1].
using Quartic = std::array<double, 5>;

std::array<Quartic, 2> halves_of(Quartic f) {
  std::array<Quartic, 2> out;
  for (std::size_t i = 0; i < 5; ++i) {
    out[0][i] = f[0];
    out[1][4 - i] = f[4 - i];
    for (std::size_t j = 0; j + i + 1 < 5; ++j) f[j] = 0.5 * (f[j] + f[j + 1]);
  }
  return out;
}

/// Value and derivative.
std::pair<double, double> value_of(Quartic f, double t) {
  for (std::size_t n = 4; n > 1; --n)
    for (std::size_t j = 0; j < n; ++j) f[j] = (1 - t) * f[j] + t * f[j + 1];
  return {(1 - t) * f[0] + t * f[1], 4 * (f[1] - f[0])};
}

/// A root of `f` in [low, high], at whose ends it has different signs, by bracketed Newton steps.
/// `f` returns the value and the derivative.
template <class Function>
double bracketed_root(Function f, double low, double high) {
  const bool rising = f(low).first < 0;
  double t = 0.5 * (low + high);
  // If Newton's method does not converge, at least every second step halves the bracket.
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
  return count >= 1 ? static_cast<std::size_t>(std::min(std::ceil(count), most_pieces)) : 1;
}

}  // namespace

Vec2 Curve::offset(double t) const {
  if (t == 1) return p2;
  const Basis basis(t, weight);
  // Computed relative to the nearer end, where the result is exact; the error shrinks towards it.
  if (t <= 0.5) return basis.b1 * p1 + basis.b2 * p2;
  return p2 - (basis.b0 * p2 + basis.b1 * (p2 - p1));
}

Disk Curve::at(double s, double t) const {
  if (t == 0) return {origin, r0};
  if (s == 0) return {end, r2};
  const Basis basis(s, t, weight);
  const double radius = basis.b0 * r0 + basis.b1 * r1 + basis.b2 * r2;
  if (t <= s) return {origin + (basis.b1 * p1 + basis.b2 * p2), radius};
  return {end - (basis.b0 * p2 + basis.b1 * (p2 - p1)), radius};
}

Vec2 Curve::velocity(double t) const {
  // C = N / D gives C' = (N' - C D') / D.
  const double s = 1 - t, d = s * s + 2 * s * t * weight + t * t;
  const double d_first = 2 * (weight - 1) * (s - t);
  return (1 / d) * (2 * (s - t) * weight * p1 + 2 * t * p2 - d_first * offset(t));
}

Curve::Derivatives Curve::derivatives(double t) const {
  // C'' = (N'' - 2 C' D' - C D'') / D.
  const double s = 1 - t;
  const double d = s * s + 2 * s * t * weight + t * t;
  const double d_first = 2 * (weight - 1) * (s - t);
  const double d_second = 4 * (1 - weight);
  const Basis basis(t, weight);
  // Radii are relative to the first one, like the centres.
  const double q1 = r1 - r0, q2 = r2 - r0;
  const double q = basis.b1 * q1 + basis.b2 * q2;
  Derivatives out;
  out.first = velocity(t);
  out.second =
      (1 / d) * (-4 * weight * p1 + 2 * p2 - 2 * d_first * out.first - d_second * offset(t));
  out.radius_first = (2 * (s - t) * weight * q1 + 2 * t * q2 - d_first * q) / d;
  out.radius_second =
      (-4 * weight * q1 + 2 * q2 - 2 * d_first * out.radius_first - d_second * q) / d;
  return out;
}

std::pair<Disk, double> Curve::control_between(double t0, double t1) const {
  // Blossoms of the curve in homogeneous coordinates, relative to the origin.
  struct Lifted {
    Vec2 p;
    double r, w;
  };
  const auto blossom = [this](double a, double b) {
    const double b0 = (1 - a) * (1 - b), b1 = weight * ((1 - a) * b + a * (1 - b)), b2 = a * b;
    const double w = b0 + b1 + b2;
    return Lifted{(1 / w) * (b1 * p1 + b2 * p2), (b0 * r0 + b1 * r1 + b2 * r2) / w, w};
  };
  const Lifted first = blossom(t0, t0), middle = blossom(t0, t1), last = blossom(t1, t1);
  return {{origin + middle.p, middle.r}, middle.w / std::sqrt(first.w * last.w)};
}

bool Curve::straight() const {
  // The control points of straight edges are rounded, so an edge flatter than that is straight.
  if (weight == 1) return cross(p1, p2) == 0;
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  return std::abs(cross(p1, p2)) <= rounding * (squared_norm(p1) + squared_norm(p2));
}

double Curve::length(double t) const {
  const double s = 1 - t, q = s + t * weight;
  const Conic piece{(t * weight / q) * p1, offset(t),
                    q / std::sqrt(s * s + 2 * s * t * weight + t * t)};
  // No conic is shorter than its chord or longer than its control polygon, which is longer by 2 h^2
  // chords if its height is a small share h of the chord.
  constexpr double high = 1e-7;
  if (!(std::abs(cross(piece.p1, piece.p2)) > high * squared_norm(piece.p2))) {
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    const auto size = [](Vec2 v) { return std::hypot(v.x, v.y); };  // does not underflow
    const double chord = size(piece.p2);
    if (size(piece.p1) + size(piece.p2 - piece.p1) <= (1 + rounding) * chord) return chord;
  }
  return weight == 1 ? arc_length(t * p1, (t * t) * (p2 - 2 * p1)) : conic_length(piece);
}

double Curve::at_length(double s) const {
  if (s <= 0) return 0;
  if (s >= length()) return 1;
  return bracketed_root([&](double t) { return std::pair(length(t) - s, norm(velocity(t))); }, 0,
                        1);
}

double Curve::nearest(Vec2 p) const {
  const Vec2 target = p - origin;
  if (straight()) {
    const double size = std::hypot(p2.x, p2.y);
    if (!(size > 0)) return 0;
    const double along = dot(target, (1 / size) * p2);
    return along <= 0 ? 0 : along >= size ? 1 : at_length(along);
  }
  // With C = N / D, a nearest point has (N - p D) . (N' D - N D') = 0, a quartic: both factors are
  // quadratic, and Bernstein's coefficients follow from the control points. The distance has a
  // minimum where the quartic rises through zero, or at an end.
  const std::array<Vec2, 3> m{-target, weight * (p1 - target), p2 - target};
  const std::array<Vec2, 3> e{2 * weight * p1, p2, 2 * weight * (p2 - p1)};
  const Quartic whole{dot(m[0], e[0]), 0.5 * (dot(m[0], e[1]) + dot(m[1], e[0])),
                      (dot(m[0], e[2]) + 4 * dot(m[1], e[1]) + dot(m[2], e[0])) / 6,
                      0.5 * (dot(m[1], e[2]) + dot(m[2], e[1])), dot(m[2], e[2])};
  double best_t = 0, best = squared_norm(target);
  const auto consider = [&](double t) {
    const double d = squared_norm(offset(t) - target);
    if (d < best) {
      best = d;
      best_t = t;
    }
  };
  consider(1);
  // Halve until the coefficients change sign at most once; then there is at most one root.
  struct Part {
    Quartic f;
    double begin, end;
  };
  constexpr std::size_t deepest = 56;
  std::array<Part, deepest + 2> stack;
  std::size_t size = 0;
  stack[size++] = {whole, 0, 1};
  while (size > 0) {
    const Part part = stack[--size];
    int changes = 0;
    for (std::size_t i = 0; i < 4; ++i) changes += (part.f[i] < 0) != (part.f[i + 1] < 0) ? 1 : 0;
    if (changes == 0) continue;
    const double middle = 0.5 * (part.begin + part.end);
    if (changes > 1 && size < deepest && part.begin < middle && middle < part.end) {
      const auto [left, right] = halves_of(part.f);
      stack[size++] = {right, middle, part.end};
      stack[size++] = {left, part.begin, middle};
      continue;
    }
    const double t =
        changes > 1 ? 0.5 : bracketed_root([&](double u) { return value_of(part.f, u); }, 0, 1);
    consider(part.begin + t * (part.end - part.begin));
  }
  return best_t;
}

double Curve::area_beside_chord() const {
  // The area is cross(p1, p2) w times the integral of t^2 / D^2, with D = 1 + 2 (w - 1) t (1 - t).
  // The integral contains atanh(sqrt z) / sqrt z, z = (w - 1) / (w + 1), which is an arc tangent
  // for an ellipse. Near z = 0, use the series: sum z^k / (2 k + 1), and for the other term 2 z^k /
  // ((2 k
  // + 1) (2 k + 3)).
  constexpr double small = 0.0625, nothing = 0x1p-60;
  const double z = (weight - 1) / (weight + 1);
  const double rest = 2 / (weight + 1);  // 1 - z, also where z rounds to 1
  double first = 1, second = 2.0 / 3;
  if (std::abs(z) < small) {
    double power = z;
    for (int k = 1; k <= 13 && std::abs(power) > nothing; ++k, power *= z) {
      first += power / (2 * k + 1);
      second += 2 * power / ((2 * k + 1) * (2 * k + 3));
    }
  } else {
    const double root = std::sqrt(std::abs(z));
    first = (z > 0 ? std::log((1 + root) / std::sqrt(rest)) : std::atan(root)) / root;
    second = (1 - rest * first) / z;
  }
  return cross(p1, p2) * (0.125 * (1 + z) * (1 + rest * first + second));
}

void add_roots(double a, double b, double c, std::vector<double>& out) {
  // For u = t / (1 - t), a + 2 b u + c u^2 = 0.
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  for (const double t : {q / (q + c), a / (a + q)})
    if (t > 0 && t < 1) out.push_back(t);
}

Disk disk_at(const MedialAxis& axis, const Edge& edge, double t) {
  return curve_of(axis, edge).at(t);
}

namespace {

/// The point of an arc nearest to p, from the nearer end.
Vec2 foot_on_arc(const BulgeArc& arc, Vec2 p) {
  const Vec2 from_start = p - arc.start, from_end = p - arc.end;
  const bool by_start = squared_norm(from_start) <= squared_norm(from_end);
  const BulgeArc seen = by_start ? arc : arc.reversed();
  const Vec2 to = by_start ? from_start : from_end, tangent = start_tangent(seen);
  if (dot(tangent, to) <= 0 || dot(end_tangent(seen), p - seen.end) >= 0) return seen.start;
  // The direction of round * (p - centre) turns with the foot.
  const double round = curvature(seen);
  const double half =
      0.5 * std::atan2(round * dot(tangent, to), 1 - round * dot(left_of(tangent), to));
  return seen.start +
         (2 * std::sin(half) / round) * turned(tangent, std::cos(half), std::sin(half));
}

}  // namespace

Vec2 foot(const Site& site, Vec2 p) {
  const Vec2 d = site.end - site.start;
  const double size = squared_norm(d);
  if (!(size > 0)) return site.start;
  if (site.bulge != 0) return foot_on_arc({site.start, site.end, site.bulge}, p);
  const double t = dot(p - site.start, d) / size;
  // Computed from the nearer end, so that the foot at an end is exactly that end.
  if (t <= 0) return site.start;
  if (t >= 1) return site.end;
  return t <= 0.5 ? site.start + t * d : site.end - (1 - t) * d;
}

double length(const MedialAxis& axis, const Edge& edge) { return curve_of(axis, edge).length(); }

double total_length(const MedialAxis& axis) {
  // Compensated summation (Neumaier), so that rounding errors of millions of edges do not add up.
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
  const double bend = std::max(norm(curve.p2 - 2 * curve.p1),
                               std::abs((curve.r2 - curve.r1) - (curve.r1 - curve.r0)));
  if (w == 1) {
    // Over a range dt of t, a quadratic deviates from its chord by its second difference * dt^2
    // / 4.
    pieces = std::sqrt(bend / (4 * chord));
  } else if (w > 1 && curve.straight()) {
    // Along the straight line of centres, with the coordinate h, the radius is a hyperbola: h = d
    // sinh u and r = d cosh u. The weight is the cosh of `angle`, half the range of u. Over a range
    // of 2 v, it deviates from its chord by at most d (cosh v - 1) = 2 d sinh^2(v / 2).
    const double sinh_angle = std::sqrt((w - 1) * (w + 1));
    const double run = norm(curve.p2), rise = std::abs(curve.r2 - curve.r0);
    const double d = std::sqrt(std::max(0.0, run - rise) * (run + rise)) / (2 * sinh_angle);
    angle = std::acosh(w);
    pieces = angle / (2 * std::asinh(std::sqrt(chord / (2 * d))));
  } else {
    // A conic is an affine image of a circle or a hyperbola, and the weight is the cos or cosh of
    // `angle`, half the range of u. Over a range of 2 v, it deviates from its chord by 2 sin^2(v /
    // 2) or 2 sinh^2(v / 2), times the radius conjugate to the chord. That radius is `bend` w / (2
    // |1 - w^2|) for the whole chord; for other chords it is at most this plus half of the whole
    // chord, on a hyperbola times w.
    const double half_chord = 0.5 * std::max(norm(curve.p2), std::abs(curve.r2 - curve.r0));
    const double radius = 0.5 * bend * w / (std::abs(1 - w) * (1 + w));
    const double largest = w > 1 ? w * radius + half_chord : radius + half_chord;
    const double half = std::sqrt(chord / (2 * largest));
    angle = w > 1 ? std::acosh(w) : std::acos(w);
    pieces = angle / (2 * (w > 1 ? std::asinh(half) : std::asin(std::min(1.0, half))));
  }
  const std::size_t n = piece_count(pieces);
  std::vector<Disk> out;
  out.reserve(n + 1);
  for (std::size_t i = 0; i <= n; ++i) {
    double t = static_cast<double>(i) / static_cast<double>(n), s = 1 - t;
    if (angle > 0 && i > 0 && i < n) {
      // Equal steps of u.
      const double before = w > 1 ? std::sinh(angle * t) : std::sin(angle * t);
      const double after = w > 1 ? std::sinh(angle * s) : std::sin(angle * s);
      t = before / (before + after);
      s = after / (before + after);
    }
    out.push_back(curve.at(s, t));
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
