#include "voronoi/delaunay.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "base/compat.h"
#include "base/memory.h"
#include "base/predicates.h"
#include "base/random.h"
#include "base/spatial_order.h"

namespace medial::voronoi {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// The sides of a triangle after and before one, without a branch.
constexpr std::uint32_t side_after(std::uint32_t side) { return (0b001001U >> (2 * side)) & 3U; }
constexpr std::uint32_t side_before(std::uint32_t side) { return (0b010010U >> (2 * side)) & 3U; }

/// The order of insertion: each round is 32 times as large as the previous one, chosen at random,
/// and follows the curve, every other one backward, so that a round begins where the last one
/// ended.
std::vector<std::uint32_t> insertion_order(std::span<const Vec2> points) {
  constexpr std::size_t smallest_round = 64, growth_bits = 5;
  std::size_t rounds = 1;
  for (std::size_t count = points.size(); count > smallest_round; count >>= growth_bits) ++rounds;
  const auto drawn = [rounds](Random& random) {
    return std::min(static_cast<std::size_t>(std::countr_zero(random.next())) / growth_bits,
                    rounds - 1);
  };
  // What is drawn most often comes last. Those that run backward are filled from their end.
  std::vector<std::size_t> place(rounds);
  Random counted(points.size()), random(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) ++place[drawn(counted)];
  for (std::size_t r = rounds, end = 0; r-- > 0;) {
    end += place[r];
    place[r] = r % 2 == 1 ? end : end - place[r];
  }
  std::vector<std::uint32_t> order(points.size());
  for (const std::uint32_t i : hilbert_order(points)) {
    const std::size_t r = drawn(random);
    order[r % 2 == 1 ? --place[r] : place[r]++] = i;
  }
  return order;
}

/// Inserts points one by one.
///
/// Most decisions are made by circles in doubles. Let e be 2^-53 and M the largest coordinate, and
/// seen from one vertex of a triangle u and v the other two, A twice its area, S = u u + v v and
/// R its circle's radius. The centre computed is off by less than 15 e R S / A + 2 e M, since the
/// third side is no shorter than A / min(|u|, |v|). Then the square of a distance less that of the
/// radius, near to where its sign changes, is off by less than
/// (80 e S / A + 2^-25 + 10 e) R^2 + 2^30 (2 e M)^2. Circles with S / A < 2^21 are made use of, for
/// which that is less than 2^-24 R^2 + 2^-70 M^2; what underflows is less than the latter.
class Insertion {
 public:
  explicit Insertion(Delaunay& result)
      : points_(result.points),
        triangles_(result.triangles),
        circles_(result.circles),
        leaving_(result.leaving) {
    const auto count = static_cast<std::uint32_t>(points_.size());
    reserve_large(triangles_, 2 * std::size_t{count});
    reserve_large(circles_, 2 * std::size_t{count} + 64);
    leaving_.resize(count + 1);  // the last one is that of `outside`
    double largest = 0;
    for (const Vec2 p : points_)
      largest = std::max(largest, std::max(std::abs(p.x), std::abs(p.y)));
    if (!(largest < 0x1p100 && largest > 0x1p-100)) return;
    slack_ = 0x1p-70 * largest * largest;
    area_error_ = 20 * std::numeric_limits<double>::epsilon() * largest * largest;
  }

  /// From three points, the first ones, that are not on one line.
  void begin() {
    const bool left = orientation(points_[0], points_[1], points_[2]) > 0;
    // Triangle 0, and ghost 1 + i beyond its half-edge i.
    const std::array<std::uint32_t, 3> vertex{0, left ? 1U : 2U, left ? 2U : 1U};
    add_triangle({vertex, 0, {5, 9, 13}});
    for (std::uint32_t i = 0; i < 3; ++i) {
      // The ghosts beyond the neighbours of edge i have a side each in common with this one.
      const std::uint32_t next = (i + 1) % 3, before = (i + 2) % 3;
      add_triangle(
          {{outside, vertex[next], vertex[i]}, 0, {4 * (1 + next) + 2, i, 4 * (1 + before)}});
      leaving_[vertex[i]] = i;
    }
  }

  void insert(std::uint32_t p) {
    find_cavity(points_[p], triangle_near(points_[p]));
    fill_cavity(p);
  }

 private:
  void add_triangle(const Delaunay::Triangle& triangle) {
    triangles_.push_back(triangle);
    circles_.push_back({{{}, endless}});
  }

  /// Whether the sign of a squared distance less that of a radius, `size`, is beyond rounding.
  bool is_sure(double power, double size) const {
    return std::abs(power) > 0x1p-24 * size + slack_;
  }
  bool is_in_conflict(const Delaunay::Triangle& t, Vec2 p) const {
    const auto& [a, b, c] = t.vertex;
    if (!t.is_ghost()) return in_circle(points_[a], points_[b], points_[c], p) > 0;
    const Vec2 from = points_[a == outside ? b : c], to = points_[a == outside ? c : a];
    const int side = orientation(from, to, p);
    return side > 0 || (side == 0 && strictly_between(from, p, to));
  }
  bool is_right_of(Vec2 from, Vec2 to, Vec2 p) const {
    const double area = cross(from - p, to - p);
    return std::abs(area) > area_error_ ? area < 0 : orientation(from, to, p) < 0;
  }

  /// A triangle in conflict with a point. The walk that crosses any edge with the point on its
  /// other side ends, in a Delaunay triangulation, where the point is.
  std::uint32_t triangle_near(Vec2 p) const {
    std::uint32_t at = last_;
    if (triangles_[at].is_ghost())
      at = triangles_[at].twin[triangles_[at].vertex[0] == outside ? 1 : 2] >> 2U;
    std::uint32_t came = 0;  // half-edge that has the point on its left
    const auto& [vertex, mark, twin, spare] = triangles_[at];
    if (is_right_of(points_[vertex[0]], points_[vertex[1]], p)) {
      came = twin[0] & 3U;
      at = twin[0] >> 2U;
    }
    while (true) {
      const Delaunay::Triangle& t = triangles_[at];
      const auto& [center, size] = circles_[at].disk;
      const double power = squared_norm(p - center) - size;
      if ((power < 0 && is_sure(power, size)) || t.is_ghost()) return at;
      const std::uint32_t i = side_after(came), j = side_before(came);
      const Vec2 a = points_[t.vertex[i]], b = points_[t.vertex[j]], c = points_[t.vertex[came]];
      const bool beyond_first = is_right_of(a, b, p), beyond_second = is_right_of(b, c, p);
      if (!beyond_first && !beyond_second) return at;
      const std::uint32_t through = t.twin[beyond_first ? i : j];
      came = through & 3U;
      at = through >> 2U;
    }
  }

  /// Finds all triangles in conflict with a point, beginning with one of them, plus two new ones,
  /// and the sides of the region that they cover. The triangles form a tree, because no vertex lies
  /// inside the region. There are no branches on conflicts, which would be unpredictable.
  void find_cavity(Vec2 p, std::uint32_t first) {
    std::size_t inside = 0, sides = 0;
    const auto look = [&](std::uint32_t beyond) {
      const auto& [center, size] = circles_[beyond >> 2U].disk;
      const double power = squared_norm(p - center) - size;
      std::size_t conflict = bit_cast<std::uint64_t>(power) >> 63U;  // 1 where it is negative
      if (!is_sure(power, size)) [[unlikely]]
        conflict = is_in_conflict(triangles_[beyond >> 2U], p) ? 1 : 0;
      entered_[inside] = sides_[sides] = beyond;
      inside += conflict;
      sides += 1 - conflict;
    };
    cavity_[0] = first;
    for (const std::uint32_t beyond : triangles_[first].twin) look(beyond);
    for (std::size_t i = 0; i < inside; ++i) {
      const std::uint32_t side = entered_[i] & 3U, t = entered_[i] >> 2U;
      cavity_[i + 1] = t;
      const std::uint32_t next = triangles_[t].twin[side_after(side)];
      const std::uint32_t before = triangles_[t].twin[side_before(side)];
      look(next);
      look(before);
      if (inside + 5 > entered_.size()) [[unlikely]]
        make_room();
    }
    side_count_ = sides;
    for (++inside; inside < sides; ++inside) {
      cavity_[inside] = static_cast<std::uint32_t>(triangles_.size());
      add_triangle({});
    }
  }
  void make_room() {
    const std::size_t room = 2 * entered_.size();
    for (auto* numbers : {&entered_, &cavity_, &sides_, &from_, &to_}) numbers->resize(room);
  }

  /// A triangle on each side, in the place of those that go and of the new ones.
  void fill_cavity(std::uint32_t p) {
    const auto at_outside = static_cast<std::uint32_t>(points_.size());
    for (std::size_t k = 0; k < side_count_; ++k) {
      const std::uint32_t beyond = sides_[k], side = beyond & 3U;
      const Delaunay::Triangle& t = triangles_[beyond >> 2U];
      const std::uint32_t from = t.vertex[side_after(side)];
      from_[k] = from;
      to_[k] = t.vertex[side];
      leaving_[std::min(from, at_outside)] = 4 * cavity_[k];
    }
    leaving_[p] = 4 * cavity_[0] + 2;
    const Vec2 apex = points_[p];
    for (std::size_t k = 0; k < side_count_; ++k) {
      const std::uint32_t from = from_[k], to = to_[k], beyond = sides_[k];
      const std::uint32_t own = 4 * cavity_[k], after = leaving_[std::min(to, at_outside)];
      Delaunay::Triangle& t = triangles_[own >> 2U];
      Disk& circle = circles_[own >> 2U].disk;
      t.vertex = {from, to, p};
      t.twin[0] = beyond;
      t.twin[1] = after + 2;
      triangles_[after >> 2U].twin[2] = own + 1;
      triangles_[beyond >> 2U].twin[beyond & 3U] = own;
      if (from == outside || to == outside) [[unlikely]] {
        t.mark = 0;
        circle = {{}, endless};
      } else {
        t.mark = set_circle(apex, points_[from] - apex, points_[to] - apex, circle);
      }
    }
    last_ = cavity_[0];
  }
  /// 1 if it has all of its digits.
  static std::uint32_t set_circle(Vec2 apex, Vec2 u, Vec2 v, Disk& circle) {
    const double uu = squared_norm(u), vv = squared_norm(v), factor = 0.5 / cross(u, v);
    const Vec2 offset{factor * (uu * v.y - vv * u.y), factor * (vv * u.x - uu * v.x)};
    // S / 2 A, too large where products may underflow; negative or not a number by rounding alone.
    const double spread = factor * (uu + vv + 0x1p-455);
    circle = {apex + offset, spread > 0 && spread < 0x1p20 ? squared_norm(offset) : endless};
    return spread > 0 && spread < 8 ? 1 : 0;
  }

  const std::vector<Vec2>& points_;
  std::vector<Delaunay::Triangle>& triangles_;
  std::vector<Node>& circles_;
  std::vector<std::uint32_t>& leaving_;
  double slack_ = endless, area_error_ = endless;
  std::uint32_t last_ = 0;
  std::size_t side_count_ = 0;
  std::vector<std::uint32_t> entered_ = std::vector<std::uint32_t>(64), cavity_ = entered_,
                             sides_ = entered_, from_ = entered_, to_ = entered_;
};

}  // namespace

Delaunay triangulate(std::span<const Vec2> points, const LocalFrame& local,
                     const std::atomic<bool>* cancel) {
  Delaunay result;
  result.input = insertion_order(points);
  reserve_large(result.points, points.size());
  constexpr std::size_t ahead = 32;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k + ahead < points.size()) __builtin_prefetch(&points[result.input[k + ahead]]);
    result.points.push_back(local.to_local(points[result.input[k]]));
  }
  const auto count = static_cast<std::uint32_t>(points.size());
  std::uint32_t third = 2;
  while (third < count &&
         orientation(result.points[0], result.points[1], result.points[third]) == 0)
    ++third;
  if (third >= count) return result;
  std::swap(result.points[2], result.points[third]);
  std::swap(result.input[2], result.input[third]);
  Insertion insertion(result);
  insertion.begin();
  constexpr std::uint32_t between_checks = 0x4000;
  for (std::uint32_t p = 3; p < count; ++p) {
    if (p % between_checks == 0 && cancel != nullptr && cancel->load()) break;
    insertion.insert(p);
  }
  return result;
}

}  // namespace medial::voronoi
