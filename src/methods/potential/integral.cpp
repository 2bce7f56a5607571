#include "methods/potential/integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/quadrature.h"

namespace medial::potential {
namespace {

/// The potential of order 1, (3): log((r1 + r2 + L) / (r1 + r2 - L)), and r1 + r2 - L without
/// cancellation, for a segment of length L seen from the origin.
struct Ends {
  double r1, r2, excess;

  Ends(double x1, double x2, double y) {
    const double square = y * y;
    r1 = std::sqrt(x1 * x1 + square);
    r2 = std::sqrt(x2 * x2 + square);
    // r + x where x is negative is y^2 / (r - x).
    const double before = x1 < 0 ? square / (r1 - x1) : r1 + x1;
    const double behind = x2 > 0 ? square / (r2 + x2) : r2 - x2;
    excess = before + behind;
  }
};

/// J(0): the angle under which the segment is seen, over |y|.
double integral_0(double x1, double x2, double y) {
  const double length = x2 - x1, scalar = y * y + x1 * x2, area = length * std::abs(y);
  if (scalar > 0 && area < 1e-5 * scalar) {
    const double z = area / scalar;
    return length / scalar * (1 - z * z / 3);
  }
  return std::atan2(area, scalar) / std::abs(y);
}

/// J(1), from (6); the sines' difference without cancellation.
double integral_1(double x1, double x2, double y) {
  const Ends ends(x1, x2, y);
  const double length = x2 - x1;
  return 2 * length * (1 / ends.r1 + 1 / ends.r2) / (ends.excess * (ends.excess + 2 * length));
}

/// The integral of cos^order from `angle` to a right angle, for an angle in [pi / 4, pi / 2], over
/// cos^(order + 1): a series of positive terms in z = cos^2.
double tail_factor(double order, double z) {
  double term = 1, sum = 1;
  for (int k = 0; term > 1e-17 * sum; ++k) {
    term *= z * (0.5 * order + 1 + k) / (0.5 * (order + 3) + k);
    sum += term;
  }
  return std::sqrt(1 - z) / (order + 1) * sum;
}

/// The integral of cos^order from 0 to the angle with this sine and cosine, both positive.
double cosine_power(double order, double sine, double cosine) {
  if (sine > cosine) {
    const double whole = 0.5 * std::sqrt(std::numbers::pi) *
                         std::exp(std::lgamma(0.5 * (order + 1)) - std::lgamma(0.5 * order + 1));
    return whole - std::pow(cosine, order + 1) * tail_factor(order, cosine * cosine);
  }
  // sin F(1/2, order / 2 + 1; 3/2; -tan^2), transformed so that all terms are positive:
  // sin cos^(order + 1) F(1, order / 2 + 1; 3/2; sin^2).
  const double z = sine * sine;
  double term = 1, sum = 1;
  for (int k = 0; term > 1e-17 * sum; ++k) {
    term *= z * (0.5 * order + 1 + k) / (1.5 + k);
    sum += term;
  }
  return sine * std::pow(cosine, order + 1) * sum;
}

/// By Gauss's rule of eight points, for a segment that is short against its distance.
double short_integral(double order, double x1, double x2, double y) {
  const double middle = 0.5 * (x1 + x2), half = 0.5 * (x2 - x1);
  double sum = 0;
  for (const auto& [place, weight] : gauss8)
    for (const double x : {middle - half * place, middle + half * place})
      sum += weight * std::pow(x * x + y * y, -0.5 * order - 1);
  return half * sum;
}

/// The coefficients of (t / (e^t - 1))^(1/2) by powers of t: what dtheta is in dw, where
/// cos theta = exp(-w^2 / 2) and t = w^2.
constexpr std::array<double, 11> angle_series = {1,
                                                 -1.0 / 4,
                                                 1.0 / 96,
                                                 1.0 / 384,
                                                 -1.0 / 10240,
                                                 -19.0 / 368640,
                                                 79.0 / 61931520,
                                                 55.0 / 49545216,
                                                 -2339.0 / 118908518400,
                                                 -11813.0 / 475634073600,
                                                 677.0 / 1993133260800};

/// exp(u^2) erfc(u) for u >= 0.
double scaled_erfc(double u) {
  constexpr double far = 5;
  if (u < far) return std::exp(u * u) * std::erfc(u);
  // The asymptotic series, of which twelve terms leave 1e-9 at the most.
  const double a = 0.5 / (u * u);
  double sum = 1;
  for (int k = 23; k > 0; k -= 2) sum = 1 - k * a * sum;
  return sum / (u * std::sqrt(std::numbers::pi));
}

/// The series of (2 j - 1)!! angle_series[j] / n^j: half of the integral of cos^n over all angles
/// is sqrt(pi / 2 n) times this.
double whole_series(double order) {
  double sum = 0, factor = 1;
  for (std::size_t j = 0; j < angle_series.size(); ++j) {
    sum += angle_series[j] * factor;
    factor *= (2.0 * static_cast<double>(j) + 1) / order;
  }
  return sum;
}

}  // namespace

double first_potential(double x1, double x2, double y) {
  return std::log1p(2 * (x2 - x1) / Ends(x1, x2, y).excess);
}

LowOrder::LowOrder(double order)
    : order_(order),
      half_(0.5 * std::sqrt(std::numbers::pi) *
            std::exp(std::lgamma(0.5 * (order + 1)) - std::lgamma(0.5 * order + 1))) {
  // As in cosine_power() and tail_factor(); both start with a sine over r^(order + 1).
  double near = 1, far = 1 / (order + 1);
  for (std::size_t i = 0; i < terms; ++i) {
    from_foot_[i] = near;
    beyond_[i] = far;
    const auto k = static_cast<double>(i);
    near *= (0.5 * order + 1 + k) / (1.5 + k);
    far *= (0.5 * order + 1 + k) / (0.5 * (order + 3) + k);
  }
}

void LowOrder::to_ends(std::span<const double> x, std::span<const double> y,
                       std::span<const double> p, Ends& integrals) const {
  const std::size_t count = x.size();
  Ends z, is_far, scale;
  for (std::size_t k = 0; k < count; ++k) {
    const double x2 = x[k] * x[k], y2 = y[k] * y[k], inverse = 1 / (x2 + y2);
    is_far[k] = x2 > y2 ? 1 : 0;
    z[k] = std::min(x2, y2) * inverse;
    scale[k] = std::abs(x[k]) * p[k] * inverse;
    integrals[k] = 0;
  }
  for (std::size_t i = terms; i-- > 0;) {
    const double near = from_foot_[i], change = beyond_[i] - near;
    for (std::size_t k = 0; k < count; ++k)
      integrals[k] = integrals[k] * z[k] + (near + is_far[k] * change);
  }
  for (std::size_t k = 0; k < count; ++k) integrals[k] *= scale[k];
}

void LowOrder::integrals(std::span<const double> x1, std::span<const double> x2,
                         std::span<const double> y, std::span<const double> p1,
                         std::span<const double> p2, std::span<double> integrals) const {
  Ends first, last;
  to_ends(x1, y, p1, first);
  to_ends(x2, y, p2, last);
  for (std::size_t k = 0; k < x1.size(); ++k) {
    const double size = std::abs(y[k]);
    const bool first_far = std::abs(x1[k]) > size, last_far = std::abs(x2[k]) > size;
    const bool around = x1[k] < 0 && x2[k] > 0, behind = !around && x2[k] <= 0;
    if (!around && first_far && last_far) {
      integrals[k] = behind ? last[k] - first[k] : first[k] - last[k];
      continue;
    }
    // From the foot to both ends.
    const double whole = first_far || last_far ? half_ * std::pow(size, -order_ - 1) : 0;
    const double a = first_far ? whole - first[k] : first[k];
    const double b = last_far ? whole - last[k] : last[k];
    integrals[k] = around ? a + b : behind ? a - b : b - a;
  }
}

SteepTail::SteepTail(double order) : order_(order) {
  // Numerator and denominator of 1 / (1 + a(1) w / (1 + a(2) w / ...)), term by term.
  const double c = 0.5 * (order + 3);
  std::array<double, terms> above{}, below{1};  // without the last term
  above_[0] = below_[0] = 1;
  for (std::size_t k = 1; k + 2 <= 2 * terms; ++k) {
    const auto i = static_cast<double>(k / 2);
    const double factor = k % 2 == 1 ? (0.5 + i) * (c - 1 + i) / ((c - 1 + 2 * i) * (c + 2 * i))
                                     : i * (c - 1.5 + i) / ((c - 2 + 2 * i) * (c - 1 + 2 * i));
    const auto next = [factor](std::array<double, terms>& last, std::array<double, terms>& before) {
      std::array<double, terms> sum = last;
      for (std::size_t j = 1; j < terms; ++j) sum[j] += factor * before[j - 1];
      before = last;
      last = sum;
    };
    next(above_, above);
    next(below_, below);
  }
  for (double& coefficient : below_) coefficient *= order + 1;
}

HighOrder::HighOrder(double order)
    : order_(order),
      half_(std::sqrt(0.5 * std::numbers::pi / order) * whole_series(order)),
      width_(std::sqrt(0.5 * order)),
      steep_(order) {}

double HighOrder::power(double square) const { return std::exp(-0.5 * order_ * std::log(square)); }

double HighOrder::tail(double x, double y, double square, double power) const {
  if (y * y <= x * x * steep_.widest()) return steep_(x, (y / x) * (y / x), power);
  const double z = y * y / square;
  // By parts, again and again: each time another power of 1 / n, and a series without its first
  // term.
  const double t = -std::log(z), w = std::sqrt(t);
  std::array<double, angle_series.size()> series = angle_series;
  double sum = 0, scale = 1;
  constexpr std::size_t most_parts = 6;
  for (std::size_t j = 1; j <= most_parts; ++j) {
    scale /= order_;
    double part = 0;
    for (std::size_t k = series.size() - 1; k >= j; --k) part = part * t + series[k];
    sum += scale * w * part;
    for (std::size_t k = j; k < series.size(); ++k) series[k] *= 2 * static_cast<double>(k - j) + 1;
  }
  return power / y * (half_ * scaled_erfc(w * width_) + sum);
}

double HighOrder::integral(double x1, double x2, double y, double power1, double power2) const {
  y = std::abs(y);
  const double square1 = x1 * x1 + y * y, square2 = x2 * x2 + y * y;
  const double first = tail(std::abs(x1), y, square1, power1);
  const double last = tail(std::abs(x2), y, square2, power2);
  if (x1 >= 0) return first - last;
  if (x2 <= 0) return last - first;
  return 2 * half_ * power(y * y) / y - first - last;
}

double segment_integral(double order, double x1, double x2, double y) {
  if (order == 0) return integral_0(x1, x2, y);
  if (order == 1) return integral_1(x1, x2, y);
  if (x2 <= 0) return segment_integral(order, -x2, -x1, y);
  y = std::abs(y);
  const double r1 = std::hypot(x1, y), r2 = std::hypot(x2, y);
  if (x1 <= 0) {
    return (cosine_power(order, -x1 / r1, y / r1) + cosine_power(order, x2 / r2, y / r2)) *
           std::pow(y, -order - 1);
  }
  if ((x2 - x1) * (order + 4) < r1) return short_integral(order, x1, x2, y);
  // Beyond the foot: a difference of tails, or of integrals from the foot.
  if (y >= x2)
    return (cosine_power(order, x2 / r2, y / r2) - cosine_power(order, x1 / r1, y / r1)) *
           std::pow(y, -order - 1);
  if (y > x1) {
    const double middle = y;
    return segment_integral(order, x1, middle, y) +
           (middle < x2 ? segment_integral(order, middle, x2, y) : 0);
  }
  const double z1 = (y / r1) * (y / r1), z2 = (y / r2) * (y / r2);
  return std::pow(r1, -order - 1) * tail_factor(order, z1) -
         std::pow(r2, -order - 1) * tail_factor(order, z2);
}

}  // namespace medial::potential
