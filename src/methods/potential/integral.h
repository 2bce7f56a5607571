#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace medial::potential {

/// J(order): the integral of dx / (x^2 + y^2)^(order / 2 + 1) over [x1, x2], relative error about
/// 1e-13. Requires order >= 0 and a segment that does not pass through the origin. Closed forms for
/// order 0 and 1; else from the series of the incomplete beta function, for any real order.
double segment_integral(double order, double x1, double x2, double y);

/// The potential of order 1, (3): log((r1 + r2 + L) / (r1 + r2 - L)), without cancellation.
double first_potential(double x1, double x2, double y);

/// J(order) of all beyond x > 0, where this is not small against y: (x^2 + y^2)^(-order / 2) /
/// ((order + 1) x) times the hypergeometric series of 1 and 1 / 2 over (order + 3) / 2 in
/// -(y / x)^2. That is an integral of Stieltjes, which lies between any two convergents of Gauss'
/// continued fraction that follow each other; of those that have `terms` coefficients the
/// difference bounds what is left out, below 1e-9 of the whole.
class SteepTail {
 public:
  /// Requires order >= 1.
  explicit SteepTail(double order);
  double order() const { return order_; }
  /// Requires w = (y / x)^2 of at most widest(), and `power` = (x^2 + y^2)^(-order / 2).
  double operator()(double x, double w, double power) const {
    double above = above_.back(), below = below_.back();
    for (std::size_t k = terms - 1; k-- > 0;) {
      above = above * w + above_[k];
      below = below * w + below_[k];
    }
    return power * above / (x * below);
  }
  double widest() const { return order_ / 32; }

 private:
  static constexpr std::size_t terms = 6;
  double order_;
  std::array<double, terms> above_{}, below_{};  ///< by powers of w; below times order + 1
};

/// The same integral at one low order, for many segments: a power series in the square of a sine or
/// of a cosine, whichever is at most a half. Requires 0 < order < 2. Absolute error below 1e-14 of
/// what half a line from a point at the distance 1 gives, where no charge is nearer than 1.
class LowOrder {
 public:
  explicit LowOrder(double order);
  double order() const { return order_; }
  /// integrals[k] becomes J(order) of [x1[k], x2[k]] at y[k], where p1[k] and p2[k] are its ends'
  /// r^-order. All spans of one size, at most `most` long.
  void integrals(std::span<const double> x1, std::span<const double> x2, std::span<const double> y,
                 std::span<const double> p1, std::span<const double> p2,
                 std::span<double> integrals) const;

  static constexpr std::size_t most = 16;

 private:
  /// Of x >= 0: the integral beyond it, where that is further than |y|, else that from the foot.
  using Ends = std::array<double, most>;
  void to_ends(std::span<const double> x, std::span<const double> y, std::span<const double> p,
               Ends& integrals) const;

  static constexpr std::size_t terms = 54;
  double order_;
  double half_;                                   ///< the integral of cos^order over a right angle
  std::array<double, terms> from_foot_, beyond_;  ///< the series' coefficients
};

/// The same integral at one high order, for many segments, in time that does not grow with the
/// order: with cos theta = exp(-w^2 / 2) it is nearly a Gaussian's, and what is left is a series in
/// 1 / order. Requires order >= least_order and no charge nearer than 1. Absolute error below 1e-9
/// of what half a line from the same nearest point would give.
class HighOrder {
 public:
  explicit HighOrder(double order);
  /// square^(-order / 2).
  double power(double square) const;
  /// J(order), where power1 and power2 are power(x1^2 + y^2) and power(x2^2 + y^2).
  double integral(double x1, double x2, double y, double power1, double power2) const;

  static constexpr double least_order = 32;

 private:
  /// J beyond x, which is 0 or more; y > 0, and `square` is x^2 + y^2.
  double tail(double x, double y, double square, double power) const;
  double order_;
  double half_;   ///< the integral of cos^order over a right angle
  double width_;  ///< sqrt(order / 2)
  SteepTail steep_;
};

}  // namespace medial::potential
