// The potential and the force of charged segments against their definitions, by quadrature.

#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <vector>

#include "methods/potential/force.h"
#include "methods/potential/integral.h"
#include "support/generate.h"

namespace medial::test {
namespace {

using potential::Charge;
using potential::Charges;
using potential::Evaluator;
using potential::Force;

double integrate(const auto& f, double a, double b) {
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, a, b, 3, 1e-10);
}

std::vector<Charge> border_of(const Rings& rings) {
  std::vector<Charge> pieces;
  for (const Ring& ring : rings)
    for (std::size_t i = 0; i < ring.points.size(); ++i)
      pieces.push_back({ring.points[i], ring.points[(i + 1) % ring.points.size()], 0});
  return pieces;
}

/// The force by its definition, times distance^n.
Force by_definition(const std::vector<Charge>& pieces, Vec2 p, double order, double distance) {
  Force sum;
  for (const Charge& piece : pieces) {
    const double length = medial::distance(piece.start, piece.end);
    const Vec2 tangent = (1 / length) * (piece.end - piece.start);
    // Divided where the integrand is largest.
    const double foot = std::clamp(dot(p - piece.start, tangent), 0.0, length);
    const auto term = [&](double s) {
      const Vec2 v = (1 / distance) * (p - piece.start - s * tangent);
      return std::pair(v, std::pow(squared_norm(v), -0.5 * order - 1) / distance);
    };
    const auto add = [&](double a, double b) {
      if (!(a < b)) return;
      sum.force.x += integrate([&](double s) { return term(s).first.x * term(s).second; }, a, b);
      sum.force.y += integrate([&](double s) { return term(s).first.y * term(s).second; }, a, b);
      const auto derivative = [&](int which) {
        return integrate(
            [&](double s) {
              const auto [v, weight] = term(s);
              const double first = (order + 2) * weight / squared_norm(v);
              return which == 0   ? weight - first * v.x * v.x
                     : which == 1 ? -first * v.x * v.y
                                  : weight - first * v.y * v.y;
            },
            a, b);
      };
      sum.xx += derivative(0);
      sum.xy += derivative(1);
      sum.yy += derivative(2);
    };
    // Near the foot the integrand is as narrow as the distance.
    double inner = std::min(distance, length);
    std::vector<double> cuts = {0, foot, length};
    for (; inner < length; inner *= 4) {
      cuts.push_back(std::clamp(foot - inner, 0.0, length));
      cuts.push_back(std::clamp(foot + inner, 0.0, length));
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) add(cuts[i], cuts[i + 1]);
  }
  return sum;
}

void expect_near(const Force& a, const Force& b, double tolerance) {
  EXPECT_NEAR(a.force.x, b.force.x, tolerance);
  EXPECT_NEAR(a.force.y, b.force.y, tolerance);
  EXPECT_NEAR(a.xx, b.xx, 10 * tolerance);
  EXPECT_NEAR(a.xy, b.xy, 10 * tolerance);
  EXPECT_NEAR(a.yy, b.yy, 10 * tolerance);
}

TEST(PotentialField, IntegralsMatchQuadratureAtAnyRealOrder) {
  Random random(1);
  for (int i = 0; i < 400; ++i) {
    const double y = random.power_of_ten(-3, 1) * (random.chance(0.5) ? 1 : -1);
    const double x1 = random.between(-5, 5), x2 = x1 + random.power_of_ten(-3, 1);
    const double order = i % 4 == 0 ? i % 3 : random.between(0, 12);
    const auto f = [&](double x) { return std::pow(x * x + y * y, -0.5 * order - 1); };
    double expected = 0;
    std::vector<double> cuts = {x1, x2, std::clamp(0.0, x1, x2)};
    for (double w = std::abs(y); w < 20; w *= 2) {
      cuts.push_back(std::clamp(w, x1, x2));
      cuts.push_back(std::clamp(-w, x1, x2));
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
      if (cuts[k] < cuts[k + 1]) expected += integrate(f, cuts[k], cuts[k + 1]);
    EXPECT_NEAR(potential::segment_integral(order, x1, x2, y) / expected, 1, 1e-11)
        << order << " " << x1 << " " << x2 << " " << y;
  }
}

TEST(PotentialField, IntegralsSideBySideAreThoseOneByOne) {
  Random random(4);
  constexpr std::size_t count = potential::LowOrder::most;
  for (int i = 0; i < 100; ++i) {
    const double order = random.between(0.01, 1.99);
    std::array<double, count> x1, x2, y, p1, p2, found;
    for (std::size_t k = 0; k < count; ++k) {
      // At least 1 away: beside a piece, or beyond its end.
      const bool beside = k % 2 == 0;
      const double from = random.power_of_ten(-3, 1), length = random.power_of_ten(-6, 1);
      y[k] = (beside ? random.between(1, 4) : random.power_of_ten(-6, 0)) * (k % 4 < 2 ? 1 : -1);
      x1[k] = beside ? random.between(-5, 5) : 1 + from;
      x2[k] = x1[k] + length;
      if (k % 8 == 5) std::swap(x1[k] *= -1, x2[k] *= -1);
      p1[k] = std::pow(x1[k] * x1[k] + y[k] * y[k], -0.5 * order);
      p2[k] = std::pow(x2[k] * x2[k] + y[k] * y[k], -0.5 * order);
    }
    potential::LowOrder(order).integrals(x1, x2, y, p1, p2, found);
    for (std::size_t k = 0; k < count; ++k)
      EXPECT_NEAR(found[k], potential::segment_integral(order, x1[k], x2[k], y[k]), 1e-13)
          << order << " " << x1[k] << " " << x2[k] << " " << y[k];
  }
}

TEST(PotentialField, IntegralsOfHighOrderMatchQuadrature) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double order = i % 2 == 0 ? std::exp2(5 + i % 8) : random.between(32, 4096);
    // No nearer than 1, and not much further: beyond the foot, around it, or steeply aside.
    double y = random.between(1, 1.2), x1 = -random.power_of_ten(-4, 1);
    double x2 = random.power_of_ten(-4, 1);
    if (i % 3 > 0) {
      y = i % 3 == 1 ? random.between(0.7, 1) : random.power_of_ten(-8, -0.01);
      x1 = std::sqrt(1 - y * y) + random.power_of_ten(-8, -1);
      x2 = x1 + random.power_of_ten(-4, 1);
    }
    if (random.chance(0.3)) {
      std::swap(x1, x2);
      x1 = -x1;
      x2 = -x2;
    }
    const auto f = [&](double x) { return std::pow(x * x + y * y, -0.5 * order - 1); };
    double expected = 0;
    const double nearest = std::clamp(0.0, x1, x2);
    std::vector<double> cuts = {x1, x2, nearest};
    for (double w = 0.1 / order; w < 20; w *= 2) {
      cuts.push_back(std::clamp(nearest + w, x1, x2));
      cuts.push_back(std::clamp(nearest - w, x1, x2));
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
      if (cuts[k] < cuts[k + 1]) expected += integrate(f, cuts[k], cuts[k + 1]);
    const potential::HighOrder high(order);
    const double p1 = high.power(x1 * x1 + y * y), p2 = high.power(x2 * x2 + y * y);
    EXPECT_NEAR(high.integral(x1, x2, y, p1, p2), expected, 1e-10)
        << order << " " << x1 << " " << x2 << " " << y;
  }
}

/// Off by less than 1e-9 of the whole, at any order, as far as it may be asked for.
TEST(PotentialField, SteepTailsMatchQuadrature) {
  Random random(20261127);
  for (int i = 0; i < 2000; ++i) {
    const double order = i % 2 == 0 ? 1 + i % 40 : random.power_of_ten(0, 3.6);
    const potential::SteepTail tail(order);
    const double w = tail.widest() * (i % 5 == 0 ? 1 : random.power_of_ten(-6, 0));
    const double x = random.power_of_ten(-1, 1), y = x * std::sqrt(w);
    // In units of (x^2 + y^2)^(-order / 2), over u = x / (x + ...): from 1 to 0.
    const auto f = [&](double u) {
      const double far = x / u;
      return std::pow((far * far + y * y) / (x * x + y * y), -0.5 * order - 1) / (x * x + y * y) *
             x / (u * u);
    };
    double expected = 0;
    for (double from = 1, step = 0.5 / order; from > 0; step *= 1.5) {
      const double to = std::max(0.0, from - step);
      expected += integrate(f, to, from);
      from = to;
    }
    EXPECT_NEAR(tail(x, w, 1) / expected, 1, 1e-9) << order << " " << w;
  }
}

TEST(PotentialField, ForcesMatchTheirDefinition) {
  Random random(7);
  const std::vector<Rings> shapes = {rectangle(4, 2), l_shape(1), jagged_star(9), comb(3)};
  int places = 0;
  for (const Rings& rings : shapes) {
    const std::vector<Charge> pieces = border_of(rings);
    const Charges charges(pieces);
    Evaluator evaluator(charges);
    for (int i = 0; i < 12; ++i) {
      // Anywhere, near a segment, near an end, or on the line of one.
      const Charge& piece = pieces[random.next() % pieces.size()];
      const Vec2 along = piece.end - piece.start;
      Vec2 p{random.between(-1, 5), random.between(-1, 4)};
      const double close = random.power_of_ten(-6, -1);
      if (i % 4 == 1) p = piece.start + random.unit() * along + close * left_of(along);
      if (i % 4 == 2) p = piece.end + close * Vec2{random.between(-1, 1), random.between(-1, 1)};
      if (i % 4 == 3) p = piece.end + (close + random.unit()) * along;
      const double distance = evaluator.place(p).distance;
      if (!(distance > 1e-7)) continue;
      ++places;
      for (const double order :
           {1.0, 2.0, 3.0, 4.0, 8.0, 17.0, 33.5, 64.0, 300.0, 2.5, 1.25, 3.75}) {
        SCOPED_TRACE(testing::Message() << "order " << order << " at " << p.x << " " << p.y);
        expect_near(evaluator.force(order), by_definition(pieces, p, order, distance), 1e-6);
      }
    }
  }
  EXPECT_GT(places, 30);
}

TEST(PotentialField, AllOrdersInOnePassAreTheSame) {
  const Charges charges(border_of(comb(5)));
  Evaluator evaluator(charges);
  evaluator.place({2.3, 0.7});
  std::vector<Force> all(64);
  evaluator.forces(1, all);
  for (int order = 1; order <= 64; ++order)
    expect_near(all[static_cast<std::size_t>(order - 1)], evaluator.force(order), 1e-8);
}

TEST(PotentialField, TheTreeKeepsItsBound) {
  const std::vector<Charge> pieces = border_of(maze(4000));
  const Charges charges(pieces);
  Evaluator evaluator(charges);
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Vec2 p{random.between(20, 200), random.between(20, 200)};
    const double distance = evaluator.place(p).distance;
    if (distance < 0.1) continue;
    for (const double order : {1.0, 2.0, 2.5, 5.0, 12.0, 24.0, 40.0}) {
      Force sum;
      // One piece after another has no far field.
      for (const Charge& piece : pieces) {
        const Charges one({piece});
        Evaluator alone(one);
        const double ratio = distance / alone.place(p).distance;
        const Force f = alone.force(order);
        const double scale = std::pow(ratio, order);
        sum.force = sum.force + scale * f.force;
        sum.xx += scale * ratio * f.xx;
        sum.xy += scale * ratio * f.xy;
        sum.yy += scale * ratio * f.yy;
      }
      const Force found = evaluator.force(order);
      EXPECT_LT(medial::distance(found.force, sum.force), 2 * Evaluator::far_field) << order;
      for (const auto derivative : {&Force::xx, &Force::xy, &Force::yy})
        EXPECT_NEAR(found.*derivative, sum.*derivative, 10 * Evaluator::far_field) << order;
      // A step needs the direction only.
      EXPECT_LT(medial::distance(evaluator.direction(order).force, sum.force),
                Evaluator::rough_share * norm(sum.force) + 2 * Evaluator::far_field)
          << order;
    }
  }
}

/// Distant charges are summed by moments, so few of the charges are summed one by one.
TEST(PotentialField, AForceCostsLessThanAllCharges) {
  const Charges charges(border_of(maze(16000)));
  Evaluator evaluator(charges);
  Random random(5);
  std::uint64_t work = 0;
  int forces = 0;
  while (forces < 100) {
    if (evaluator.place({random.between(20, 100), random.between(20, 100)}).distance < 0.3)
      continue;
    const std::uint64_t before = evaluator.work();
    evaluator.force(1);
    work += evaluator.work() - before;
    ++forces;
  }
  EXPECT_LT(static_cast<double>(work) / forces, 0.4 * static_cast<double>(charges.size()));
}

/// Adjacent charges form one set, wherever the boundary passes.
TEST(PotentialField, AForceDoesNotDependOnTheOrderOfHoles) {
  std::vector<Charge> pieces;
  for (int i = 0; i < 2500; ++i) {
    const Vec2 low{3.0 * (i % 50), 3.0 * (i / 50)};
    const std::array<Vec2, 4> corners{low, low + Vec2{0, 1}, low + Vec2{1, 1}, low + Vec2{1, 0}};
    for (std::size_t k = 0; k < 4; ++k) pieces.push_back({corners[k], corners[(k + 1) % 4]});
  }
  std::vector<Charge> shuffled;
  for (std::uint32_t i = 0; i < 2500; ++i)
    for (std::uint32_t k = 0; k < 4; ++k) shuffled.push_back(pieces[4 * (i * 77 % 2500) + k]);
  const Charges in_rows(pieces), anyhow(shuffled);
  Evaluator one(in_rows), other(anyhow);
  const Vec2 p{22.1, 31.7};
  const auto nearest = other.place(p);
  EXPECT_EQ(one.place(p).distance, nearest.distance);
  EXPECT_EQ(medial::distance(shuffled[nearest.piece].start, p),
            medial::distance(pieces[in_rows.nearest(p).piece].start, p));
  EXPECT_EQ(one.force(1).force, other.force(1).force);
  EXPECT_EQ(one.work(), other.work());
  EXPECT_LT(one.work(), pieces.size() / 4);
}

TEST(PotentialField, ThePotentialMatchesItsDefinition) {
  const std::vector<Charge> pieces = border_of(l_shape(1));
  const Charges charges(pieces);
  Evaluator evaluator(charges);
  for (const Vec2 p : {Vec2{0.4, 0.3}, Vec2{1.9, 0.99}, Vec2{0.01, 1.5}, Vec2{1, 0.5}}) {
    evaluator.place(p);
    for (const double order : {1.0, 1.5, 2.0, 2.7, 3.0, 3.5, 8.0, 40.0}) {
      double sum = 0;
      for (const Charge& piece : pieces) {
        const auto f = [&](double t) {
          return std::pow(distance(p, piece.start + t * (piece.end - piece.start)), -order);
        };
        for (int i = 0; i < 64; ++i)
          sum += distance(piece.start, piece.end) * integrate(f, i / 64.0, (i + 1) / 64.0);
      }
      const auto [force, log_potential] = evaluator.field(order);
      EXPECT_NEAR(log_potential, std::log(sum), 1e-6) << order;
      EXPECT_LT(distance(force.force, evaluator.force(order).force), 1e-6) << order;
    }
  }
}

}  // namespace
}  // namespace medial::test
