#include "base/predicates.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <limits>
#include <random>
#include <vector>

namespace medial {
namespace {

using Rational = boost::multiprecision::cpp_rational;

int by_rationals(Vec2 a, Vec2 b, Vec2 c) {
  const Rational left = (Rational(a.x) - Rational(c.x)) * (Rational(b.y) - Rational(c.y));
  const Rational right = (Rational(a.y) - Rational(c.y)) * (Rational(b.x) - Rational(c.x));
  const int compared = left.compare(right);
  return (compared > 0) - (compared < 0);
}

/// The orientation must be right and antisymmetric under all six permutations.
void expect_exact(Vec2 a, Vec2 b, Vec2 c) {
  const int expected = by_rationals(a, b, c);
  const auto where = testing::Message() << std::hexfloat << a.x << ' ' << a.y << ", " << b.x << ' '
                                        << b.y << ", " << c.x << ' ' << c.y;
  EXPECT_EQ(orientation(a, b, c), expected) << where;
  EXPECT_EQ(orientation(b, c, a), expected) << where;
  EXPECT_EQ(orientation(c, a, b), expected) << where;
  EXPECT_EQ(orientation(b, a, c), -expected) << where;
  EXPECT_EQ(orientation(a, c, b), -expected) << where;
  EXPECT_EQ(orientation(c, b, a), -expected) << where;
}

TEST(Orientation, SmallIntegers) {
  for (int i = 0; i < 6 * 6 * 6 * 6; ++i) {
    const Vec2 b{static_cast<double>(i % 6), static_cast<double>(i / 6 % 6)};
    const Vec2 c{static_cast<double>(i / 36 % 6), static_cast<double>(i / 216)};
    expect_exact({2, 3}, b, c);
  }
}

TEST(Orientation, NearlyCollinear) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int zeros = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec2 shift = i % 3 == 0 ? Vec2{1e6 * uniform(random), 1e6 * uniform(random)} : Vec2{};
    const Vec2 a = shift + Vec2{uniform(random), uniform(random)};
    const Vec2 b = shift + Vec2{uniform(random), uniform(random)};
    Vec2 c = a + 3 * uniform(random) * (b - a);
    if (i % 5 == 0) c = midpoint(a, b);
    if (i % 7 == 0) c.x = std::nextafter(c.x, 2.0);
    zeros += by_rationals(a, b, c) == 0;
    expect_exact(a, b, c);
  }
  EXPECT_GT(zeros, 10);
}

TEST(Orientation, AllMagnitudes) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  constexpr double small = std::numeric_limits<double>::min();
  constexpr double huge = std::numeric_limits<double>::max();
  const std::vector<double> values = {0,    tiny,  -tiny,  3 * tiny, small,   -small,  1e-200,
                                      1,    -1,    0.1,    1e-9,     1e12,    1e200,   -1e200,
                                      huge, -huge, 1e-160, 0x1p-481, 0x1p480, 0x1p481, huge / 2};
  std::mt19937_64 random(2);
  const auto pick = [&] { return values[random() % values.size()]; };
  for (int i = 0; i < 3000; ++i) {
    expect_exact({pick(), pick()}, {pick(), pick()}, {pick(), pick()});
  }
}

TEST(Orientation, ScaledTriples) {
  // Exactly collinear and one unit off, at every power of two.
  for (int k = -1074; k <= 1020; k += 3) {
    const double unit = std::ldexp(1.0, k);
    expect_exact({0, 0}, {unit, unit}, {3 * unit, 3 * unit});
    EXPECT_EQ(orientation({0, 0}, {unit, unit}, {3 * unit, 2 * unit}), -1);
    EXPECT_EQ(orientation({0, 0}, {unit, unit}, {2 * unit, 3 * unit}), 1);
    EXPECT_EQ(orientation({unit, 0}, {2 * unit, unit}, {4 * unit, 3 * unit}), 0);
  }
}

TEST(LexicographicLess, OrdersByXThenY) {
  EXPECT_TRUE(lexicographic_less({0, 9}, {1, 0}));
  EXPECT_TRUE(lexicographic_less({1, 0}, {1, 1}));
  EXPECT_FALSE(lexicographic_less({1, 1}, {1, 1}));
  EXPECT_FALSE(lexicographic_less({1, 0}, {0, 9}));
  EXPECT_FALSE(lexicographic_less({0.0, 0}, {-0.0, 0}));
}

TEST(StrictlyBetween, ExcludesTheEnds) {
  EXPECT_TRUE(strictly_between({0, 0}, {1, 1}, {3, 3}));
  EXPECT_TRUE(strictly_between({0, 3}, {0, 1}, {0, 0}));
  EXPECT_FALSE(strictly_between({0, 0}, {0, 0}, {3, 3}));
  EXPECT_FALSE(strictly_between({0, 0}, {4, 4}, {3, 3}));
}

int in_circle_by_rationals(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
  const Rational ux = Rational(a.x) - Rational(p.x), uy = Rational(a.y) - Rational(p.y);
  const Rational vx = Rational(b.x) - Rational(p.x), vy = Rational(b.y) - Rational(p.y);
  const Rational wx = Rational(c.x) - Rational(p.x), wy = Rational(c.y) - Rational(p.y);
  const Rational sum = (ux * ux + uy * uy) * (vx * wy - wx * vy) +
                       (vx * vx + vy * vy) * (wx * uy - ux * wy) +
                       (wx * wx + wy * wy) * (ux * vy - vx * uy);
  return sum.sign();
}

/// In all orders that keep the orientation, and in one that turns it.
void expect_exact(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
  const int expected = in_circle_by_rationals(a, b, c, p);
  const auto where = testing::Message()
                     << std::hexfloat << a.x << ' ' << a.y << ", " << b.x << ' ' << b.y << ", "
                     << c.x << ' ' << c.y << ", " << p.x << ' ' << p.y;
  EXPECT_EQ(in_circle(a, b, c, p), expected) << where;
  EXPECT_EQ(in_circle(b, c, a, p), expected) << where;
  EXPECT_EQ(in_circle(c, a, b, p), expected) << where;
  EXPECT_EQ(in_circle(b, a, c, p), -expected) << where;
}

TEST(InCircle, GridsAndCircles) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int zeros = 0;
  const auto check = [&](Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
    zeros += in_circle_by_rationals(a, b, c, p) == 0;
    expect_exact(a, b, c, p);
  };
  for (int i = 0; i < 1500; ++i) {
    const auto grid = [&] { return Vec2{double(random() % 5), double(random() % 5)}; };
    check(grid(), grid(), grid(), grid());
    const auto on_circle = [&] {
      const double angle = 4 * uniform(random);
      return Vec2{1e3 + std::cos(angle), std::sin(angle)};
    };
    check(on_circle(), on_circle(), on_circle(), on_circle());
    // Rectangles turned are not quite ones, but for some.
    const Vec2 corner{uniform(random), uniform(random)};
    const Vec2 u{uniform(random), uniform(random)}, v{-u.y, u.x};
    check(corner, corner + u, corner + u + v, corner + v);
    const double x = 0.25 * static_cast<double>(random() % 8), y = uniform(random);
    check({-x, -y}, {x, -y}, {x, y}, {-x, y});
  }
  EXPECT_GT(zeros, 1000);
}

TEST(InCircle, AllMagnitudes) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  constexpr double huge = std::numeric_limits<double>::max();
  const std::vector<double> values = {0,     tiny, -tiny, 3 * tiny, 1e-200,   -1e-160, 1,
                                      -1,    0.1,  1e-9,  1e12,     1e200,    -1e200,  huge,
                                      -huge, 2,    1e100, -1e100,   0x1p-481, huge / 2};
  std::mt19937_64 random(4);
  const auto pick = [&] { return values[random() % values.size()]; };
  for (int i = 0; i < 300; ++i)
    expect_exact({pick(), pick()}, {pick(), pick()}, {pick(), pick()}, {pick(), pick()});
}

}  // namespace
}  // namespace medial
