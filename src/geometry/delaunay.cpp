#include "geometry/delaunay.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/memory.h"
#include "base/predicates.h"
#include "base/random.h"
#include "base/spatial_order.h"

namespace medial::geometry {
namespace {

/// The order of insertion: rounds of a random eighth of what is left for later ones, each along the
/// curve, every other one backward, so that a round begins where the last one ended.
std::vector<std::uint32_t> insertion_order(std::span<const Vec2> points) {
  constexpr std::size_t smallest_round = 64;
  std::size_t rounds = 1;
  for (std::size_t count = points.size(); count > smallest_round; count /= 8) ++rounds;
  std::vector<std::vector<std::uint32_t>> members(rounds);
  members[0].reserve(points.size());
  Random random(points.size());
  for (const std::uint32_t i : z_order(points)) {
    const auto eighths = static_cast<std::size_t>(std::countr_zero(random.next())) / 3;
    members[std::min(eighths, rounds - 1)].push_back(i);
  }
  std::vector<std::uint32_t> order;
  order.reserve(points.size());
  for (std::size_t r = rounds; r-- > 0;) {
    if (r % 2 == 1) std::ranges::reverse(members[r]);
    order.insert(order.end(), members[r].begin(), members[r].end());
  }
  return order;
}

/// Inserts points one by one.
class Insertion {
 public:
  explicit Insertion(Delaunay& result) : points_(result.points), triangles_(result.triangles) {}

  /// From three points, the first ones, that are not on one line.
  void begin() {
    const bool left = orientation(points_[0], points_[1], points_[2]) > 0;
    const std::uint32_t b = left ? 1 : 2, c = left ? 2 : 1;
    // Triangle 0, and ghost 1 + i beyond its half-edge i.
    const std::array<std::uint32_t, 3> vertex{0, b, c};
    triangles_.push_back({vertex, 0, {4, 8, 12}, 0});
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t after = 1 + (i + 1) % 3, before = 1 + (i + 2) % 3;
      // The ghosts beyond the neighbours of edge i have a side each in common with this one.
      triangles_.push_back(
          {{vertex[(i + 1) % 3], vertex[i], outside}, 0, {i, 4 * before + 2, 4 * after + 1}, 0});
    }
  }

  void insert(std::uint32_t p) {
    find_cavity(points_[p], triangle_of(points_[p]));
    fill_cavity(p);
  }

 private:
  struct Side {
    std::uint32_t from, to;  ///< vertices
    std::uint32_t beyond;    ///< half-edge of the triangle that stays
  };

  bool is_in_conflict(const Delaunay::Triangle& t, Vec2 p) const {
    const auto& [a, b, c] = t.vertex;
    if (c != outside) return in_circle(points_[a], points_[b], points_[c], p) > 0;
    const int side = orientation(points_[a], points_[b], p);
    return side > 0 || (side == 0 && strictly_between(points_[a], p, points_[b]));
  }

  /// The triangle that holds a point, or a ghost beyond whose edge it lies: the walk that crosses
  /// any edge with the point on its other side ends in a Delaunay triangulation.
  std::uint32_t triangle_of(Vec2 p) const {
    std::uint32_t at = last_;
    if (triangles_[at].is_ghost()) at = triangles_[at].twin[0] >> 2U;
    std::uint32_t came = 3;  // half-edge that the walk came through
    while (true) {
      const Delaunay::Triangle& t = triangles_[at];
      if (t.is_ghost()) return at;
      std::uint32_t through = 3;
      for (std::uint32_t i = 0; i < 3 && through == 3; ++i)
        if (i != came &&
            orientation(points_[t.vertex[i]], points_[t.vertex[i == 2 ? 0 : i + 1]], p) < 0)
          through = i;
      if (through == 3) return at;
      came = t.twin[through] & 3U;
      at = t.twin[through] >> 2U;
    }
  }

  /// All triangles in conflict with a point, from one of them on, and the sides of what they cover,
  /// counter-clockwise. They hang together as a tree, since no vertex lies between them.
  void find_cavity(Vec2 p, std::uint32_t first) {
    cavity_.clear();
    sides_.clear();
    open_.clear();
    cavity_.push_back(first);
    for (std::uint32_t i = 3; i-- > 0;) open_.push_back(4 * first + i);
    while (!open_.empty()) {
      const std::uint32_t h = open_.back();
      open_.pop_back();
      const std::uint32_t beyond = triangles_[h >> 2U].twin[h & 3U];
      const Delaunay::Triangle& t = triangles_[beyond >> 2U];
      const std::uint32_t next = Delaunay::next(beyond), before = Delaunay::before(beyond);
      if (is_in_conflict(t, p)) {
        cavity_.push_back(beyond >> 2U);
        open_.push_back(before);
        open_.push_back(next);
      } else {
        sides_.push_back({t.vertex[next & 3U], t.vertex[beyond & 3U], beyond});
      }
    }
  }

  /// A triangle on each side, in the place of those that go, and two more.
  void fill_cavity(std::uint32_t p) {
    const std::size_t count = sides_.size();
    while (cavity_.size() < count) {
      cavity_.push_back(static_cast<std::uint32_t>(triangles_.size()));
      triangles_.emplace_back();
    }
    for (std::size_t k = 0; k < count; ++k) {
      const Side& side = sides_[k];
      const std::uint32_t own = cavity_[k];
      const std::uint32_t after = cavity_[k + 1 == count ? 0 : k + 1];
      const std::uint32_t previous = cavity_[k == 0 ? count - 1 : k - 1];
      // Corners in the order from, to, p; where one of them is outside, so that it comes last.
      const std::uint32_t turn = turn_of(side);
      // The neighbours' half-edges at p: of the next side p -> from, of the previous one to -> p.
      const std::uint32_t after_half =
          4 * after + slot(2, turn_of(sides_[k + 1 == count ? 0 : k + 1]));
      const std::uint32_t previous_half =
          4 * previous + slot(1, turn_of(sides_[k == 0 ? count - 1 : k - 1]));
      Delaunay::Triangle& t = triangles_[own];
      t.vertex[slot(0, turn)] = side.from;
      t.vertex[slot(1, turn)] = side.to;
      t.vertex[slot(2, turn)] = p;
      t.twin[slot(0, turn)] = side.beyond;
      t.twin[slot(1, turn)] = after_half;
      t.twin[slot(2, turn)] = previous_half;
      triangles_[side.beyond >> 2U].twin[side.beyond & 3U] = 4 * own + slot(0, turn);
    }
    last_ = cavity_[0];
  }
  static std::uint32_t turn_of(const Side& side) {
    return side.from == outside ? 2 : side.to == outside ? 1 : 0;
  }
  static std::uint32_t slot(std::uint32_t i, std::uint32_t turn) {
    const std::uint32_t at = i + turn;
    return at < 3 ? at : at - 3;
  }

  const std::vector<Vec2>& points_;
  std::vector<Delaunay::Triangle>& triangles_;
  std::uint32_t last_ = 0;
  std::vector<std::uint32_t> cavity_, open_;
  std::vector<Side> sides_;
};

}  // namespace

Delaunay triangulate(std::span<const Vec2> points, const std::atomic<bool>* cancel) {
  Delaunay result;
  result.input = insertion_order(points);
  result.points.reserve(points.size());
  for (const std::uint32_t i : result.input) result.points.push_back(points[i]);
  const auto count = static_cast<std::uint32_t>(points.size());
  std::uint32_t third = 2;
  while (third < count &&
         orientation(result.points[0], result.points[1], result.points[third]) == 0)
    ++third;
  if (third >= count) return result;
  std::swap(result.points[2], result.points[third]);
  std::swap(result.input[2], result.input[third]);
  reserve_large(result.triangles, 2 * std::size_t{count} - 2);
  Insertion insertion(result);
  insertion.begin();
  constexpr std::uint32_t between_checks = 0x4000;
  for (std::uint32_t p = 3; p < count; ++p) {
    if (p % between_checks == 0 && cancel != nullptr && cancel->load()) break;
    insertion.insert(p);
  }
  return result;
}

}  // namespace medial::geometry
