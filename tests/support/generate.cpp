#include "support/generate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "support/corridors.h"
#include "support/generate_parts.h"

namespace medial::test {

std::uint64_t Random::next() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double Random::unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }

std::int64_t Random::integer(std::int64_t low, std::int64_t high) {
  // The bias of the remainder is below range / 2^64: nothing that a test could see.
  return low + static_cast<std::int64_t>(next() % static_cast<std::uint64_t>(high - low + 1));
}

double Random::power_of_ten(double low, double high) { return std::pow(10, between(low, high)); }

Ring ring_of(std::vector<Vec2> points) {
  Ring ring;
  ring.points = std::move(points);
  return ring;
}

// ---- Fixed families.

Rings rectangle(double width, double height) {
  return {ring_of({{0, 0}, {width, 0}, {width, height}, {0, height}})};
}

Rings l_shape(double a) {
  return {ring_of({{0, 0}, {2 * a, 0}, {2 * a, a}, {a, a}, {a, 2 * a}, {0, 2 * a}})};
}

Rings t_shape(double a) {
  return {ring_of({{a, 0},
                   {2 * a, 0},
                   {2 * a, 2 * a},
                   {3 * a, 2 * a},
                   {3 * a, 3 * a},
                   {0, 3 * a},
                   {0, 2 * a},
                   {a, 2 * a}})};
}

Rings u_shape(double a) {
  return {ring_of({{0, 0},
                   {3 * a, 0},
                   {3 * a, 2 * a},
                   {2 * a, 2 * a},
                   {2 * a, a},
                   {a, a},
                   {a, 2 * a},
                   {0, 2 * a}})};
}

Rings cross_shape(double a) {
  const double b = 2 * a;
  const double c = 3 * a;
  return {ring_of({{a, 0},
                   {b, 0},
                   {b, a},
                   {c, a},
                   {c, b},
                   {b, b},
                   {b, c},
                   {a, c},
                   {a, b},
                   {0, b},
                   {0, a},
                   {a, a}})};
}

Rings comb(std::size_t teeth, double back, double length) {
  std::vector<Vec2> points;
  points.reserve(4 * teeth);
  const double end = 2 * static_cast<double>(teeth) - 1;
  points.push_back({0, 0});
  points.push_back({end, 0});
  for (std::size_t i = teeth; i-- > 0;) {
    const double left = 2 * static_cast<double>(i);
    if (i + 1 < teeth) points.push_back({left + 1, back});
    points.push_back({left + 1, back + length});
    points.push_back({left, back + length});
    if (i > 0) points.push_back({left, back});
  }
  return {ring_of(std::move(points))};
}

Rings triangle(Vec2 a, Vec2 b, Vec2 c) { return {ring_of({a, b, c})}; }

Rings regular_polygon(std::size_t n, double radius) {
  std::vector<Vec2> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    points[i] = polar(radius, two_pi * static_cast<double>(i) / static_cast<double>(n));
  }
  return {ring_of(std::move(points))};
}

Rings blob(std::size_t n) {
  std::vector<Vec2> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = two_pi * static_cast<double>(i) / static_cast<double>(n);
    points[i] = polar(1 + 0.3 * std::cos(5 * t) + 0.05 * std::cos(13 * t), t);
  }
  return {ring_of(std::move(points))};
}

Rings jagged_star(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec2> points(2 * n);
  for (std::size_t i = 0; i < 2 * n; ++i) {
    const double t = two_pi * static_cast<double>(i) / static_cast<double>(2 * n);
    points[i] = polar((i % 2 == 0 ? 1.0 : 0.5) + random.between(-0.1, 0.1), t);
  }
  return {ring_of(std::move(points))};
}

Rings maze(std::size_t n, std::uint64_t seed) {
  // A cell of a random spanning tree (Kruskal's order) has 1.761 corners on average, measured.
  constexpr double corners_per_cell = 1.761;
  const auto side = std::max<std::size_t>(
      2, static_cast<std::size_t>(std::sqrt(static_cast<double>(n) / corners_per_cell) + 0.5));
  std::vector<OpenSides> open(side * side, OpenSides{});
  std::vector<std::size_t> walls(2 * side * side);
  std::iota(walls.begin(), walls.end(), std::size_t{0});
  Random random(seed);
  shuffle(random, walls);
  DisjointSets sets(side * side);
  for (const std::size_t wall : walls) {
    const std::size_t cell = wall / 2;
    const bool upwards = wall % 2 == 1;
    if (upwards ? cell / side + 1 == side : cell % side + 1 == side) continue;
    const std::size_t other = upwards ? cell + side : cell + 1;
    if (!sets.join(static_cast<std::uint32_t>(cell), static_cast<std::uint32_t>(other))) continue;
    open[cell][upwards ? 2 : 1] = true;
    open[other][upwards ? 0 : 3] = true;
  }
  return {ring_of(walls_of(open, side))};
}

Rings hole_grid(std::size_t k) {
  const double side = 2 * static_cast<double>(k) + 1;
  Rings rings = rectangle(side, side);
  rings.reserve(k * k + 1);
  for (std::size_t row = 0; row < k; ++row) {
    for (std::size_t column = 0; column < k; ++column) {
      const double x = 2 * static_cast<double>(column) + 1;
      const double y = 2 * static_cast<double>(row) + 1;
      rings.push_back(ring_of({{x, y}, {x, y + 1}, {x + 1, y + 1}, {x + 1, y}}));
    }
  }
  return rings;
}

Rings nested_squares(std::size_t rings) {
  Rings result;
  for (std::size_t i = 0; i < rings; ++i) {
    const auto low = static_cast<double>(i), high = static_cast<double>(2 * rings - i);
    result.push_back(ring_of({{low, low}, {high, low}, {high, high}, {low, high}}));
  }
  return result;
}

Rings spiral(std::size_t n, double turns) {
  std::vector<Vec2> points;
  points.reserve(2 * n);
  const auto point = [&](std::size_t i, double inset) {
    const double t = turns * static_cast<double>(i) / static_cast<double>(n - 1);
    return polar(1 + t - inset, two_pi * t);
  };
  for (std::size_t i = 0; i < n; ++i) points.push_back(point(i, 0));
  for (std::size_t i = n; i-- > 0;) points.push_back(point(i, 0.5));
  return {ring_of(std::move(points))};
}

Rings needle(double angle) { return triangle({0, 0}, {1, 0}, {1, std::tan(angle)}); }

double Symmetry::scale() const { return std::sqrt(std::abs(xx * yy - xy * yx)); }

const std::vector<Symmetry>& symmetries() {
  static const std::vector<Symmetry> all = [] {
    const double c = std::cos(0.7);
    const double s = std::sin(0.7);
    std::vector<Symmetry> list;
    list.push_back({.name = "identity"});
    list.push_back({.name = "rotated", .xx = c, .xy = -s, .yx = s, .yy = c, .exact = false});
    list.push_back({.name = "turned by a quarter", .xx = 0, .xy = -1, .yx = 1, .yy = 0});
    list.push_back({.name = "scaled by 1e-6", .xx = 1e-6, .yy = 1e-6, .exact = false});
    list.push_back({.name = "scaled by 1e9", .xx = 1e9, .yy = 1e9});
    list.push_back({.name = "shifted by 1e7", .dx = 1e7, .dy = -1e7});
    list.push_back({.name = "mirrored", .xx = -1});
    list.push_back({.name = "reversed", .reverse = true});
    list.push_back({.name = "re-started", .restart = 3});
    list.push_back({.name = "all together",
                    .xx = 7 * c,
                    .xy = 7 * s,
                    .yx = 7 * s,
                    .yy = -7 * c,
                    .dx = 30,
                    .dy = -20,
                    .reverse = true,
                    .restart = 2,
                    .exact = false});
    return list;
  }();
  return all;
}

Rings transformed(const Rings& rings, const Symmetry& symmetry) {
  Rings result = rings;
  for (Ring& ring : result) {
    auto& points = ring.points;
    for (Vec2& p : points) p = symmetry(p);
    if (symmetry.reverse) std::reverse(points.begin(), points.end());
    const auto shift = static_cast<std::ptrdiff_t>(symmetry.restart % points.size());
    std::rotate(points.begin(), points.begin() + shift, points.end());
    auto& bulges = ring.bulges;
    if (bulges.empty()) continue;
    bulges.resize(points.size());
    const bool mirrored = symmetry.xx * symmetry.yy - symmetry.xy * symmetry.yx < 0;
    if (mirrored != symmetry.reverse) {
      for (double& bulge : bulges) bulge = 0 - bulge;
    }
    // Backwards, the last edge stays the last one.
    if (symmetry.reverse) std::reverse(bulges.begin(), bulges.end() - 1);
    std::rotate(bulges.begin(), bulges.begin() + shift, bulges.end());
  }
  const auto shift = static_cast<std::ptrdiff_t>(symmetry.restart % result.size());
  std::rotate(result.begin(), result.begin() + shift, result.end());
  return result;
}

std::vector<Chain> transformed(const std::vector<Chain>& chains, const Symmetry& symmetry) {
  std::vector<Chain> result;
  for (const Chain& chain : chains) {
    Symmetry own = symmetry;
    if (!chain.closed) own.restart = 0;
    Ring ring = transformed(Rings{{chain.points, RingRole::any, chain.bulges}}, own)[0];
    result.push_back({std::move(ring.points), std::move(ring.bulges), chain.closed});
  }
  const auto first = static_cast<std::ptrdiff_t>(symmetry.restart % result.size());
  std::rotate(result.begin(), result.begin() + first, result.end());
  return result;
}

Rings symmetric(const Rings& rings, std::size_t i) { return transformed(rings, symmetries()[i]); }

std::string to_wkt(const Rings& rings) {
  // A polygon's outer ring comes first: the one that goes furthest to the left.
  const auto left_end = [](const Ring& ring) {
    double left = std::numeric_limits<double>::infinity();
    for (const Vec2 p : ring.points) left = std::min(left, p.x);
    return left;
  };
  std::vector<const Ring*> order;
  for (const Ring& ring : rings) order.push_back(&ring);
  const auto outer =
      std::min_element(order.begin(), order.end(),
                       [&](const Ring* a, const Ring* b) { return left_end(*a) < left_end(*b); });
  if (outer != order.end()) std::rotate(order.begin(), outer, outer + 1);

  std::string text = "POLYGON (";
  std::array<char, 64> buffer{};
  for (const Ring* ring : order) {
    text += ring == order.front() ? "(" : ", (";
    for (std::size_t k = 0; k <= ring->points.size(); ++k) {
      const Vec2 p = ring->points[k % ring->points.size()];
      std::snprintf(buffer.data(), buffer.size(), "%s%.17g %.17g", k == 0 ? "" : ", ", p.x, p.y);
      text += buffer.data();
    }
    text += ")";
  }
  return text + ")";
}

std::size_t vertex_count(const Rings& rings) {
  std::size_t count = 0;
  for (const Ring& ring : rings) count += ring.points.size();
  return count;
}

}  // namespace medial::test
