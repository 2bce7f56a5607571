#include "support/nasty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "methods/disks/boundary.h"
#include "support/generate_arcs.h"
#include "support/generate_parts.h"

namespace medial::test {
namespace {

constexpr double default_tolerance = 4e-15;  // of the diagonal

using test::turned;
Rings turned(Rings rings, double angle) {
  for (Ring& ring : rings)
    for (Vec2& p : ring.points) p = turned(p, angle);
  return rings;
}

std::vector<double> sorted(Random& random, std::size_t count, double low, double high) {
  std::vector<double> values(count);
  for (double& value : values) value = random.between(low, high);
  std::sort(values.begin(), values.end());
  return values;
}

std::size_t up_to(Random& random, std::int64_t most) {
  return static_cast<std::size_t>(random.integer(1, most));
}

// ---- Strips.

/// One long side of a strip from x = 0 on at height 0, its notches (above 0) and bumps (below) at
/// random.
std::vector<Vec2> long_side(Random& random, double length, std::size_t teeth) {
  std::vector<Vec2> points{{0, 0}};
  for (const double x : sorted(random, teeth, 0, 0.99 * length)) {
    const double width = std::min(random.power_of_ten(-1, 2), 0.001 * length);
    const double height = random.between(0.05, 0.45) * (random.chance(0.6) ? 1 : -1);
    if (x <= points.back().x + width) continue;
    points.push_back({x, 0});
    if (random.chance(0.3)) {
      points.push_back({x + 0.5 * width, height});
    } else {
      points.push_back({x, height});
      points.push_back({x + width, height * (random.chance(0.5) ? 1 : 0.9)});
    }
    points.push_back({x + width, 0});
  }
  points.push_back({length, 0});
  return points;
}

Rings strip_shape(Random& random, bool small) {
  const double length =
      random.chance(0.2) ? std::pow(10, random.integer(6, 14)) : random.power_of_ten(6, 14);
  const std::int64_t teeth = small ? 1 : 8;
  std::vector<Vec2> points = long_side(random, length, up_to(random, teeth));
  if (!small || random.chance(0.5)) {
    for (const Vec2 p : long_side(random, length, up_to(random, teeth)))
      points.push_back({length - p.x, 1 - p.y});
  } else {
    points.push_back({length, 1});
    points.push_back({0, 1});
  }
  if (random.chance(0.3))
    for (Vec2& p : points) p.x = std::round(p.x);
  return {ring_of(std::move(points))};
}

// ---- Clusters of slits.

Rings slit_shape(Random& random, bool small) {
  const double unit = default_tolerance * std::sqrt(2.0);
  const bool alike = random.chance(0.5);
  const double width = unit * random.between(0.5, 10), gap = unit * random.between(0.5, 10);
  const auto next = [&](double one) { return alike ? one : unit * random.between(0.5, 10); };
  const bool as_holes = random.chance(0.3);
  Rings rings{{}};
  std::vector<Vec2> outer{{0, 0}, {1, 0}, {1, 1}};
  double x = random.between(0.1, 0.9);
  const double end = random.between(0.05, 0.95);
  for (std::size_t i = up_to(random, small ? 3 : 8); i > 0; --i) {
    const double low = random.chance(0.4) ? end : random.between(0.05, 0.95);
    const double left = x - next(width);
    if (as_holes) {
      const double high = random.between(low, 1) * 0.99;
      rings.push_back(ring_of({{left, low}, {x, low}, {x, high}, {left, high}}));
    } else if (random.chance(0.2)) {
      outer.insert(outer.end(), {{x, 1}, {left, low}, {left, 1}});
    } else {
      outer.insert(outer.end(), {{x, 1}, {x, low}, {left, low}, {left, 1}});
    }
    x = left - next(gap);
  }
  outer.push_back({0, 1});
  rings[0] = ring_of(std::move(outer));
  return rings;
}

// ---- Stretched shapes.

Rings holes_in_square(Random& random, bool small) {
  const auto k = static_cast<std::size_t>(random.integer(1, small ? 1 : 3));
  if (random.chance(0.5)) return hole_grid(k);
  return star_with_holes(random, 4 + up_to(random, small ? 1 : 8), k);
}

Rings stretched_shape(Random& random, bool small) {
  Rings rings;
  switch (random.integer(0, 3)) {
    case 0:
      rings = holes_in_square(random, small);
      break;
    case 1:
      rings = lattice_cells(random, 1 + up_to(random, small ? 3 : 20),
                            {.equal_steps = random.chance(0.5)});
      break;
    case 2:
      rings = small ? rectangle(3, 1) : comb(up_to(random, 8), random.between(0.1, 2));
      if (small) rings = l_shape(random.between(0.1, 5));
      break;
    default:
      rings = {star(random, 4 + up_to(random, small ? 3 : 20))};
  }
  const double factor = random.power_of_ten(6, 15);
  for (Ring& ring : rings)
    for (Vec2& p : ring.points) p.x *= factor;
  return rings;
}

// ---- Needles, and other narrow polygons.

Rings needle_shape(Random& random, bool) {
  const double length = random.chance(0.5) ? 1 : random.power_of_ten(-9, 9);
  const double thin = length * random.power_of_ten(-17, -13);
  const double at = random.chance(0.3) ? random.power_of_ten(-16, -1) : random.unit();
  const Vec2 offset =
      random.chance(0.5) ? Vec2{0, 0} : Vec2{random.between(-1, 1), random.between(-1, 1)};
  std::vector<Vec2> points{{0, 0}, {length, 0}, {at * length, thin}};
  const double angle = random.chance(0.3) ? 0 : random.between(0, two_pi);
  for (Vec2& p : points) p = turned(p, angle) + length * offset;
  return {ring_of(std::move(points))};
}

Rings narrow_polygon(Random& random, bool) {
  const std::size_t n = 3 + up_to(random, 3),
                    above = up_to(random, static_cast<std::int64_t>(n) - 2);
  const double height = random.power_of_ten(-16, -2);
  const auto y = [&] { return random.chance(0.3) ? height : height * random.unit(); };
  std::vector<Vec2> points{{0, 0}};
  for (const double x : sorted(random, n - 2 - above, 0, 1))
    points.push_back({x, -y() * (random.chance(0.5) ? 1 : 0)});
  points.push_back({1, random.chance(0.5) ? 0 : y()});
  std::vector<double> xs = sorted(random, above, 0, 1);
  for (auto x = xs.rbegin(); x != xs.rend(); ++x) points.push_back({*x, y()});
  return turned({ring_of(std::move(points))}, random.chance(0.3) ? 0 : random.between(0, two_pi));
}

// ---- Rings that all but touch.

Rings ring_shape(Random& random, bool small) {
  if (!small) return random.chance(0.3) ? touching_holes(random, 2) : narrow_gaps(random);
  const double gap = random.power_of_ten(-15, -6);
  const double x = random.between(0.2, 0.7), y = random.between(0.1, 0.4);
  Rings rings{ring_of({{0, 0}, {1, 0}, {random.between(0.8, 1), 1}, {0, 1}})};
  rings.push_back(ring_of({{x, gap}, {x + random.between(0.05, 0.2), y}, {x - 0.1, y}}));
  if (random.chance(0.5))
    rings.push_back(ring_of({{x - 0.1, y + gap}, {x + random.between(0, 0.1), y + gap}, {x, 0.9}}));
  return turned(std::move(rings), random.chance(0.5) ? 0 : random.between(0, two_pi));
}

Rings grid_shape(Random& random, bool small) {
  if (!small) return random_integer_shape(random.next()).rings;
  switch (random.integer(0, 2)) {
    case 0:
      return untangled(random, 3 + up_to(random, 6), 12);
    case 1:
      return lattice_cells(random, up_to(random, 6), {.equal_steps = random.chance(0.5)});
    default:
      return rectangle(static_cast<double>(up_to(random, 20)),
                       static_cast<double>(up_to(random, 20)));
  }
}

// ---- Splinters.

Rings splinter_shape(Random& random, bool small) {
  Ring ring = random.chance(0.5) ? untangled(random, 2 + up_to(random, small ? 4 : 20), 64)[0]
                                 : star(random, 3 + up_to(random, small ? 3 : 20));
  const double size = random.power_of_ten(-16, -12) * 64;
  std::vector<Vec2> points;
  for (const Vec2 p : ring.points) {
    points.push_back(p);
    for (int i = 0; i < 2 && random.chance(0.3); ++i)
      points.push_back(p + size * Vec2{random.between(-1, 1), random.between(-1, 1)});
  }
  return {ring_of(std::move(points))};
}

// ---- Near-circles, and arcs nearly tangent.

double slip(Random& random) { return random.chance(0.1) ? 0 : random.power_of_ten(-16, -10); }

/// Moves vertices, scales bulges, or both.
Ring disturbed(Random& random, Ring ring) {
  const double size = slip(random);
  const std::int64_t kind = random.integer(0, 2);
  const auto off = [&] { return size * random.between(-1, 1); };
  if (kind != 1)
    for (Vec2& p : ring.points) p = p + Vec2{off(), off()};
  if (kind != 0)
    for (double& bulge : ring.bulges) bulge *= 1 + off();
  return ring;
}

Rings round_polygon(Random& random, bool small) {
  const std::size_t n = 3 + up_to(random, small ? 7 : 60);
  return turned({disturbed(random, regular_polygon(n)[0])}, random.between(0, two_pi));
}

Rings arc_circle(Random& random, bool small) {
  return {disturbed(random, arcs_of_circle(2 + static_cast<int>(up_to(random, small ? 6 : 60))))};
}

Rings bar_shape(Random& random, bool small) {
  const double half_length = random.power_of_ten(-2, 1);
  const Vec2 along = turned({1, 0}, random.chance(0.3) ? 0 : random.between(0, two_pi));
  Ring ring;
  for (int side = 0; side < 2; ++side) {
    const auto n = static_cast<int>(up_to(random, small ? 2 : 5));
    for (int i = 0; i <= n; ++i) {
      const double angle = 0.5 * two_pi * (static_cast<double>(i) / n + side - 0.5);
      const double x = std::cos(angle) + (side == 0 ? half_length : -half_length);
      ring.points.push_back(x * along + std::sin(angle) * left_of(along));
      ring.bulges.push_back(i < n ? std::tan(two_pi / (8.0 * n)) : 0);
    }
  }
  return {disturbed(random, std::move(ring))};
}

Rings tangent_arcs(Random& random, bool small) {
  Rings rings;
  switch (random.integer(0, 2)) {
    case 0:
      rings = {smooth_biarcs(random, small ? 16 : 16 * up_to(random, 3), 1)};
      break;
    case 1:
      rings = {rounded(star(random, 2 + up_to(random, small ? 2 : 12)), random.between(0, 0.1))};
      break;
    default:
      rings = lattice_cells(random, up_to(random, small ? 2 : 12), {.touching = false});
      for (Ring& ring : rings) ring = rounded(ring, random.between(0, 1));
  }
  const double size = random.power_of_ten(-16, -7);
  for (Ring& ring : rings)
    for (double& bulge : ring.bulges) bulge *= 1 + size * random.between(-1, 1);
  return rings;
}

// ---- Parts of machines.

/// Moves all vertices, for a tenth of the shapes not at all.
void jitter(Random& random, Rings& rings) {
  const double size = slip(random);
  for (Ring& ring : rings)
    for (Vec2& p : ring.points) p = p + size * Vec2{random.between(-1, 1), random.between(-1, 1)};
}

/// A circle of two to five arcs, or a slot. Half of the circles have a joint where holes are
/// connected, up to rounding.
Ring round_hole(Random& random, Vec2 center, double radius) {
  if (random.chance(0.3)) {
    const Vec2 half = turned({0.5 * radius, 0}, random.between(0, two_pi));
    return stadium(center - half, center + half, 0.5 * radius);
  }
  const double outreach = std::atan2(disks::outreach.y, disks::outreach.x);
  const double start = random.chance(0.5)
                           ? outreach + random.power_of_ten(-17, -6) * random.between(-1, 1)
                           : random.between(0, two_pi);
  Ring ring = arcs_of_circle(1 + static_cast<int>(up_to(random, 4)));
  for (Vec2& p : ring.points) p = center + turned(radius * p, start);
  return ring;
}

/// Holes in a row or around a circle, as many as there is room for; in the middle one, sometimes.
void add_holes(Random& random, double radius, bool small, Rings& rings) {
  const std::size_t n = up_to(random, small ? 2 : 12);
  const double middle = random.chance(0.5) ? 0.25 * radius : 0;
  if (middle > 0) rings.push_back(round_hole(random, {0, 0}, middle));
  const double start = random.between(0, two_pi);
  for (std::size_t i = 0; i < n; ++i) {
    const double share = two_pi / static_cast<double>(std::max<std::size_t>(n, 3));
    const double size = radius * std::min(0.2, 0.55 * std::sin(0.5 * share));
    rings.push_back(round_hole(
        random, turned({0.65 * radius, 0}, start + share * static_cast<double>(i)), size));
  }
}

Rings gear_shape(Random& random, bool small) {
  const double root = random.between(0.4, 0.95);
  Rings rings{gear(2 + up_to(random, small ? 2 : 30), root)};
  if (random.chance(0.5)) add_holes(random, root, small, rings);
  rings = turned(std::move(rings), random.between(0, two_pi));
  jitter(random, rings);
  return rings;
}

Rings plate_shape(Random& random, bool small) {
  Rings rings;
  if (random.chance(0.5))
    rings = {arcs_of_circle(2 + static_cast<int>(up_to(random, 4)))};
  else
    rings = {regular_polygon(3 + up_to(random, small ? 2 : 7))[0]};
  add_holes(random, 0.45, small, rings);
  jitter(random, rings);
  return rings;
}

// ---- Straight sides with points on them, as of densified buildings.

Ring with_cut_sides(Random& random, const Ring& ring, std::size_t most) {
  const bool evenly = random.chance(0.7), alike = random.chance(0.5);
  const std::size_t pieces = up_to(random, static_cast<std::int64_t>(most));
  Ring cut;
  for (std::size_t i = 0; i < ring.points.size(); ++i) {
    const Vec2 from = ring.points[i], to = ring.points[(i + 1) % ring.points.size()];
    const std::size_t count = alike ? pieces : up_to(random, static_cast<std::int64_t>(most));
    for (std::size_t k = 0; k < count; ++k) {
      const double off = evenly || k == 0 ? 0 : random.between(0, 0.8);
      const double share = (static_cast<double>(k) + off) / static_cast<double>(count);
      cut.points.push_back(from + share * (to - from));
    }
  }
  return cut;
}

Rings cut_shape(Random& random, bool small) {
  Rings rings;
  if (random.chance(0.4))
    rings = rectangle(4, 3);
  else if (random.chance(0.5))
    rings = regular_polygon(2 + up_to(random, small ? 2 : 6));
  else
    rings = l_shape(2);
  rings[0] = with_cut_sides(random, rings[0], small ? 3 : 40);
  if (!small && random.chance(0.3)) {
    Ring hole = rectangle(0.25, 0.125)[0];
    for (Vec2& p : hole.points) p = p + Vec2{0.25, 0.25};
    rings.push_back(with_cut_sides(random, hole, 10));
  }
  rings =
      turned(std::move(rings), random.chance(0.4) ? std::atan2(3, 4) : random.between(0, two_pi));
  const Vec2 away =
      random.chance(0.5) ? Vec2{} : Vec2{random.between(0, 1e4), random.between(0, 1e5)};
  for (Ring& ring : rings)
    for (Vec2& p : ring.points) p = p + away;
  return rings;
}

Rings group_shape(Random& random, bool small);

constexpr std::array<NastyClass, 16> classes{{{"strips", strip_shape},
                                              {"slits", slit_shape},
                                              {"stretched", stretched_shape},
                                              {"needles", needle_shape},
                                              {"polygons", narrow_polygon},
                                              {"rings", ring_shape},
                                              {"grids", grid_shape},
                                              {"splinters", splinter_shape},
                                              {"rounds", round_polygon},
                                              {"groups", group_shape},
                                              {"circles", arc_circle, true},
                                              {"bars", bar_shape, true},
                                              {"tangents", tangent_arcs, true},
                                              {"gears", gear_shape, true},
                                              {"plates", plate_shape, true},
                                              {"sides", cut_shape}}};

// ---- Several of one class.

/// Moves a part into a quadrant, next to the origin, where it keeps its digits, and scales it by a
/// power of two to a width in [1, 2) times `size`.
void add_to_quadrant(const Rings& part, std::size_t quadrant, double size, double gap,
                     Rings& rings) {
  Box box = Box::nothing();
  for (const Ring& ring : part)
    for (const Vec2 p : ring.points) box.add(p);
  const double width = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  const double scale = size * std::exp2(-std::ilogb(width));
  const double x_sense = quadrant % 2 == 0 ? 1 : -1, y_sense = quadrant / 2 == 0 ? 1 : -1;
  for (Ring ring : part) {
    for (Vec2& p : ring.points) {
      const Vec2 moved = scale * (p - box.low) + Vec2{gap, gap};
      p = {x_sense * moved.x, y_sense * moved.y};
    }
    rings.push_back(std::move(ring));
  }
}

/// Components, or, with the holes that they have as islands, holes of one square. All of about one
/// size, or each of its own.
Rings group_shape(Random& random, bool small) {
  std::vector<const NastyClass*> polygons;  // less those that came after the first seeds
  for (const NastyClass& one : classes)
    if (!one.has_arcs && one.generate != group_shape && one.generate != cut_shape)
      polygons.push_back(&one);
  const auto last = static_cast<std::int64_t>(polygons.size()) - 1;
  const NastyClass& one = *polygons[static_cast<std::size_t>(random.integer(0, last))];
  constexpr std::size_t quadrants = 4;
  const std::size_t count = small ? 2 : 1 + up_to(random, quadrants - 1);
  const std::size_t first = up_to(random, quadrants);
  const bool as_holes = random.chance(0.5), alike = random.chance(0.5);
  const double gap = std::exp2(-static_cast<double>(random.integer(1, 50)));
  Rings rings;
  for (std::size_t i = 0; i < count; ++i) {
    const double size = alike ? 1 : std::exp2(-static_cast<double>(random.integer(0, 40)));
    add_to_quadrant(one.generate(random, small), (first + i) % quadrants, size, gap, rings);
  }
  constexpr double side = 2.5;
  if (as_holes)
    rings.push_back(ring_of({{-side, -side}, {side, -side}, {side, side}, {-side, side}}));
  return rings;
}

}  // namespace

std::span<const NastyClass> nasty_classes() {
  static const std::vector<NastyClass> all = [] {
    std::vector<NastyClass> both(classes.begin(), classes.end());
    const auto of_arcs = nasty_arc_classes();
    both.insert(both.end(), of_arcs.begin(), of_arcs.end());
    return both;
  }();
  return all;
}

Rings nasty_shape(const NastyClass& one, std::uint64_t seed, bool small) {
  Random random(seed);
  constexpr std::size_t few = 12;
  constexpr int tries = 20;
  Rings rings = one.generate(random, small);
  for (int i = 0; small && i < tries && vertex_count(rings) > few; ++i)
    rings = one.generate(random, small);
  return rings;
}

std::vector<Chain> nasty_chains(const NastyClass& one, std::uint64_t seed, bool small) {
  Random random(seed ^ 0x5bd1e995);
  std::vector<Chain> chains;
  for (const Ring& ring : nasty_shape(one, seed, small)) {
    const std::size_t n = ring.points.size();
    Chain chain;
    const auto close = [&] {
      if (!chain.points.empty()) chains.push_back(std::exchange(chain, {}));
    };
    for (std::size_t i = 0; i < n; ++i) {
      if (chain.points.empty()) chain.points.push_back(ring.points[i]);
      if (random.chance(0.3)) {
        close();
        continue;
      }
      chain.points.push_back(ring.points[(i + 1) % n]);
      if (!ring.bulges.empty()) chain.bulges.push_back(ring.bulges[i]);
    }
    close();
  }
  return chains;
}

std::vector<Chain> nasty_chains_and_points(const NastyClass& one, std::uint64_t seed, bool small) {
  Random random(seed ^ 0x27d4eb2f);
  std::vector<Chain> chains = nasty_chains(one, seed, small);
  Box box = Box::nothing();
  for (const Chain& chain : chains)
    for (const Vec2 p : chain.points) box.add(p);
  const double size = distance(box.low, box.high);
  for (std::size_t i = 0, count = chains.size(); i < count; ++i)
    for (std::size_t k = 0; k + 1 < chains[i].points.size(); ++k) {
      if (!random.chance(0.3)) continue;
      const Vec2 a = chains[i].points[k], chord = chains[i].points[k + 1] - a;
      const double angle = chains[i].bulges.empty() ? 0 : 2 * std::atan(chains[i].bulges[k]);
      const double t = random.between(0, 1), away = size * random.power_of_ten(-15, -9);
      const Vec2 on =
          angle == 0 ? a + t * chord
                     : a + std::sin(t * angle) / std::sin(angle) * turned(chord, (t - 1) * angle);
      const Vec2 normal = turned(left_of(chord), (2 * t - 1) * angle);
      chains.push_back({{on + (random.chance(0.5) ? away : -away) / norm(normal) * normal}});
    }
  return chains;
}

}  // namespace medial::test
