#pragma once

#include "curve/bernstein.h"

namespace medial::curve {

/// Binomials of a degree n, and the inverses of those of 2n.
struct Binomials {
  Fixed<double, max_degree + 1> row;
  Fixed<double, 2 * max_degree + 1> inverse_double_row;
};

inline const Binomials& binomials_of(int degree) {
  static const auto table = [] {
    Fixed<Binomials, max_degree + 1> all{};
    for (int n = 0; n <= max_degree; ++n) {
      double binomial = 1;
      for (int i = 0; i <= n; ++i) {
        all[n].row[i] = binomial;
        binomial = binomial * (n - i) / (i + 1);
      }
      binomial = 1;
      for (int i = 0; i <= 2 * n; ++i) {
        all[n].inverse_double_row[i] = 1 / binomial;
        binomial = binomial * (2 * n - i) / (i + 1);
      }
    }
    return all;
  }();
  return table[degree];
}

}  // namespace medial::curve
