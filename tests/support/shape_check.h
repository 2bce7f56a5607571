#pragma once

// Slow and simple second opinions on what build_shape() says, for small inputs.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "medial/shape.h"

namespace medial::test {

/// Sign of the area of a triangle; exact for small integers, which is all that is asked of it.
inline int turn(Vec2 a, Vec2 b, Vec2 c) {
  const double area = cross(b - a, c - a);
  return (area > 0) - (area < 0);
}

inline bool on_segment(Vec2 p, Vec2 a, Vec2 b) {
  return turn(a, b, p) == 0 && dot(p - a, p - b) <= 0;
}

struct Segment {
  Vec2 start;
  Vec2 end;
  VertexSource source;
};

inline bool cross_inside(const Segment& a, const Segment& b) {
  return turn(a.start, a.end, b.start) * turn(a.start, a.end, b.end) < 0 &&
         turn(b.start, b.end, a.start) * turn(b.start, b.end, a.end) < 0;
}

/// Whether two segments have more than a point in common.
inline bool share_stretch(const Segment& a, const Segment& b) {
  if (turn(a.start, a.end, b.start) != 0 || turn(a.start, a.end, b.end) != 0) return false;
  const Vec2 along = a.end - a.start;
  const double s = dot(b.start - a.start, along);
  const double t = dot(b.end - a.start, along);
  return std::min(std::max(s, t), dot(along, along)) > std::max(std::min(s, t), 0.0);
}

/// All that is wrong with rings of small integers, by comparing all pairs of edges.
struct Faults {
  std::vector<std::size_t> too_few_points;
  std::vector<std::size_t> no_area;
  std::vector<std::pair<Segment, Segment>> crossings;
  std::vector<std::pair<Segment, Segment>> overlaps;
  bool none() const {
    return too_few_points.empty() && no_area.empty() && crossings.empty() && overlaps.empty();
  }
};

/// The edges of a ring without repeated points and without vertices in straight runs.
inline std::vector<Segment> cleaned_edges(const Ring& ring, std::uint32_t index) {
  std::vector<std::pair<Vec2, std::uint32_t>> kept;
  for (std::uint32_t i = 0; i < ring.points.size(); ++i) {
    if (kept.empty() || kept.back().first != ring.points[i]) kept.emplace_back(ring.points[i], i);
  }
  while (kept.size() > 1 && kept.back().first == kept.front().first) kept.pop_back();
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < kept.size() && kept.size() > 2; ++i) {
      const Vec2 before = kept[(i + kept.size() - 1) % kept.size()].first;
      const Vec2 after = kept[(i + 1) % kept.size()].first;
      const Vec2 here = kept[i].first;
      if (turn(before, here, after) == 0 && dot(here - before, after - here) > 0) {
        kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
        again = true;
        break;
      }
    }
  }
  std::vector<Segment> edges;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    edges.push_back({kept[i].first, kept[(i + 1) % kept.size()].first, {index, kept[i].second}});
  }
  return edges;
}

inline Faults brute_force_faults(std::span<const Ring> rings) {
  Faults faults;
  std::vector<Segment> edges;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::vector<Vec2>& points = rings[r].points;
    std::set<std::pair<double, double>> distinct;
    for (const Vec2 point : points) distinct.emplace(point.x, point.y);
    const auto spread = [&](Vec2 a) {
      return std::any_of(points.begin(), points.end(), [&](Vec2 b) {
        return std::any_of(points.begin(), points.end(),
                           [&](Vec2 c) { return turn(a, b, c) != 0; });
      });
    };
    if (distinct.size() < 3) {
      faults.too_few_points.push_back(r);
    } else if (!spread(points[0])) {
      faults.no_area.push_back(r);
    }
    for (const Segment& edge : cleaned_edges(rings[r], static_cast<std::uint32_t>(r))) {
      edges.push_back(edge);
    }
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      if (cross_inside(edges[i], edges[j])) faults.crossings.emplace_back(edges[i], edges[j]);
      if (share_stretch(edges[i], edges[j])) faults.overlaps.emplace_back(edges[i], edges[j]);
    }
  }
  return faults;
}

/// The error must be one of the faults, at its place.
inline void expect_fault_is_real(std::span<const Ring> rings, const Faults& faults,
                                 const Error& error) {
  const Place& place = error.place;
  if (!faults.too_few_points.empty() || !faults.no_area.empty()) {
    const bool few = error.code == ErrorCode::too_few_points;
    EXPECT_TRUE(few || error.code == ErrorCode::no_area) << to_string(error);
    const auto& named = few ? faults.too_few_points : faults.no_area;
    const auto& other = few ? faults.no_area : faults.too_few_points;
    ASSERT_FALSE(named.empty()) << to_string(error);
    EXPECT_EQ(place.ring, named[0]);
    if (!other.empty()) {
      EXPECT_LT(named[0], other[0]);
    }
    return;
  }
  ASSERT_TRUE(place.ring && place.vertex && place.point) << to_string(error);
  EXPECT_LT(*place.vertex, rings[*place.ring].points.size());
  const bool crossing = error.code == ErrorCode::crossing;
  EXPECT_TRUE(crossing || error.code == ErrorCode::overlap) << to_string(error);
  const auto& list = crossing ? faults.crossings : faults.overlaps;
  const bool real = std::any_of(list.begin(), list.end(), [&](const auto& pair) {
    const auto& [a, b] = pair;
    if (a.source.ring != *place.ring || a.source.vertex != *place.vertex) return false;
    for (const Segment& edge : {a, b}) {
      const Vec2 along = edge.end - edge.start;
      const double t = dot(*place.point - edge.start, along) / dot(along, along);
      if (t < -1e-12 || t > 1 + 1e-12) return false;
      if (distance(edge.start + t * along, *place.point) > 1e-9) return false;
    }
    return true;
  });
  EXPECT_TRUE(real) << to_string(error);
}

inline bool inside_even_odd(std::span<const Ring> rings, Vec2 p) {
  bool inside = false;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      const Vec2 a = ring.points[i];
      const Vec2 b = ring.points[(i + 1) % ring.points.size()];
      if ((a.y > p.y) == (b.y > p.y)) continue;
      if (a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) inside = !inside;
    }
  }
  return inside;
}

/// The interior between two neighbouring integer x, from bottom to top: y at the left and right end
/// of its lower and upper border. Requires integers and edges that do not cross.
struct Trapezoid {
  int slab;
  std::array<double, 2> low;
  std::array<double, 2> high;
};

inline std::vector<Trapezoid> trapezoids(std::span<const Ring> rings) {
  std::vector<Trapezoid> result;
  double low = 1e9;
  double high = -1e9;
  for (const Ring& ring : rings) {
    for (const Vec2 point : ring.points) {
      low = std::min(low, point.x);
      high = std::max(high, point.x);
    }
  }
  for (double x = low; x < high; ++x) {
    std::vector<std::tuple<double, double, double>> spans;  // y at the middle, left, right
    for (const Ring& ring : rings) {
      for (std::size_t i = 0; i < ring.points.size(); ++i) {
        Vec2 a = ring.points[i];
        Vec2 b = ring.points[(i + 1) % ring.points.size()];
        if (a.x > b.x) std::swap(a, b);
        if (a.x > x || b.x < x + 1) continue;
        const auto at = [&](double t) { return a.y + (t - a.x) / (b.x - a.x) * (b.y - a.y); };
        spans.emplace_back(at(x + 0.5), at(x), at(x + 1));
      }
    }
    std::sort(spans.begin(), spans.end());
    for (std::size_t i = 0; i + 1 < spans.size(); i += 2) {
      const auto& [m0, l0, r0] = spans[i];
      const auto& [m1, l1, r1] = spans[i + 1];
      result.push_back({static_cast<int>(x), {l0, r0}, {l1, r1}});
    }
  }
  return result;
}

inline double even_odd_area(std::span<const Ring> rings) {
  double area = 0;
  for (const Trapezoid& t : trapezoids(rings)) {
    area += (t.high[0] - t.low[0] + t.high[1] - t.low[1]) / 2;
  }
  return area;
}

/// Plain union-find: how many classes remain.
class Classes {
 public:
  explicit Classes(std::size_t size) : parent_(size), count_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  void unite(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    parent_[a] = b;
    --count_;
  }
  std::size_t find(std::size_t a) {
    while (parent_[a] != a) a = parent_[a];
    return a;
  }
  std::size_t count() const { return count_; }

 private:
  std::vector<std::size_t> parent_;
  std::size_t count_;
};

/// The number of connected components of the open interior.
inline std::size_t interior_components(std::span<const Ring> rings) {
  const std::vector<Trapezoid> all = trapezoids(rings);
  Classes classes(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (all[j].slab != all[i].slab + 1) continue;
      const double common =
          std::min(all[i].high[1], all[j].high[0]) - std::max(all[i].low[1], all[j].low[0]);
      // Different fractions with denominators up to 10 differ by 1/90 at least.
      if (common > 1e-6) classes.unite(i, j);
    }
  }
  return classes.count();
}

inline double signed_area(std::span<const Vec2> loop) {
  double twice = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    twice += cross(loop[i] - loop[0], loop[(i + 1) % loop.size()] - loop[0]);
  }
  return twice / 2;
}

/// Built again from its own loops, a shape is the same one, in the same order.
inline void expect_stays(const Shape& shape) {
  const auto again = build_shape(rings_of(shape));
  ASSERT_TRUE(again.ok()) << to_string(again.error());
  EXPECT_EQ(again->points, shape.points);
  EXPECT_EQ(again->bulges, shape.bulges);
  EXPECT_EQ(again->loop_begin, shape.loop_begin);
  EXPECT_EQ(again->component, shape.component);
}

/// All that include/medial/shape.h promises of a Shape, for coordinates of moderate size. O(n^2).
inline void expect_contract(std::span<const Ring> rings, const Shape& shape) {
  expect_stays(shape);
  const std::size_t loops = shape.loop_count();
  ASSERT_EQ(shape.loop_begin.size(), loops + 1);
  ASSERT_EQ(shape.hole.size(), loops);
  ASSERT_EQ(shape.sources.size(), shape.points.size());
  ASSERT_EQ(shape.loop_begin.front(), 0U);
  ASSERT_EQ(shape.loop_begin.back(), shape.points.size());
  std::vector<Segment> edges;
  std::vector<std::size_t> loop_of;
  for (std::size_t i = 0; i < loops; ++i) {
    const std::span<const Vec2> loop = shape.loop(i);
    ASSERT_GE(loop.size(), 3U);
    // Components in order, the outer loop first; counter-clockwise, and the holes clockwise.
    const bool first = i == 0 || shape.component[i] != shape.component[i - 1];
    EXPECT_EQ(shape.hole[i], !first);
    EXPECT_EQ(shape.component[i], i == 0 ? 0 : shape.component[i - 1] + (first ? 1U : 0U));
    EXPECT_EQ(signed_area(loop) < 0, shape.hole[i]);
    EXPECT_NE(signed_area(loop), 0);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const VertexSource source = shape.sources[shape.loop_begin[i] + k];
      ASSERT_LT(source.ring, rings.size());
      ASSERT_LT(source.vertex, rings[source.ring].points.size());
      EXPECT_EQ(rings[source.ring].points[source.vertex], loop[k]);
      const Vec2 after = loop[(k + 1) % loop.size()];
      const Vec2 before = loop[(k + loop.size() - 1) % loop.size()];
      EXPECT_NE(loop[k], after);
      EXPECT_NE(before, after) << "a spike";
      if (turn(before, loop[k], after) == 0) {
        EXPECT_GT(std::count(shape.points.begin(), shape.points.end(), loop[k]), 1);
      }
      edges.push_back({loop[k], after, source});
      loop_of.push_back(i);
      const Vec2 left = left_of(after - loop[k]);
      const Vec2 offset = (1e-6 / norm(left)) * left;
      const Vec2 middle = midpoint(loop[k], after);
      EXPECT_TRUE(inside_even_odd(rings, middle + offset));
      EXPECT_FALSE(inside_even_odd(rings, middle - offset));
    }
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < edges.size(); ++j) {
      if (i == j) continue;
      EXPECT_FALSE(cross_inside(edges[i], edges[j]));
      EXPECT_FALSE(share_stretch(edges[i], edges[j]));
      const Vec2 p = edges[j].start;
      EXPECT_FALSE(on_segment(p, edges[i].start, edges[i].end) && p != edges[i].start &&
                   p != edges[i].end);
      const std::size_t a = loop_of[i];
      const std::size_t b = loop_of[j];
      if (a != b && shape.component[a] == shape.component[b]) {
        EXPECT_NE(p, edges[i].start);
      }
    }
  }
}

/// The loops of each component without order and starting points, to compare shapes by.
inline auto loops_as_set(const Shape& shape) {
  using Points = std::vector<std::pair<double, double>>;
  std::vector<std::vector<Points>> components(shape.component_count());
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    Points points;
    for (const Vec2 point : shape.loop(i)) points.emplace_back(point.x, point.y);
    Points lowest = points;
    for (std::size_t k = 1; k < points.size(); ++k) {
      std::rotate(points.begin(), points.begin() + 1, points.end());
      lowest = std::min(lowest, points);
    }
    components[shape.component[i]].push_back(std::move(lowest));
  }
  for (auto& component : components) std::sort(component.begin(), component.end());
  std::sort(components.begin(), components.end());
  return components;
}

/// Cells of an n x n grid, sheared by an integer matrix of determinant 1.
struct Cells {
  int size;
  std::vector<bool> filled;
  std::array<double, 4> shear;
  bool at(int i, int j) const {
    if (i < 0 || j < 0 || i >= size || j >= size) return false;
    return filled[static_cast<std::size_t>(i * size + j)];
  }
  Vec2 corner(int i, int j) const {
    return {shear[0] * i + shear[1] * j, shear[2] * i + shear[3] * j};
  }
};

inline Cells random_cells(int size, std::mt19937_64& random) {
  Cells cells{size, std::vector<bool>(static_cast<std::size_t>(size * size)), {}};
  const std::uint64_t share = 2 + random() % 7;
  for (std::size_t i = 0; i < cells.filled.size(); ++i) cells.filled[i] = random() % 10 < share;
  const double a = static_cast<double>(random() % 5) - 2;
  const double b = static_cast<double>(random() % 5) - 2;
  cells.shear = {1, a, b, 1 + a * b};
  return cells;
}

struct CellCounts {
  std::size_t components;
  std::size_t holes;
  double area;
};

/// Components of the open union of the cells, and its holes by Euler's formula.
inline CellCounts count(const Cells& cells) {
  const int n = cells.size;
  const auto index = [n](int i, int j) { return static_cast<std::size_t>(i * n + j); };
  Classes classes(cells.filled.size());
  long euler = 0;
  std::size_t empty = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (!cells.at(i, j)) {
        ++empty;
        continue;
      }
      const bool right = cells.at(i + 1, j);
      const bool up = cells.at(i, j + 1);
      if (right) classes.unite(index(i, j), index(i + 1, j));
      if (up) classes.unite(index(i, j), index(i, j + 1));
      euler += 1 - right - up + (right && up && cells.at(i + 1, j + 1));
    }
  }
  const std::size_t components = classes.count() - empty;
  return {components, static_cast<std::size_t>(static_cast<long>(components) - euler),
          static_cast<double>(cells.filled.size() - empty)};
}

/// The border of the cells as rings. Where four edges meet, each ring turns left or right by
/// chance.
inline std::vector<Ring> border(const Cells& cells, std::mt19937_64& random) {
  // Directions: right, up, left, down. An edge has its cell on the left.
  constexpr std::array<std::array<int, 2>, 4> step = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  constexpr std::array<std::array<int, 2>, 4> left_cell = {{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
  constexpr std::array<std::array<int, 2>, 4> right_cell = {{{0, -1}, {0, 0}, {-1, 0}, {-1, -1}}};
  std::set<std::array<int, 3>> left;  // edges not walked yet: corner and direction
  for (int i = 0; i <= cells.size; ++i) {
    for (int j = 0; j <= cells.size; ++j) {
      for (std::size_t d = 0; d < 4; ++d) {
        if (cells.at(i + left_cell[d][0], j + left_cell[d][1]) &&
            !cells.at(i + right_cell[d][0], j + right_cell[d][1])) {
          left.insert({i, j, static_cast<int>(d)});
        }
      }
    }
  }
  std::vector<Ring> rings;
  while (!left.empty()) {
    Ring ring;
    std::array<int, 3> edge = *left.begin();
    const std::array<int, 2> start = {edge[0], edge[1]};
    for (;;) {
      left.erase(edge);
      ring.points.push_back(cells.corner(edge[0], edge[1]));
      const auto d = static_cast<std::size_t>(edge[2]);
      const std::array<int, 2> corner = {edge[0] + step[d][0], edge[1] + step[d][1]};
      std::vector<std::array<int, 3>> choices;
      for (int e = 0; e < 4; ++e) {
        if (left.contains({corner[0], corner[1], e})) choices.push_back({corner[0], corner[1], e});
      }
      if (choices.empty() || (corner == start && random() % 2)) {
        EXPECT_EQ(corner, start);
        break;
      }
      edge = choices[random() % choices.size()];
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

}  // namespace medial::test
