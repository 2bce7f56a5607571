#pragma once

// Truncated power series, which give all derivatives of a formula at once.

#include <cmath>
#include <cstddef>
#include <vector>

namespace medial::ops {

/// sum of terms[k] * u^k. All operands of one formula have the same number of terms, at least one.
struct PowerSeries {
  std::vector<double> terms;

  explicit PowerSeries(std::size_t size) : terms(size, 0.0) {}
  std::size_t size() const { return terms.size(); }
  double value() const { return terms[0]; }

  /// d/du. The last term is unknown and becomes 0.
  PowerSeries derivative() const {
    PowerSeries out(size());
    for (std::size_t k = 1; k < size(); ++k) out.terms[k - 1] = static_cast<double>(k) * terms[k];
    return out;
  }
};

inline PowerSeries operator+(PowerSeries a, const PowerSeries& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a.terms[k] += b.terms[k];
  return a;
}
inline PowerSeries operator-(PowerSeries a, const PowerSeries& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a.terms[k] -= b.terms[k];
  return a;
}
inline PowerSeries operator*(const PowerSeries& a, const PowerSeries& b) {
  PowerSeries out(a.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i <= k; ++i) out.terms[k] += a.terms[i] * b.terms[k - i];
  return out;
}
/// From out * b = a, term by term.
inline PowerSeries operator/(const PowerSeries& a, const PowerSeries& b) {
  PowerSeries out(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    double rest = a.terms[k];
    for (std::size_t i = 1; i <= k; ++i) rest -= b.terms[i] * out.terms[k - i];
    out.terms[k] = rest / b.terms[0];
  }
  return out;
}
/// From out * out = a, term by term.
inline PowerSeries sqrt(const PowerSeries& a) {
  PowerSeries out(a.size());
  out.terms[0] = std::sqrt(a.terms[0]);
  for (std::size_t k = 1; k < a.size(); ++k) {
    double rest = a.terms[k];
    for (std::size_t i = 1; i < k; ++i) rest -= out.terms[i] * out.terms[k - i];
    out.terms[k] = rest / (2 * out.terms[0]);
  }
  return out;
}

}  // namespace medial::ops
