#include "methods/potential/moments.h"

#include <algorithm>

namespace medial::potential {
namespace {

/// Gauss's rule on [-1, 1], exact up to degree 13.
struct Place {
  double at, weight;
};
constexpr std::array<Place, 7> rule{{{-0.9491079123427585, 0.1294849661688697},
                                     {-0.7415311855993945, 0.2797053914892766},
                                     {-0.4058451513773972, 0.3818300505051189},
                                     {0, 0.4179591836734694},
                                     {0.4058451513773972, 0.3818300505051189},
                                     {0.7415311855993945, 0.2797053914892766},
                                     {0.9491079123427585, 0.1294849661688697}}};

using Powers = std::array<Vec2, Moments::degree + 1>;

Powers powers_of(Vec2 w) {
  Powers powers{{{1, 0}}};
  for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = product(powers[i - 1], w);
  return powers;
}

constexpr auto binomials = [] {
  std::array<std::array<double, Moments::degree + 1>, Moments::degree + 1> rows{};
  for (std::size_t n = 0; n < rows.size(); ++n) {
    rows[n][0] = 1;
    for (std::size_t k = 1; k <= n; ++k) rows[n][k] = rows[n - 1][k - 1] + rows[n - 1][k];
  }
  return rows;
}();

}  // namespace

void Moments::add(Vec2 start, Vec2 tangent, double length) {
  for (const Place& place : rule) {
    const Vec2 w = start + 0.5 * (1 + place.at) * length * tangent;
    const double square = squared_norm(w);
    Vec2 power{0.5 * place.weight * length, 0};
    for (std::size_t more = 0; more <= degree; ++more, power = product(power, w)) {
      Vec2 term = power;
      for (std::size_t k = 0; more + 2 * k <= degree; ++k, term = square * term)
        values_[row[more] + k] = values_[row[more] + k] + term;
    }
  }
}

void Moments::add(const Moments& other, Vec2 shift) {
  const Powers powers = powers_of(shift);
  const auto of_other = [&](std::size_t j, std::size_t k) {
    return j >= k ? other(j - k, k) : conjugate(other(k - j, j));
  };
  for (std::size_t more = 0; more <= degree; ++more)
    for (std::size_t k = 0; more + 2 * k <= degree; ++k) {
      const std::size_t j = k + more;
      Vec2 sum;
      for (std::size_t a = 0; a <= j; ++a) {
        Vec2 inner;
        for (std::size_t b = 0; b <= k; ++b)
          inner = inner + product(binomials[k][b] * conjugate(powers[k - b]), of_other(a, b));
        sum = sum + product(binomials[j][a] * powers[j - a], inner);
      }
      values_[row[more] + k] = values_[row[more] + k] + sum;
    }
}

}  // namespace medial::potential
