#include "curve/bernstein.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace medial::curve {
namespace {

/// Intervals that are halved until they have no more than this width hold one root.
constexpr double narrowest = 0x1p-44;

/// Bernstein coefficients of a polynomial on the part [low, high] of [0, 1].
struct Part {
  int degree = 0;
  double low = 0;
  double high = 1;
  double noise = 0;  ///< bound on the rounding errors of the coefficients
  Fixed<double, max_polynomial_degree + 1> b;

  Part() {}  // NOLINT(modernize-use-equals-default)

  double parameter(double s) const { return low + s * (high - low); }
};

/// Divides by t^j (1 - t)^k: where the end coefficients are zero the part has a root at its end.
void strip(Part& part, Roots& found) {
  const auto divide = [&](bool front) {
    int& n = part.degree;
    for (int i = 0; i < n; ++i) {
      part.b[i] = front ? part.b[i + 1] * n / (i + 1) : part.b[i] * n / (n - i);
    }
    part.noise *= n--;
    found.add(front ? part.low : part.high);
  };
  while (part.degree > 0 && std::abs(part.b[0]) <= part.noise) divide(true);
  while (part.degree > 0 && std::abs(part.b[part.degree]) <= part.noise) divide(false);
}

/// Sign changes among the coefficients that are certainly not zero.
int sign_changes(const Part& part) {
  int changes = 0;
  double last = 0;
  for (int i = 0; i <= part.degree; ++i) {
    if (std::abs(part.b[i]) <= part.noise) continue;
    if (last != 0 && (part.b[i] > 0) != (last > 0)) ++changes;
    last = part.b[i];
  }
  return changes;
}

/// The one root of a part whose ends have different signs: Newton steps inside a bracket.
double only_root(const Part& part) {
  const int n = part.degree;
  const bool rising = part.b[n] > 0;
  double low = 0, high = 1;
  double s = part.b[0] / (part.b[0] - part.b[n]), last_step = 1;
  Fixed<double, max_polynomial_degree + 1> b;
  for (int step = 0; step < 100; ++step) {
    std::copy_n(part.b.begin(), n + 1, b.begin());
    for (int level = n; level > 1; --level) {
      for (int i = 0; i < level; ++i) b[i] += s * (b[i + 1] - b[i]);
    }
    const double slope = n * (b[1] - b[0]);
    const double value = b[0] + s * (b[1] - b[0]);
    if (value == 0) return s;
    ((value > 0) == rising ? high : low) = s;
    double next = s - value / slope;
    // Newton's step must stay inside the bracket and be half of the one before at most.
    if (!(next > low && next < high && 2 * std::abs(next - s) <= last_step)) {
      next = 0.5 * (low + high);
    }
    last_step = std::abs(next - s);
    if (last_step <= std::numeric_limits<double>::epsilon() * s) return next;
    s = next;
  }
  return s;
}

void isolate(Part& part, Roots& found) {
  strip(part, found);
  const int changes = sign_changes(part);
  if (changes == 0) return;
  if (changes == 1) {
    found.add(part.parameter(only_root(part)));
    return;
  }
  const double middle = part.parameter(0.5);
  if (part.high - part.low <= narrowest) {
    found.add(middle);
    return;
  }
  // De Casteljau at the middle: `left` takes the first coefficients, `part` keeps the others.
  Part left;
  left.degree = part.degree;
  left.noise = part.noise;
  left.low = part.low;
  left.high = middle;
  for (int level = 0; level <= part.degree; ++level) {
    left.b[level] = part.b[0];
    for (int i = 0; i < part.degree - level; ++i) part.b[i] = 0.5 * (part.b[i] + part.b[i + 1]);
  }
  part.low = middle;
  isolate(left, found);
  isolate(part, found);
}

}  // namespace

Polynomial from_bernstein(const double* coefficients, int degree) {
  Polynomial p;
  p.degree = degree;
  double binomial = 1;
  for (int i = 0; i <= degree; ++i) {
    p.c[i] = binomial * coefficients[i];
    p.magnitude = std::max(p.magnitude, std::abs(coefficients[i]));
    binomial *= static_cast<double>(degree - i) / (i + 1);
  }
  return p;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial p;
  p.degree = a.degree + b.degree;
  p.magnitude = a.magnitude * b.magnitude;
  std::fill_n(p.c.begin(), p.degree + 1, 0.0);
  for (int i = 0; i <= a.degree; ++i) {
    for (int j = 0; j <= b.degree; ++j) p.c[i + j] += a.c[i] * b.c[j];
  }
  return p;
}

Polynomial sum(const Polynomial& a, double factor, const Polynomial& b) {
  Polynomial p;
  p.degree = a.degree;
  p.magnitude = a.magnitude + std::abs(factor) * b.magnitude;
  for (int i = 0; i <= a.degree; ++i) p.c[i] = a.c[i] + factor * b.c[i];
  return p;
}

Polynomial derivative(const Polynomial& a) {
  Polynomial p;
  const int n = a.degree;
  if (n == 0) {
    p.c[0] = 0;
    return p;
  }
  p.degree = n - 1;
  p.magnitude = 2 * n * a.magnitude;
  for (int i = 0; i < n; ++i) p.c[i] = (i + 1) * a.c[i + 1] - (n - i) * a.c[i];
  return p;
}

Polynomial by_t(const Polynomial& a) {
  Polynomial p;
  p.degree = a.degree - 1;
  p.magnitude = a.degree * a.magnitude;
  for (int i = 0; i <= p.degree; ++i) p.c[i] = (i + 1) * a.c[i + 1];
  return p;
}

Polynomial by_s(const Polynomial& a) {
  Polynomial p;
  p.degree = a.degree - 1;
  p.magnitude = a.degree * a.magnitude;
  for (int i = 0; i <= p.degree; ++i) p.c[i] = (a.degree - i) * a.c[i];
  return p;
}

Polynomial wronskian(const Polynomial& a, const Polynomial& b) {
  Polynomial p = sum(product(by_t(a), by_s(b)), -1, product(by_s(a), by_t(b)));
  const double scale = 1.0 / a.degree;
  p.magnitude *= scale;
  for (int i = 0; i <= p.degree; ++i) p.c[i] *= scale;
  return p;
}

Roots roots(const Polynomial& polynomial) {
  Roots found;
  Part whole;
  const int n = polynomial.degree;
  whole.degree = n;
  // Each coefficient is a sum of at most some n products, each with a few roundings.
  whole.noise = 4 * (n + 1) * std::numeric_limits<double>::epsilon() * polynomial.magnitude;
  double binomial = 1;
  for (int i = 0; i <= n; ++i) {
    whole.b[i] = polynomial.c[i] / binomial;
    binomial *= static_cast<double>(n - i) / (i + 1);
  }
  isolate(whole, found);
  std::sort(found.t.begin(), found.t.begin() + found.count);
  const auto end = std::unique(found.t.begin(), found.t.begin() + found.count);
  found.count = static_cast<int>(end - found.t.begin());
  return found;
}

}  // namespace medial::curve
