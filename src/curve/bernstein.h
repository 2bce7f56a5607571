#pragma once

namespace medial::curve {

/// The largest degree of a Bezier piece.
inline constexpr int max_degree = 32;
/// The largest degree of a polynomial made of one: see apex_polynomial().
inline constexpr int max_polynomial_degree = 9 * max_degree;

/// An array for a known number of values at most: indexed by int, and not initialised.
template <class T, int N>
struct Fixed {
  T items[N];

  T& operator[](int i) { return items[i]; }
  const T& operator[](int i) const { return items[i]; }
  T* begin() { return items; }
  const T* begin() const { return items; }
  T* data() { return items; }
  const T* data() const { return items; }
  static constexpr int size() { return N; }
};

/// A polynomial on [0, 1] as the sum of c[i] t^i (1 - t)^(degree - i): Bernstein form without the
/// binomials, in which a product is a plain convolution. Of its formal degree: the leading terms
/// may cancel.
struct Polynomial {
  int degree = 0;
  /// A bound on the Bernstein coefficients of what was added up: the rounding errors of the
  /// coefficients are some units in the last place of this, whatever has cancelled.
  double magnitude = 0;
  Fixed<double, max_polynomial_degree + 1> c;  // only [0, degree] is ever used

  // Not initialised: most are of a small degree.
  Polynomial() {}  // NOLINT(modernize-use-equals-default)
};

/// The polynomial with these Bernstein coefficients.
Polynomial from_bernstein(const double* coefficients, int degree);
Polynomial product(const Polynomial& a, const Polynomial& b);
/// a + factor * b, both of one degree.
Polynomial sum(const Polynomial& a, double factor, const Polynomial& b);
Polynomial derivative(const Polynomial& a);

// A polynomial in this form is homogeneous in t and s = 1 - t.
Polynomial by_t(const Polynomial& a);  ///< partial derivative
Polynomial by_s(const Polynomial& a);
/// a'b - ab' for two of one degree n, by a_t b_s - a_s b_t = n (a'b - ab'): of degree 2n - 2, two
/// less than the products have.
Polynomial wronskian(const Polynomial& a, const Polynomial& b);

/// Parameters in [0, 1], increasing.
struct Roots {
  int count = 0;
  Fixed<double, 2 * max_polynomial_degree> t;

  Roots() {}  // NOLINT(modernize-use-equals-default)

  void add(double root) {
    if (count < t.size()) t[count++] = root;
  }
};

/// All parameters in [0, 1] where the polynomial changes its sign, and those of its zeros at 0 and
/// 1: none is missed, for the number of sign changes of the coefficients bounds the number of roots
/// (Descartes' rule in Bernstein form) and an interval is halved until it is 0 or 1. Coefficients
/// below their rounding errors count as zero: a polynomial that is nothing but rounding has no
/// inner roots, and a zero where it does not change its sign may be left out.
Roots roots(const Polynomial& polynomial);

}  // namespace medial::curve
