#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <utility>

#include "support/generate.h"
#include "support/generate_parts.h"

namespace medial::test {

namespace {

Ring moved(Ring ring, double factor, Vec2 offset) {
  for (Vec2& p : ring.points) p = factor * p + offset;
  return ring;
}

/// Whether two closed segments have a point in common; exact for coordinates below 2^25.
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto side = [](Vec2 p, Vec2 q, Vec2 r) {
    const double s = cross(q - p, r - p);
    return (s > 0) - (s < 0);
  };
  const auto within = [](Vec2 p, Vec2 q, Vec2 r) { return dot(p - r, q - r) <= 0; };
  const int abc = side(a, b, c);
  const int abd = side(a, b, d);
  const int cda = side(c, d, a);
  const int cdb = side(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && within(a, b, c)) || (abd == 0 && within(a, b, d)) ||
         (cda == 0 && within(c, d, a)) || (cdb == 0 && within(c, d, b));
}

/// Whether neighbours a-b and b-c fold back onto each other.
bool folds(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - b) == 0 && dot(b - a, c - b) < 0; }

/// One try of untangled(): false where a degenerate contact is left.
bool untangle(std::vector<Vec2>& p) {
  const std::size_t n = p.size();
  // Each exchange of two crossing edges shortens the tour, so this ends; the limit is for contacts
  // that are no crossings.
  for (std::size_t round = 0; round < 40 * n; ++round) {
    bool changed = false;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      for (std::size_t j = i + 2; j < n; ++j) {
        if (i == 0 && j == n - 1) continue;
        if (!meet(p[i], p[i + 1], p[j], p[(j + 1) % n])) continue;
        std::reverse(p.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                     p.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        changed = true;
      }
    }
    if (!changed) {
      for (std::size_t i = 0; i < n; ++i) {
        if (folds(p[i], p[(i + 1) % n], p[(i + 2) % n])) return false;
      }
      return true;
    }
  }
  return false;
}

}  // namespace

Rings untangled(Random& random, std::size_t n, std::int64_t grid) {
  for (;;) {
    std::set<std::pair<std::int64_t, std::int64_t>> seen;
    std::vector<Vec2> points;
    while (points.size() < n) {
      const std::int64_t x = random.integer(0, grid - 1);
      const std::int64_t y = random.integer(0, grid - 1);
      if (!seen.insert({x, y}).second) continue;
      points.push_back({static_cast<double>(x), static_cast<double>(y)});
    }
    double area = 0;
    if (!untangle(points)) continue;
    for (std::size_t i = 0; i < n; ++i) area += cross(points[i], points[(i + 1) % n]);
    if (area != 0) return {ring_of(std::move(points))};
  }
}

Ring star(Random& random, std::size_t n, const StarOptions& options) {
  struct Corner {
    double angle;
    double radius;
  };
  // At most 0.9 pi between neighbours: the centre stays inside.
  std::vector<Corner> corners;
  const double step = two_pi / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = step * (static_cast<double>(i) + 0.8 * random.unit());
    const double radius = random.between(options.inner, 1);
    const double room = 0.02 * step;
    if (random.chance(options.spikes)) {
      const double half = std::min(options.spike_angle, room);
      const double tip =
          random.chance(0.5) ? radius * random.between(1.1, 2) : radius * random.between(0.3, 0.9);
      corners.insert(corners.end(), {{angle - half, radius}, {angle, tip}, {angle + half, radius}});
    } else if (random.chance(options.bumps)) {
      const double half = std::min(options.bump_size, room);
      const double tip = radius * (1 + (random.chance(0.5) ? half : -half));
      corners.insert(corners.end(), {{angle - half, radius}, {angle, tip}, {angle + half, radius}});
    } else {
      corners.push_back({angle, radius});
    }
  }
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& next = corners[(i + 1) % corners.size()];
    const Vec2 from = polar(corners[i].radius, corners[i].angle);
    const Vec2 to = polar(next.radius, next.angle);
    points.push_back(from);
    if (norm(to - from) < 0.01 * step) continue;  // a spike's side stays straight
    for (int k = 1; k <= options.runs; ++k) {
      const double t = k / (options.runs + 1.0);
      const double factor = 1 + options.run_noise * random.between(-1, 1);
      points.push_back(factor * (from + t * (to - from)));
    }
  }
  return ring_of(std::move(points));
}

Rings lattice_cells(Random& random, std::size_t cells, const LatticeOptions& options) {
  using Cell = std::pair<int, int>;
  constexpr std::array<Cell, 4> steps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  const auto plus = [](Cell a, Cell b) { return Cell{a.first + b.first, a.second + b.second}; };
  std::set<Cell> filled{{0, 0}};
  std::vector<Cell> order{{0, 0}};
  const auto touches_corner_only = [&](Cell c) {
    for (const int dx : {-1, 1}) {
      for (const int dy : {-1, 1}) {
        if (filled.count(plus(c, {dx, dy})) && !filled.count(plus(c, {dx, 0})) &&
            !filled.count(plus(c, {0, dy}))) {
          return true;
        }
      }
    }
    return false;
  };
  for (std::size_t tries = 0; filled.size() < cells && tries < 40 * cells; ++tries) {
    const auto count = static_cast<std::int64_t>(order.size());
    const Cell from = order[static_cast<std::size_t>(random.integer(0, count - 1))];
    const Cell to = plus(from, steps[static_cast<std::size_t>(random.integer(0, 3))]);
    if (filled.count(to) || (!options.touching && touches_corner_only(to))) continue;
    filled.insert(to);
    order.push_back(to);
  }
  if (!options.touching) {
    // Filling a cell can leave two diagonal neighbours of an empty one: fill until there are none.
    for (bool changed = true; changed;) {
      changed = false;
      for (const Cell& c : std::set<Cell>(filled)) {
        if (!touches_corner_only(c)) continue;
        for (const int dx : {-1, 1}) {
          for (const int dy : {-1, 1}) {
            if (filled.count(plus(c, {dx, dy})) && !filled.count(plus(c, {dx, 0})) &&
                !filled.count(plus(c, {0, dy}))) {
              filled.insert(plus(c, {dx, 0}));
              changed = true;
            }
          }
        }
      }
    }
  }
  // Unit boundary edges with the cells on their left, by start.
  std::map<Cell, std::vector<Cell>> edges;
  for (const Cell& c : filled) {
    const std::array<Cell, 4> corner{c, plus(c, {1, 0}), plus(c, {1, 1}), plus(c, {0, 1})};
    constexpr std::array<Cell, 4> outwards{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
    for (std::size_t side = 0; side < 4; ++side) {
      if (!filled.count(plus(c, outwards[side]))) edges[corner[side]].push_back(steps[side]);
    }
  }
  int low = 0;
  int high = 0;
  for (const Cell& c : filled) {
    low = std::min({low, c.first, c.second});
    high = std::max({high, c.first + 1, c.second + 1});
  }
  std::array<std::vector<double>, 2> position;
  for (auto& axis : position) {
    double at = 0;
    for (int i = low; i <= high; ++i) {
      axis.push_back(at);
      at += options.equal_steps ? 1 : static_cast<double>(random.integer(1, 1000));
    }
  }
  // Where four edges meet, turn right: then rings touch each other but never themselves. This is a
  // permutation of the edges, so every chain closes where it began.
  const auto follow = [&](Cell at, Cell heading) {
    const auto& choices = edges.at(at);
    const Cell right{heading.second, -heading.first};
    const bool turn = std::find(choices.begin(), choices.end(), right) != choices.end();
    return turn ? right : choices.front();
  };
  Rings rings;
  std::set<std::pair<Cell, Cell>> seen;
  for (const auto& [start, headings] : edges) {
    for (const Cell& first : headings) {
      if (seen.count({start, first})) continue;
      std::vector<Vec2> points;
      Cell at = start;
      Cell heading = first;
      do {
        seen.insert({at, heading});
        at = plus(at, heading);
        const Cell next = follow(at, heading);
        if (options.keep_collinear || next != heading) {
          points.push_back({position[0][static_cast<std::size_t>(at.first - low)],
                            position[1][static_cast<std::size_t>(at.second - low)]});
        }
        heading = next;
      } while (at != start || heading != first);
      rings.push_back(ring_of(std::move(points)));
    }
  }
  return rings;
}

Rings star_with_holes(Random& random, std::size_t n, std::size_t holes_per_side) {
  // At least 12 corners with radii in [0.6, 1] leave the disk of radius 0.53 free for holes.
  Rings rings{star(random, std::max<std::size_t>(n, 12), {.inner = 0.6})};
  const double cell = 0.7 / static_cast<double>(holes_per_side);
  for (std::size_t i = 0; i < holes_per_side * holes_per_side; ++i) {
    if (random.chance(0.2)) continue;
    const Vec2 center{-0.35 + cell * (static_cast<double>(i % holes_per_side) + 0.5),
                      -0.35 + cell * (static_cast<double>(i / holes_per_side) + 0.5)};
    const auto corners = static_cast<std::size_t>(random.integer(4, 9));
    rings.push_back(moved(star(random, corners), cell * random.between(0.05, 0.49), center));
  }
  return rings;
}

Rings nested(Random& random, std::size_t n, std::size_t depth) {
  Rings rings;
  double size = 1;
  for (std::size_t i = 0; i < depth; ++i) {
    rings.push_back(moved(star(random, std::max<std::size_t>(n, 8), {.inner = 0.75}), size, {}));
    size *= 0.5;
  }
  return rings;
}

Rings near_touching(Random& random, double gap) {
  Rings rings = rectangle(8, 8);
  const double y = random.between(3, 5);
  // A diamond whose corner nearly touches the left side, and a square whose side nearly touches it.
  rings.push_back(ring_of({{gap, y}, {gap + 1.5, y - 1}, {gap + 3, y}, {gap + 1.5, y + 1}}));
  // Corner against corner.
  const double x = 2 * gap + 3;
  rings.push_back(ring_of(
      {{x, y}, {x + 1, y - 0.7}, {x + 2, y + random.between(-0.5, 0.5)}, {x + 1, y + 0.7}}));
  // Side against side, along the whole of a hole.
  const double bottom = gap;
  rings.push_back(ring_of({{1, bottom}, {4, bottom}, {4, 1}, {1, 1}}));
  rings.push_back(ring_of({{4 + gap, bottom}, {6, bottom}, {6, 1}, {4 + gap, 1}}));
  // A corner against the inside of a side.
  rings.push_back(ring_of({{2, 1 + gap}, {2.5, 1.5}, {1.5, 1.5}}));
  return rings;
}

Rings touching_holes(Random& random, std::size_t k) {
  // A hole may have a contact in the middle of each side of its cell: 0 below, 1 right, 2 above,
  // 3 left, as a vertex, or on the left side with the inside of an edge. The holes and the outer
  // ring with their contacts must be a forest, or the interior would fall apart.
  enum Kind { none, square, diamond, pointing_right, flat_left };
  struct Kinds {
    std::array<bool, 4> contact;
    std::vector<Vec2> points;
  };
  static const std::array<Kinds, 5> kinds{{
      {{false, false, false, false}, {}},
      {{false, false, false, false}, {{1, 1}, {3, 1}, {3, 3}, {1, 3}}},
      {{true, true, true, true}, {{2, 0}, {4, 2}, {2, 4}, {0, 2}}},
      {{false, true, false, false}, {{1, 1}, {4, 2}, {1, 3}}},
      {{false, true, false, true}, {{0, 1}, {3, 1}, {4, 2}, {3, 3}, {0, 3}}},
  }};
  const double side = 4 * static_cast<double>(k);
  Rings rings = rectangle(side, side);
  const auto outer = static_cast<std::uint32_t>(k * k);
  DisjointSets sets(k * k + 1);
  std::vector<Kind> kind(k * k, none);
  for (std::size_t row = 0; row < k; ++row) {
    for (std::size_t column = 0; column < k; ++column) {
      const auto cell = static_cast<std::uint32_t>(row * k + column);
      const auto choice = static_cast<Kind>(random.integer(0, 4));
      const auto& contact = kinds[choice].contact;
      if (choice == none || (choice == flat_left && column == 0)) continue;
      std::vector<std::uint32_t> met;
      if (contact[0] && row == 0) met.push_back(outer);
      if (contact[1] && column + 1 == k) met.push_back(outer);
      if (contact[2] && row + 1 == k) met.push_back(outer);
      if (contact[3] && column == 0) met.push_back(outer);
      if (contact[0] && row > 0 && kinds[kind[cell - k]].contact[2])
        met.push_back(static_cast<std::uint32_t>(cell - k));
      if (contact[3] && column > 0 && kinds[kind[cell - 1]].contact[1]) met.push_back(cell - 1);
      std::set<std::uint32_t> parts;
      for (const std::uint32_t other : met) parts.insert(sets.find(other));
      if (parts.size() < met.size()) continue;
      for (const std::uint32_t other : met) sets.join(cell, other);
      kind[cell] = choice;
      const Vec2 offset{4 * static_cast<double>(column), 4 * static_cast<double>(row)};
      rings.push_back(moved(ring_of(kinds[choice].points), 1, offset));
    }
  }
  return rings;
}

namespace {

/// Places a shape somewhere, at any angle and scale. Rounding moves every point by up to 1e-13 of
/// the size, so exact contacts of vertices with edges would not survive.
Rings placed_anywhere(Random& random, const Rings& rings) {
  Symmetry s;
  const double angle = random.between(0, two_pi);
  const double scale = random.power_of_ten(-6, 9);
  const double mirror = random.chance(0.5) ? 1 : -1;
  const double shear = random.chance(0.3) ? random.between(-1, 1) : 0;
  s.xx = scale * std::cos(angle);
  s.xy = mirror * scale * (shear * std::cos(angle) - std::sin(angle));
  s.yx = scale * std::sin(angle);
  s.yy = mirror * scale * (shear * std::sin(angle) + std::cos(angle));
  if (random.chance(0.5)) {
    double size = 0;
    for (const Vec2 p : rings[0].points) size = std::max({size, std::abs(p.x), std::abs(p.y)});
    s.dx = scale * size * random.between(-100, 100);
    s.dy = scale * size * random.between(-100, 100);
  }
  s.reverse = random.chance(0.5);
  s.restart = static_cast<std::size_t>(random.integer(0, 5));
  return transformed(rings, s);
}

/// A symmetry of the integer grid, and a power of two as scale: exact.
Rings placed_exactly(Random& random, const Rings& rings) {
  Symmetry s;
  const double scale = std::ldexp(1.0, static_cast<int>(random.integer(-20, 20)));
  const double sign = random.chance(0.5) ? scale : -scale;
  if (random.chance(0.5)) {
    s.xx = scale;
    s.yy = sign;
  } else {
    s.xx = s.yy = 0;
    s.xy = scale;
    s.yx = sign;
  }
  s.reverse = random.chance(0.5);
  s.restart = static_cast<std::size_t>(random.integer(0, 5));
  return transformed(rings, s);
}

std::size_t random_size(Random& random, double low, double high) {
  return static_cast<std::size_t>(std::lround(low * std::pow(high / low, random.unit())));
}

}  // namespace

RandomShape random_shape(std::uint64_t seed) {
  Random random(seed * 2 + 1);
  const auto anywhere = [&](std::string kind, Rings rings, bool rigid = true) {
    if (random.chance(0.5)) rings = placed_anywhere(random, rings);
    return RandomShape{std::move(kind), std::move(rings), rigid};
  };
  const auto exactly = [&](std::string kind, const Rings& rings) {
    return RandomShape{std::move(kind), placed_exactly(random, rings), false};
  };
  switch (random.integer(0, 17)) {
    case 0:
      return anywhere("untangled", untangled(random, random_size(random, 3, 60), 1 << 20));
    case 1:
      return exactly("untangled on a small grid",
                     untangled(random, random_size(random, 3, 14), random.integer(8, 16)));
    case 2:
      return anywhere("star", {star(random, random_size(random, 4, 400))});
    case 3: {
      StarOptions options;
      options.inner = random.between(0.05, 0.9);
      options.spikes = 0.3;
      options.spike_angle = random.power_of_ten(-7, -2);
      return {"star with needles", {star(random, random_size(random, 4, 60), options)}, false};
    }
    case 4: {
      StarOptions options;
      options.runs = static_cast<int>(random.integer(1, 6));
      options.run_noise = random.power_of_ten(-15, -3);
      return anywhere("near-collinear runs", {star(random, random_size(random, 4, 40), options)},
                      false);
    }
    case 5: {
      StarOptions options;
      options.bumps = 0.4;
      options.bump_size = random.power_of_ten(-10, -2);
      return {"tiny features", {star(random, random_size(random, 4, 60), options)}, false};
    }
    case 6:
      return exactly("lattice cells that touch",
                     lattice_cells(random, random_size(random, 2, 150)));
    case 7:
      return anywhere("lattice cells",
                      lattice_cells(random, random_size(random, 2, 150), {.touching = false}));
    case 8:
      return anywhere("lattice cells of many widths",
                      lattice_cells(random, random_size(random, 2, 150),
                                    {.touching = false, .equal_steps = false}));
    case 9:
      return exactly("lattice cells with collinear vertices",
                     lattice_cells(random, random_size(random, 2, 80), {.keep_collinear = true}));
    case 10: {
      const auto side = static_cast<std::size_t>(random.integer(1, 5));
      return anywhere("star with holes",
                      star_with_holes(random, random_size(random, 12, 80), side));
    }
    case 11: {
      const auto depth = static_cast<std::size_t>(random.integer(2, 5));
      return anywhere("nested rings", nested(random, random_size(random, 8, 40), depth));
    }
    case 12:
      return {"near-touching holes", near_touching(random, random.power_of_ten(-12, -3)), false};
    case 13:
      return exactly("touching holes",
                     touching_holes(random, static_cast<std::size_t>(random.integer(1, 6))));
    case 14:
      return anywhere("regular polygon", regular_polygon(random_size(random, 3, 300)));
    case 15:
      return anywhere("blob", blob(random_size(random, 8, 600)));
    case 16:
      return anywhere("maze", maze(random_size(random, 20, 400), random.next()));
    default: {
      const std::int64_t which = random.integer(0, 6);
      if (which == 0) return anywhere("hole grid", hole_grid(random_size(random, 1, 8)));
      if (which == 1) return anywhere("comb", comb(random_size(random, 2, 60)));
      if (which == 2) {
        return anywhere("spiral", spiral(random_size(random, 60, 300), random.between(0.5, 4)));
      }
      if (which == 3) {
        return anywhere("jagged star", jagged_star(random_size(random, 3, 200), random.next()));
      }
      if (which == 4) return {"needle", needle(random.power_of_ten(-8, -1)), false};
      if (which == 5) {
        return anywhere("rectangle", rectangle(1, random.power_of_ten(-6, 0)), false);
      }
      return anywhere("cross", cross_shape(random.between(0.5, 2)));
    }
  }
}

RandomShape random_integer_shape(std::uint64_t seed) {
  Random random(seed * 2);
  const auto on_grid = [](Rings rings) {
    for (Ring& ring : rings) {
      for (Vec2& p : ring.points) p = {std::round(0x1p20 * p.x), std::round(0x1p20 * p.y)};
    }
    return rings;
  };
  switch (random.integer(0, 8)) {
    case 0:
      return {"untangled", untangled(random, random_size(random, 3, 60), 1 << 20), false};
    case 1:
      return {"untangled on a small grid",
              untangled(random, random_size(random, 3, 14), random.integer(8, 16)), false};
    case 2:
      return {"star", on_grid({star(random, random_size(random, 4, 200))}), false};
    case 3:
      return {"lattice cells that touch", lattice_cells(random, random_size(random, 2, 100)),
              false};
    case 4:
      return {"lattice cells of many widths",
              lattice_cells(random, random_size(random, 2, 100), {.equal_steps = false}), false};
    case 5: {
      const auto side = static_cast<std::size_t>(random.integer(1, 4));
      return {"star with holes",
              on_grid(star_with_holes(random, random_size(random, 12, 60), side)), false};
    }
    case 6:
      return {"touching holes",
              touching_holes(random, static_cast<std::size_t>(random.integer(1, 6))), false};
    case 7:
      return {"maze", maze(random_size(random, 20, 400), random.next()), false};
    default:
      return {"hole grid", hole_grid(static_cast<std::size_t>(random.integer(1, 6))), false};
  }
}

// ---- Symmetries.

}  // namespace medial::test
