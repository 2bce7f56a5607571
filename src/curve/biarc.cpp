#include "curve/biarc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/numbers.h"
#include "curve/binomials.h"

namespace medial::curve {
namespace {

/// The direction `v` turned as a mirror along `axis` turns it.
Vec2 mirror(Vec2 v, Vec2 axis) { return (2 * dot(v, axis) / squared_norm(axis)) * axis - v; }

/// The distance from the circle of curvature k to a point with F = k |c|^2 - 2 (v x c).
double distance_of(double f, double k) {
  const double root = 1 + k * f;
  return root > 0 ? std::abs(f) / (1 + std::sqrt(root)) : infinity;
}

/// Whether all control points lie on the inner side of the normals at `from` and `to`.
bool in_sector(const Bezier& curve, Vec2 from, Vec2 begin, Vec2 to, Vec2 end, double rounding) {
  const double begin_least = dot(begin, from) - rounding;
  const double end_most = dot(end, to) + rounding;
  for (int i = 0; i <= curve.degree; ++i) {
    const Vec2 p = curve.point(i);
    if (dot(begin, p) < begin_least || dot(end, p) > end_most) return false;
  }
  return true;
}

using DoubleDegree = Fixed<double, 2 * max_degree + 1>;

/// A bound on a polynomial over W^2, both in Bernstein coefficients (W^2 of rational curves only),
/// piece by piece: a mean of the coefficients' ratios, with positive weights, is nowhere larger.
inline double largest_on_pieces(DoubleDegree& f, DoubleDegree* w, int degree,
                                std::span<const double> cuts) {
  double largest = 0, before = 0;
  const auto add = [&](int i) {
    largest = std::max(largest, std::abs(w != nullptr ? f[i] / (*w)[i] : f[i]));
  };
  for (const double cut : cuts) {
    // The first ones of each level are the coefficients before it.
    const double t = (cut - before) / (1 - before);
    for (int last = degree; last >= 0; --last) {
      add(0);
      for (int i = 0; i < last; ++i) f[i] += t * (f[i + 1] - f[i]);
      for (int i = 0; w != nullptr && i < last; ++i) (*w)[i] += t * ((*w)[i + 1] - (*w)[i]);
    }
    before = cut;
  }
  for (int i = 0; i <= degree; ++i) add(i);
  return largest;
}

/// An arc's unit tangents and curvature, all at once.
struct Directions {
  Vec2 begin, end;
  double curvature;
};
Directions directions_of(const Arc& arc) {
  const double b = arc.bulge, scale = 1 / (1 + b * b);
  const double cosine = (1 - b) * (1 + b) * scale, sine = 2 * b * scale;
  const Vec2 d = arc.end - arc.begin;
  const double length = norm(d), along = 1 / length;
  return {along * Vec2{cosine * d.x + sine * d.y, cosine * d.y - sine * d.x},
          along * Vec2{cosine * d.x - sine * d.y, cosine * d.y + sine * d.x},
          4 * b / (length * (1 + b * b))};
}

/// Where a curve is farthest from an arc that it meets at both ends, at small angles: at the zeros
/// of the derivative of s (1 - s) (a (1 - s) - b s), with the slopes a and b there. Where two
/// pieces meet there, the bound is the function itself.
struct Peaks {
  std::array<double, 2> at{};
  std::size_t count = 0;
};
Peaks peaks_of(const Bezier& curve, const Directions& arc) {
  const int n = curve.degree;
  const Vec2 first = curve.point(1) - curve.point(0), last = curve.point(n) - curve.point(n - 1);
  const double a = cross(arc.begin, first) / norm(first);
  const double b = cross(arc.end, last) / norm(last);
  const double middle = 2 * a + b;
  const double q = middle + std::copysign(std::sqrt(a * a + a * b + b * b), middle);
  Peaks peaks;
  constexpr double margin = 0.05;  // next to an end a cut would be in vain
  for (const double s : {a / q, q / (3 * (a + b))})
    if (s > margin && s < 1 - margin) peaks.at[peaks.count++] = s;
  if (peaks.count == 2 && peaks.at[0] > peaks.at[1]) std::swap(peaks.at[0], peaks.at[1]);
  return peaks;
}

/// A bound on F of the curve, for the circle at one end of the arc.
double largest_circle_function(const Bezier& curve, Vec2 base, Vec2 tangent, double k,
                               std::span<const double> cuts) {
  return with_degree(curve.degree, [&](auto n) {
    const Binomials& binomials = binomials_of(n);
    // Coefficients times the binomials: c, its turned component, and the weight.
    Fixed<double, max_degree + 1> cx, cy, side, w;
    for (int i = 0; i <= n; ++i) {
      const double scale = binomials.row[i];
      w[i] = scale * curve.weight(i);
      cx[i] = scale * curve.x[i] - w[i] * base.x;
      cy[i] = scale * curve.y[i] - w[i] * base.y;
      side[i] = 2 * (tangent.x * cy[i] - tangent.y * cx[i]);
    }
    const auto sum = [&](const auto& term) {
      DoubleDegree sums;
      for (int m = 0; m <= 2 * n; ++m) sums[m] = 0;
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) sums[i + j] += term(i, j);
      for (int m = 0; m <= 2 * n; ++m) sums[m] *= binomials.inverse_double_row[m];
      return sums;
    };
    DoubleDegree numerator =
        sum([&](int i, int j) { return k * (cx[i] * cx[j] + cy[i] * cy[j]) - side[i] * w[j]; });
    if (!curve.rational) return largest_on_pieces(numerator, nullptr, 2 * n, cuts);
    DoubleDegree denominator = sum([&](int i, int j) { return w[i] * w[j]; });
    return largest_on_pieces(numerator, &denominator, 2 * n, cuts);
  });
}

/// The certified distance of a curve in an arc's sector from its circle through one of its ends.
double circle_error(const Bezier& curve, const Arc& arc, const Directions& directions,
                    bool at_begin) {
  const Vec2 base = at_begin ? arc.begin : arc.end;
  const Vec2 tangent = at_begin ? directions.begin : directions.end;
  const double k = directions.curvature;
  const Peaks peaks = peaks_of(curve, directions);
  const double f =
      largest_circle_function(curve, base, tangent, k, std::span(peaks.at.data(), peaks.count));
  return distance_of(k > 0 ? -f : f, k);  // the larger of both sides
}

Station reversed(Station station) {
  station.tangent = -station.tangent;
  station.curvature = -station.curvature;
  return station;
}

/// Where the osculating circle at `from` meets the joint circle again.
Vec2 osculating_joint(const Station& from, const JointCircle& circle) {
  const Vec2 v = from.tangent, m = circle.direction;
  const Vec2 along = circle.curvature * v - from.curvature * m;
  const Vec2 joint = from.point + (-2 * cross(v, m) / squared_norm(along)) * along;
  // One Newton step onto the joint circle: rounding may slide the joint along it, not off it.
  return joint - circle.off(joint) * circle.normal(joint);
}

Vec2 osculating_joint(const Station& from, const Station& to) {
  return osculating_joint(from, joint_circle(from, to));
}

}  // namespace

double bulge_leaving(Vec2 tangent, Vec2 chord) {
  return cross(tangent, chord) / (norm(chord) + dot(tangent, chord));
}

double bulge_arriving(Vec2 chord, Vec2 tangent) {
  return cross(chord, tangent) / (norm(chord) + dot(tangent, chord));
}

double curvature(const Arc& arc) { return directions_of(arc).curvature; }
Vec2 tangent_at_begin(const Arc& arc) { return directions_of(arc).begin; }
Vec2 tangent_at_end(const Arc& arc) { return directions_of(arc).end; }

JointCircle joint_circle(const Station& a, const Station& b) {
  const Vec2 d = b.point - a.point;
  const Vec2 m = a.tangent + mirror(b.tangent, d);
  const Vec2 direction = (1 / norm(m)) * m;
  return {a.point, direction, 2 * cross(direction, d) / squared_norm(d)};
}

Vec2 spiral_joint(const Station& a, const Station& b) {
  const bool forward = std::abs(a.curvature) >= std::abs(b.curvature);
  return forward ? osculating_joint(a, b) : osculating_joint(reversed(b), reversed(a));
}

Vec2 flat_joint(const Station& a, const Station& b) {
  const bool forward = std::abs(a.curvature) >= std::abs(b.curvature);
  return forward ? osculating_joint(reversed(b), reversed(a)) : osculating_joint(a, b);
}

Vec2 balanced_joint(const Station& a, const Station& b, const JointCircle& circle) {
  const double whole = (b.curvature - a.curvature) * distance(a.point, b.point);
  const double p = a.tilt / whole, q = b.tilt / whole;
  const double first = (1.0 / 6 - p - q) / (0.5 + p - q);
  const double last = (1.0 / 3 + 2 * q) / (0.5 + q - p);
  const double weight = (last - (0.5 + 3 * (p - q))) / (last - first);
  Vec2 joint = weight * osculating_joint(a, circle) +
               (1 - weight) * osculating_joint(reversed(b), reversed(a));
  // Newton's steps: the middle of a chord is off by the square of its length, not by rounding.
  for (int step = 0; step < 3; ++step) joint = joint - circle.off(joint) * circle.normal(joint);
  return joint;
}

Vec2 settle_joint(const JointCircle& circle, Vec2 joint, Vec2 grid, double reach) {
  struct Step {
    Vec2 way;
    double effect;
  };
  const Vec2 normal = circle.normal(joint);
  Step longer{{grid.x, 0}, normal.x * grid.x}, shorter{{0, grid.y}, normal.y * grid.y};
  if (std::abs(longer.effect) < std::abs(shorter.effect)) std::swap(longer, shorter);
  const double enough = 0.5 * std::numeric_limits<double>::epsilon() * norm(joint - circle.base);
  double off = circle.off(joint);
  Vec2 way{0, 0};
  while (std::abs(off) > enough && shorter.effect != 0) {
    const double count = std::round(off / shorter.effect);
    const Vec2 next = way - count * shorter.way;
    if (!(std::abs(next.x) + std::abs(next.y) <= reach)) break;
    way = next;
    off -= count * shorter.effect;
    const double quotient = std::round(longer.effect / shorter.effect);
    const Step remainder{longer.way - quotient * shorter.way,
                         longer.effect - quotient * shorter.effect};
    longer = shorter;
    shorter = remainder;
  }
  return joint + way;
}

Biarc make_biarc(const Station& a, Vec2 joint, const Station& b) {
  return {{a.point, joint, bulge_leaving(a.tangent, joint - a.point)},
          {joint, b.point, bulge_arriving(b.point - joint, b.tangent)}};
}

std::optional<double> projected_joint(const Bezier& curve, Vec2 joint, Vec2 tangent) {
  return with_degree(curve.degree, [&](auto n) -> std::optional<double> {
    Fixed<double, max_degree + 1> h, b;
    for (int i = 0; i <= n; ++i)
      h[i] =
          tangent.x * curve.x[i] + tangent.y * curve.y[i] - curve.weight(i) * dot(tangent, joint);
    int changes = 0;
    for (int i = 0; i < n; ++i) changes += (h[i] < 0) != (h[i + 1] < 0);
    if (changes != 1 || !(h[0] < 0)) return std::nullopt;
    double low = 0, high = 1;
    double t = h[0] / (h[0] - h[n]);
    for (int step = 0; step < 60; ++step) {
      std::copy_n(h.begin(), n + 1, b.begin());
      for (int level = n; level > 1; --level) {
        for (int i = 0; i < level; ++i) b[i] += t * (b[i + 1] - b[i]);
      }
      const double slope = n * (b[1] - b[0]);
      const double value = b[0] + t * (b[1] - b[0]);
      (value < 0 ? low : high) = t;
      double next = t - value / slope;
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      // The error at the joint is stationary there, up to the angle to the curve.
      constexpr double precise = 1e-9;
      if (std::abs(next - t) < precise) return next;
      t = next;
    }
    return t;
  });
}

double certified_error(const Bezier& curve, const Arc& arc, double rounding) {
  const Directions directions = directions_of(arc);
  if (!in_sector(curve, arc.begin, directions.begin, arc.end, directions.end, rounding))
    return infinity;
  return circle_error(curve, arc, directions, true);
}

double certified_error(const Bezier& curve, const Biarc& biarc, double rounding) {
  const Arc &first = biarc.first, &second = biarc.second;
  const Directions of_first = directions_of(first), of_second = directions_of(second);
  const std::optional<double> t = projected_joint(curve, first.end, of_first.end);
  if (!t) return infinity;
  // Each circle through the end where it touches the curve.
  if (!in_sector(curve, first.begin, of_first.begin, second.end, of_second.end, rounding))
    return infinity;
  Bezier before, after;
  split(curve, *t, before, after);
  return std::max(circle_error(before, first, of_first, true),
                  circle_error(after, second, of_second, false));
}

}  // namespace medial::curve
