#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "support/generate_parts.h"
#include "support/nasty.h"

namespace medial::test {
namespace {

using Chains = std::vector<Chain>;
constexpr double pi = std::numbers::pi;

double one_of(Random& random, std::initializer_list<double> some) {
  return some.begin()[random.integer(0, static_cast<std::int64_t>(some.size()) - 1)];
}

/// Nothing, or up to 50 tolerances, or 1e-17 to 1e-9; of either sign.
double offset(Random& random) {
  const double size = random.chance(0.1)   ? 0
                      : random.chance(0.3) ? random.between(0, 2e-13)
                                           : random.power_of_ten(-17, -9);
  return random.chance(0.5) ? size : -size;
}

/// A circle at the origin or elsewhere, of any size, and an angle on it.
struct Circle {
  Vec2 center;
  double radius, angle;

  explicit Circle(Random& random)
      : center(random.chance(0.5)   ? Vec2{0, 0}
               : random.chance(0.5) ? Vec2{random.unit(), random.unit()}
                                    : Vec2{static_cast<double>(random.integer(-5, 5)), 3}),
        radius(one_of(random, {1, 1, 1e-3, 5, 1e3, random.between(0.1, 2)})),
        angle(random.chance(0.5) ? random.between(0, 2 * pi)
                                 : static_cast<double>(random.integer(0, 23)) * pi / 12) {}

  Vec2 at(double t, double away = 0) const { return center + polar((1 + away) * radius, t); }
  Chain point(double t, double away) const { return {{at(t, away)}}; }
  Chain point_near(Vec2 p, Random& random) const {
    return {{p + radius * Vec2{offset(random), offset(random)}}};
  }
  Chain arc(double from, double to) const {
    return {{at(from), at(to)}, {std::tan(0.25 * (to - from))}};
  }
};

/// Next to one arc: its ends, its middle, anywhere.
Chains beside(Random& random) {
  const Circle circle(random);
  const double from = circle.angle,
               to = from + one_of(random, {pi, pi / 2, 1.5 * pi, 1e-3, random.between(0.1, 6)});
  Chains chains{circle.arc(from, to)};
  for (auto i = random.integer(1, 4); i > 0; --i)
    chains.push_back(circle.point(
        one_of(random, {from, to, 0.5 * (from + to), random.between(from, to)}), offset(random)));
  return chains;
}

/// Next to a half circle's ends and centre.
Chains halves(Random& random) {
  const Circle circle(random);
  Chains chains{circle.arc(circle.angle, circle.angle + pi)};
  for (auto i = random.integer(1, 4); i > 0; --i) {
    const auto place = random.integer(0, 2);
    chains.push_back(circle.point_near(
        place == 2 ? circle.center : circle.at(circle.angle + static_cast<double>(place) * pi),
        random));
  }
  return chains;
}

/// Next to the centre of up to five arcs of one circle.
Chains centres(Random& random) {
  const Circle circle(random);
  const auto count = random.integer(1, 5);
  const double each = 2 * pi / static_cast<double>(count);
  Chains chains;
  for (std::int64_t i = 0; i < count; ++i) {
    const double from = circle.angle + static_cast<double>(i) * each;
    chains.push_back(circle.arc(from, from + each * one_of(random, {1, 0.5, 0.9})));
  }
  for (auto i = random.integer(1, 2); i > 0; --i)
    chains.push_back(circle.point_near(circle.center, random));
  return chains;
}

/// Next to the joints of arcs of one circle, all around or not.
Chains joints(Random& random, bool closed) {
  const Circle circle(random);
  const auto count = random.integer(2, 9);
  const double span = closed ? 2 * pi : one_of(random, {pi, random.between(0.1, 6)}),
               each = span / static_cast<double>(count);
  const auto joint = [&](std::int64_t i) { return circle.angle + static_cast<double>(i) * each; };
  Chain arcs;
  arcs.closed = closed;
  for (std::int64_t i = 0; i < count + (closed ? 0 : 1); ++i) {
    arcs.points.push_back(circle.at(joint(i)));
    if (closed || i < count) arcs.bulges.push_back(std::tan(0.25 * each));
  }
  Chains chains{arcs};
  for (auto i = random.integer(1, 5); i > 0; --i)
    chains.push_back(circle.point(random.chance(0.6)
                                      ? joint(random.integer(0, count))
                                      : random.between(circle.angle, circle.angle + span),
                                  offset(random)));
  if (random.chance(0.3)) chains.push_back({{circle.center}});
  if (random.chance(0.3)) chains.push_back({{circle.center, circle.at(joint(1))}});
  return chains;
}
Chains loops(Random& random) { return joints(random, true); }
Chains open_chains(Random& random) { return joints(random, false); }

/// Next to a node of two circles.
Chains nodes(Random& random) {
  const double turn = Circle(random).angle;
  const auto circle_of = [&](double radius) {
    return Chain{{{0, 0}, turned({0, 2 * radius}, turn)}, {1, 1}, true};
  };
  Chains chains{circle_of(one_of(random, {1, 0.5, random.between(0.1, 1)})),
                circle_of(-one_of(random, {1, 2, random.between(0.1, 1)}))};
  const double away = random.power_of_ten(-15, -3);
  for (auto i = random.integer(1, 3); i > 0; --i)
    chains.push_back(
        {{turned({one_of(random, {1, -1, random.between(-1, 1)}) * away, offset(random)}, turn)}});
  return chains;
}

/// Inside a circle of few arcs: its centre, around it, anywhere; and sometimes outside.
Chains stacks(Random& random) {
  const Circle circle(random);
  const auto count = random.integer(2, 4);
  const double each = 2 * pi / static_cast<double>(count);
  Chain arcs{{}, {}, true};
  for (std::int64_t i = 0; i < count; ++i) {
    arcs.points.push_back(circle.at(circle.angle + static_cast<double>(i) * each));
    arcs.bulges.push_back(std::tan(0.25 * each));
  }
  Chains chains{arcs};
  for (auto i = random.integer(1, 3); i > 0; --i)
    chains.push_back(circle.point(random.between(0, 2 * pi),
                                  one_of(random, {0, offset(random), random.between(0, 0.5)}) - 1));
  if (random.chance(0.5))
    chains.push_back(circle.point(circle.angle, one_of(random, {offset(random), 0.5, 1})));
  return chains;
}

/// Next to the joints and centres of a slot.
Chains slots(Random& random) {
  const Circle circle(random);
  const Vec2 way = polar(circle.radius * random.between(0.1, 4), circle.angle),
             out = polar(circle.radius, circle.angle + 0.5 * pi), a = circle.center, b = a + way;
  const Chain slot{{a - out, b - out, b + out, a + out}, {0, 1, 0, 1}, true};
  Chains chains{slot};
  const std::array<Vec2, 6> places{a, b, a - out, b - out, b + out, a + out};
  for (auto i = random.integer(1, 3); i > 0; --i)
    chains.push_back(
        circle.point_near(places[static_cast<std::size_t>(random.integer(0, 5))], random));
  return chains;
}

/// Between two arcs that share their ends, flat ones as well.
Chains lenses(Random& random) {
  const double height = random.power_of_ten(-11, -1),
               other = height * one_of(random, {1 + 1e-3, 2, 1.5, -1, 0});
  Chains chains{{{{-1, 0}, {1, 0}}, {-height}}, {{{-1, 0}, {1, 0}}, {-other}}};
  for (auto i = random.integer(0, 3); i > 0; --i)
    chains.push_back({{{one_of(random, {0, random.between(-1, 1)}),
                        one_of(random, {height * random.unit(), 0.5 * height})}}});
  return chains;
}

/// Circles that touch, up to rounding or not at all, and points where they do.
Chains touching(Random& random) {
  const Circle circle(random);
  const auto circle_at = [](Vec2 center, double radius, double angle) {
    return Chain{{center + polar(radius, angle), center - polar(radius, angle)}, {1, 1}, true};
  };
  Chains chains{circle_at(circle.center, circle.radius, circle.angle)};
  for (auto i = random.integer(2, 4); i > 0; --i) {
    const double t = random.between(0, 2 * pi),
                 radius = circle.radius * one_of(random, {0.5, 0.25, 0.3, 1}),
                 away = circle.radius * (1 + offset(random)) + radius;
    if (random.chance(0.5))
      chains.push_back(circle_at(circle.center + polar(away, t), radius, random.between(0, pi)));
    else
      chains.push_back(circle.point(t, offset(random)));
  }
  return chains;
}

constexpr std::array<NastyGraphClass, 10> classes{{{"beside", beside},
                                                   {"halves", halves},
                                                   {"centres", centres},
                                                   {"loops", loops},
                                                   {"open", open_chains},
                                                   {"nodes", nodes},
                                                   {"stacks", stacks},
                                                   {"slots", slots},
                                                   {"lenses", lenses},
                                                   {"touching", touching}}};

}  // namespace

std::span<const NastyGraphClass> nasty_graph_classes() { return classes; }

std::vector<Chain> nasty_graph(const NastyGraphClass& one, std::uint64_t seed) {
  Random random(seed);
  return one.generate(random);
}

}  // namespace medial::test
