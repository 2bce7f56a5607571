#include "verify/distance_tree.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "base/pair.h"
#include "base/threads.h"
#include "base/wide.h"
#include "verify/between_feet.h"
#include "verify/piece_order.h"

namespace medial::verify_detail {
namespace two {

using Several = Pair;
using Each = Pairwise;
constexpr std::uint32_t lanes = 2;
inline Several several_at(const double* place) { return pair_at(place); }
inline Several all_of(double value) { return both(value); }
inline unsigned bits(Each what) { return static_cast<unsigned>((what[0] & 1) | (what[1] & 2)); }

#include "verify/near_search.h"

}  // namespace two

#ifdef MEDIAL_HAS_WIDE
#pragma GCC push_options
#pragma GCC target("avx2")
namespace four {

using Several = double __attribute__((vector_size(32)));
using Each = decltype(Several{} < Several{});
constexpr std::uint32_t lanes = 4;
inline Several several_at(const double* place) {
  Several all;
  std::memcpy(&all, place, sizeof all);
  return all;
}
inline Several all_of(double value) { return Several{value, value, value, value}; }
inline Several larger(Several a, Several b) { return __builtin_ia32_maxpd256(a, b); }
inline Several smaller(Several a, Several b) { return __builtin_ia32_minpd256(a, b); }
inline Several size_of(Several a) { return larger(a, -a); }
inline Several with_sign_of(Several size, Several other) { return other < 0 ? -size : size; }
inline unsigned bits(Each what) {
  return static_cast<unsigned>(__builtin_ia32_movmskpd256(Several(what)));
}

#include "verify/near_search.h"

}  // namespace four
#pragma GCC pop_options
#endif

namespace {

/// Below this many edges no tree is built.
constexpr std::size_t brute_force = 16;
/// Above this many edges the box of a set is not turned: it would be about as large.
constexpr std::size_t largest_turned = 4096;
constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();
constexpr double endless = std::numeric_limits<double>::infinity();

/// The angle of the longest pieces. Longer arcs are bounded piece by piece: the boxes of concentric
/// half circles would lie in each other, and all of them in the way of every query. Shorter pieces
/// are more, in the way as well: as 1 / angle, where boxes that lie in each other are as its
/// square.
double longest_piece_of(const std::vector<BoundaryEdge>& edges, const Box& box) {
  constexpr double longest = std::numbers::pi / 4, shortest = std::numbers::pi / 32;
  constexpr double largest_bulge = 0.19891236737965800;  // of the longest: tan(pi / 16)
  constexpr double usual = 200;                          // boxes around a place
  double area = 0;
  for (const BoundaryEdge& edge : edges)
    if (std::abs(edge.bulge) > largest_bulge)
      area += 0.5 * std::abs(edge.bulge) * squared_norm(edge.end - edge.start);
  const double whole = (box.high.x - box.low.x) * (box.high.y - box.low.y);
  if (!(area > usual * whole)) return longest;
  return std::max(shortest, longest * std::cbrt(usual * whole / area));
}

/// Calls `visit` with the edge, cut into pieces of at most `longest_piece`.
template <class Visitor>
void for_each_piece(const BoundaryEdge& edge, double longest_piece, const Visitor& visit) {
  if (4 * std::abs(edge.bulge) <= longest_piece * (1 - edge.bulge * edge.bulge)) return visit(edge);
  const double angle = 4 * std::atan(edge.bulge);
  const double count = std::ceil(std::abs(angle) / longest_piece);
  if (count <= 1) return visit(edge);
  const double length = length_of(edge);
  Vec2 start = edge.start;
  for (double k = 1; k <= count; ++k) {
    const Vec2 end = point_at(edge, length * (k / count));
    visit({start, end, std::tan(0.25 * angle / count)});
    start = end;
  }
}

std::vector<BoundaryEdge> in_order(const std::vector<BoundaryEdge>& edges,
                                   const std::vector<std::uint32_t>& order) {
  std::vector<BoundaryEdge> ordered;
  ordered.reserve(order.size());
  for (const std::uint32_t i : order) ordered.push_back(edges[i]);
  return ordered;
}

std::vector<BoundaryEdge> edges_of(const Shape& shape) {
  std::vector<BoundaryEdge> edges;
  edges.reserve(shape.points.size());
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    for (std::size_t j = 0; j < loop.size(); ++j)
      edges.push_back(
          {loop[j], loop[j + 1 < loop.size() ? j + 1 : 0], shape.bulge(shape.loop_begin[i] + j)});
  }
  return edges;
}

}  // namespace

EdgeArcs arcs_of(const Shape& shape) {
  return shape.bulges.empty() ? EdgeArcs() : EdgeArcs(edges_of(shape));
}

DistanceTree::DistanceTree(const Shape& shape)
    : DistanceTree(edges_of(shape), bounding_box(shape), !shape.bulges.empty()) {}

DistanceTree::DistanceTree(std::vector<BoundaryEdge> edges, const Box& box, bool arcs)
    : own_arcs_(arcs ? EdgeArcs(edges) : EdgeArcs()), arcs_(&own_arcs_) {
  build(std::move(edges), box);
}

DistanceTree::DistanceTree(const Shape& shape, const Box& box, const EdgeArcs& arcs)
    : arcs_(&arcs) {
  build(edges_of(shape), box);
}

/// The first points of a set in each of four directions.
struct DistanceTree::Extremes {
  Vec2 left{endless, 0}, right{-endless, 0}, bottom{0, endless}, top{0, -endless};

  void add(const Extremes& other) {
    if (other.left.x < left.x) left = other.left;
    if (other.right.x > right.x) right = other.right;
    if (other.bottom.y < bottom.y) bottom = other.bottom;
    if (other.top.y > top.y) top = other.top;
  }
  void add(Vec2 p) { add({p, p, p, p}); }
};

/// The edges of these numbers, in order; edge_at(i) is the one with number index[i].
template <class EdgeAt>
std::vector<Run> DistanceTree::runs_of(const std::vector<std::uint32_t>& index,
                                       const EdgeAt& edge_at) {
  std::vector<Run> runs((index.size() + fan_out - 1) / fan_out);
  for (std::size_t i = 0; i < runs.size() * fan_out; ++i) {
    const std::size_t from = std::min(i, index.size() - 1);
    runs[i / fan_out].set(i % fan_out, edge_at(from), index[from]);
  }
  return runs;
}

void DistanceTree::build(std::vector<BoundaryEdge> edges, const Box& box) {
  const bool arcs = !arcs_->empty();
  origin_ = box.low;
  slack_ = 16 * machine_epsilon * diagonal(box);
  // The ends of an arc's pieces are rounded.
  if (arcs)
    for (const double c : {box.low.x, box.low.y, box.high.x, box.high.y})
      slack_ = std::max(slack_, 16 * machine_epsilon * std::abs(c));
  if (edges.size() > brute_force) {
    const std::vector<BoundaryEdge> pieces = fill_runs(std::move(edges), box);  // frees the edges
    build_levels(pieces, diagonal(box));
    return;
  }
  std::vector<std::uint32_t> index(edges.size());
  std::iota(index.begin(), index.end(), 0U);
  runs_ = runs_of(index, [&](std::size_t i) { return edges[i]; });
}

/// Makes runs of many edges, and returns the pieces that they are bounded by.
std::vector<BoundaryEdge> DistanceTree::fill_runs(std::vector<BoundaryEdge> edges, const Box& box) {
  if (arcs_->empty()) {
    const std::vector<std::uint32_t> order = order_of(edges);
    edges = in_order(edges, order);
    runs_ = runs_of(order, [&](std::size_t i) { return edges[i]; });
    return edges;
  }
  std::vector<BoundaryEdge> pieces;
  std::vector<std::uint32_t> whole;              // the edge of each piece
  pieces.reserve(edges.size() + arcs_->size());  // a quarter of a circle is two
  const double longest_piece = longest_piece_of(edges, box);
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    for_each_piece(edges[i], longest_piece, [&](const BoundaryEdge& piece) {
      pieces.push_back(piece);
      whole.push_back(i);
    });
  }
  std::vector<std::uint32_t> order = order_of(pieces);
  pieces = in_order(pieces, order);
  for (std::uint32_t& i : order) i = whole[i];
  runs_ = runs_of(order, [&](std::size_t i) { return edges[order[i]]; });
  return pieces;
}

void DistanceTree::build_levels(const std::vector<BoundaryEdge>& pieces, double size) {
  std::size_t run = fan_out;  // edges below one bound
  // Of the sets of the level below; those of the lowest one, which are many, are made again.
  std::vector<Extremes> below;
  while (true) {
    const std::size_t bounds = (pieces.size() + run - 1) / run;
    std::vector<Bounds> level((bounds + fan_out - 1) / fan_out);
    std::vector<Extremes> extremes(levels_.empty() ? 0 : level.size() * fan_out);
    parallel_for(level.size() * fan_out, [&](std::size_t i) {
      const std::size_t begin = std::min(i * run, pieces.size());
      const std::span set{pieces.data() + begin, std::min(run, pieces.size() - begin)};
      Extremes all;
      for (std::size_t k = i * fan_out; k < std::min((i + 1) * fan_out, below.size()); ++k)
        all.add(below[k]);
      if (below.empty())
        for (const BoundaryEdge& edge : set) for_each_hull_point(edge, [&](Vec2 p) { all.add(p); });
      if (!extremes.empty()) extremes[i] = all;
      bound(set, all, level[i / fan_out], i % fan_out);
    });
    below = std::move(extremes);
    levels_.push_back(std::move(level));
    clearances_.push_back(clearances_of(pieces, run, size));
    if (bounds <= fan_out || pieces.size() <= few_pieces) break;
    run *= fan_out;
  }
}

/// Bounds edges, or pieces of them; nothing is near to an empty set.
void DistanceTree::bound(std::span<const BoundaryEdge> edges, const Extremes& extremes,
                         Bounds& bounds, std::size_t place) const {
  const auto [left, right, bottom, top] = extremes;
  const Box box{Vec2{left.x, bottom.y} - origin_, Vec2{right.x, top.y} - origin_};
  const auto area = [](const Box& of) { return (of.high.x - of.low.x) * (of.high.y - of.low.y); };
  bounds.set(place, {0, 1}, box);
  const Vec2 extent = right.x - left.x >= top.y - bottom.y ? right - left : top - bottom;
  if (edges.empty() || edges.size() > largest_turned || !(norm(extent) > 0)) return;
  const Vec2 along = (1 / norm(extent)) * extent, normal = left_of(along);
  Box turned = Box::nothing();
  for (const BoundaryEdge& edge : edges)
    for_each_hull_point(edge, [&](Vec2 p) {
      turned.add(Vec2{dot(along, p - origin_), dot(normal, p - origin_)});
    });
  if (area(turned) < area(box)) bounds.set(place, normal, turned);
}

/// A place behind the centre of the circle through three points of a set. From the centre all sets
/// around it are equally far in every direction; from behind it, a clearance says where its own set
/// lies. It is so far behind that the bend of the set shows beside what its points are off the
/// circle by. None of a set that bends round by more than a radius, which is seen from no such
/// place, and of one so flat or so uneven that the place would be far away.
std::optional<Vec2> DistanceTree::centre_behind(std::span<const BoundaryEdge> edges, double size) {
  constexpr double far_behind = 4, furthest = 0x1p-6;
  const Vec2 first = edges.front().start, middle = edges[edges.size() / 2].start,
             last = edges.back().end;
  const Vec2 a = first - middle, b = last - middle;
  const Vec2 to =
      (0.5 / cross(a, b)) * left_of(squared_norm(b) * a - squared_norm(a) * b);  // the centre
  const double radius = norm(to), chord = norm(last - first);
  if (!(chord <= radius && radius <= size)) return std::nullopt;
  const Vec2 centre = middle + to;
  double off = machine_epsilon * radius;
  for (const BoundaryEdge& edge : edges)
    off = std::max(off, std::abs(medial::distance(centre, edge.start) - radius));
  const double angle = 0.5 * chord / radius, behind = far_behind * off / (angle * angle);
  if (!(behind <= furthest * radius)) return std::nullopt;
  return centre + (behind / radius) * to;
}

/// The clearances of sets of `run` edges each; none where few sets are round.
std::vector<DistanceTree::Clearances> DistanceTree::clearances_of(
    const std::vector<BoundaryEdge>& edges, std::size_t run, double size) {
  if (run > largest_turned) return {};
  const std::size_t sets = (edges.size() + run - 1) / run;
  std::vector<Clearances> level((sets + fan_out - 1) / fan_out);
  std::atomic<std::size_t> round = 0;
  parallel_for(level.size() * fan_out, [&](std::size_t i) {
    const std::size_t begin = i * run;
    if (begin >= edges.size()) return;
    const std::span set{edges.data() + begin, std::min(run, edges.size() - begin)};
    const std::optional<Vec2> centre = centre_behind(set, size);
    if (!centre) return;
    double nearest = endless;
    for (const BoundaryEdge& edge : set)
      nearest = std::min(nearest, distance_to_edge(*centre, edge));
    Clearances& clearances = level[i / fan_out];
    clearances.x[i % fan_out] = centre->x;
    clearances.y[i % fan_out] = centre->y;
    clearances.radius[i % fan_out] = (1 - 16 * machine_epsilon) * nearest;
    ++round;
  });
  if (4 * round < sets) return {};
  return level;
}

/// How far two numbers lie outside two intervals.
inline Pair outside(const double* low, const double* high, Pair at) {
  return larger(larger(pair_at(low) - at, at - pair_at(high)), both(0));
}

/// Squared distances from a place, relative to the origin, to the boxes of four sets of edges.
inline void DistanceTree::squared_bounds(const Bounds& bounds, Vec2 q, double (&squared)[fan_out]) {
  for (std::size_t j = 0; j < fan_out; j += 2) {
    const Pair normal_x = pair_at(bounds.normal_x + j), normal_y = pair_at(bounds.normal_y + j);
    const Pair along = outside(bounds.low_along + j, bounds.high_along + j,
                               normal_y * both(q.x) - normal_x * both(q.y));
    const Pair across = outside(bounds.low_across + j, bounds.high_across + j,
                                normal_x * both(q.x) + normal_y * both(q.y));
    const Pair square = along * along + across * across;
    std::memcpy(squared + j, &square, sizeof square);
  }
}

/// Raises lower bounds by the clearances of the sets.
inline void DistanceTree::raise(const Visit& visit, Vec2 p, double (&squared)[fan_out]) const {
  if (clearances_[visit.level].empty()) return;
  const Clearances& clearances = clearances_[visit.level][visit.index];
  for (std::size_t j = 0; j < fan_out; ++j) {
    const double x = p.x - clearances.x[j], y = p.y - clearances.y[j];
    const double least = std::max(0.0, clearances.radius[j] - std::sqrt(x * x + y * y));
    squared[j] = std::max(squared[j], least * least);
  }
}

/// Bounds round as well: a square this much larger loses no edge.
double DistanceTree::limit_for(double distance) const {
  const double limit = (1 + 8 * machine_epsilon) * (distance + slack_);
  // Nothing reaches the infinite bounds of empty sets.
  return std::min(limit * limit, std::numeric_limits<double>::max());
}

MEDIAL_WIDE bool DistanceTree::search(Vec2 p, double& best) const {
  double limit = limit_for(best);
  bool found = false;
  // Three brothers wait on each of at most 16 levels.
  std::array<Visit, 64> stack;
  std::size_t size = 0;
  const auto top = static_cast<std::uint32_t>(levels_.size() - 1);
  for (std::uint32_t i = 0; i < levels_[top].size(); ++i) stack[size++] = {top, i, 0};
  while (size > 0) {
    const Visit visit = stack[--size];
    if (visit.squared > limit) continue;
    double squared[fan_out];
    squared_bounds(levels_[visit.level][visit.index], p - origin_, squared);
    raise(visit, p, squared);
    // The nearest child goes on top.
    const auto child = static_cast<std::uint32_t>(visit.index * fan_out);
    const std::size_t base = size;
    for (std::uint32_t j = 0; j < fan_out; ++j) {
      if (!(squared[j] <= limit)) continue;
      if (visit.level == 0) {
        for (std::size_t i = 0; i < fan_out; ++i) {
          const double d = distance_to(runs_[child + j], i, p);
          if (d <= best) {
            best = d;
            found = true;
          }
        }
        // Nothing is nearer: where very many edges meet at p, the others need no look.
        if (best == 0) return found;
        limit = limit_for(best);
        continue;
      }
      std::size_t at = size++;
      for (; at > base && stack[at - 1].squared < squared[j]; --at) stack[at] = stack[at - 1];
      stack[at] = {visit.level - 1, child + j, squared[j]};
    }
  }
  return found;
}

template <class Wanted>
bool DistanceTree::search_near(const DiskHull& disks, double slack, const Wanted& wanted,
                               NearEdges& near) const {
#ifdef MEDIAL_HAS_WIDE
  if (__builtin_cpu_supports("avx2"))
    return four::find_near(four::EdgeHull(disks, slack), runs_, levels_, origin_, wanted, near);
#endif
  return two::find_near(two::EdgeHull(disks, slack), runs_, levels_, origin_, wanted, near);
}

/// Lowers the distances of places to those from an edge.
MEDIAL_WIDE void DistanceTree::lower(Places& places, const Run& run, std::size_t i) const {
  const Vec2 start{run.start_x[i], run.start_y[i]}, end{run.end_x[i], run.end_y[i]};
  const Segment segment(start, end);
  const double length = segment.length();
  const Vec2 along = length > 0 ? (1 / length) * (end - start) : end - start;
  const Arc* const arc = run.bulge[i] != 0 ? &(*arcs_)[run.index[i]] : nullptr;
  const double room = slack_ + 0.5 * std::abs(run.bulge[i]) * length;  // an arc's height
  for (std::size_t k = 0; k < places.size; k += 2) {
    const Pair x = pair_at(&places.x[k]), y = pair_at(&places.y[k]);
    const Pair from_x = x - both(start.x), from_y = y - both(start.y);
    const Pair place = both(along.x) * from_x + both(along.y) * from_y;
    const Pair across = both(along.x) * from_y - both(along.y) * from_x;
    const Pair beyond = larger(larger(-place, place - both(length)), both(0));
    const Pair known = pair_at(&places.distance[k]);
    const Pair reach = both(1 + 8 * machine_epsilon) * (known + both(room));
    if (all(across * across + beyond * beyond > reach * reach)) continue;
    const Pair signed_distances =
        arc != nullptr ? arc->signed_distances(x, y) : segment.signed_distances(x, y);
    const Pair lowered = smaller(size_of(signed_distances), known);
    std::memcpy(&places.distance[k], &lowered, sizeof lowered);
  }
}

bool DistanceTree::find_near(const DiskHull& disks, double tolerance, NearEdges& near) const {
  return search_near(
      disks, slack_ + tolerance, [](const Bounds&, std::size_t) { return true; }, near);
}

bool DistanceTree::find_near_between_feet(const DiskHull& disks, double tolerance,
                                          NearEdges& near) const {
  const BetweenFeet feet(disks, origin_, slack_);
  const auto is_there = [&](const Bounds& bounds, std::size_t set) {
    return !feet.misses(bounds, set);
  };
  return search_near(disks, slack_ + tolerance, is_there, near);
}

void DistanceTree::find_distances(const NearEdges* near, Places& places) const {
  if (near != nullptr)
    for (std::size_t i = 0; i < near->size; ++i)
      lower(places, runs_[near->place[i] / fan_out], near->place[i] % fan_out);
  for (std::size_t i = 0; i < places.size; i += 2) {
    const Pair expected = larger(pair_at(&places.radius[i]), both(0)) + both(places.tolerance);
    if (near != nullptr && all(pair_at(&places.distance[i]) <= expected))
      continue;  // nearly always
    for (std::size_t k = i; k < std::min(i + 2, places.size); ++k)
      if (near == nullptr || !(places.distance[k] <= expected[k - i]))
        places.distance[k] =
            distance(places.place(k), std::min(places.distance[k], expected[k - i]));
  }
}

double DistanceTree::some_distance(Vec2 p) const {
  // Down to the nearest box of each level.
  std::uint32_t index = 0;
  for (std::size_t level = levels_.size(); level-- > 0;) {
    double squared[fan_out];
    squared_bounds(levels_[level][index], p - origin_, squared);
    const auto best = std::min_element(std::begin(squared), std::end(squared)) - squared;
    index = index * static_cast<std::uint32_t>(fan_out) + static_cast<std::uint32_t>(best);
  }
  return distance_to(runs_[std::min<std::size_t>(index, runs_.size() - 1)], 0, p);
}

bool DistanceTree::is_farther(Vec2 p, double distance) const {
  if (levels_.empty()) return this->distance(p, distance) > distance;
  return !search(p, distance);
}

double DistanceTree::distance(Vec2 p, double expected) const {
  double best = expected;
  if (!levels_.empty()) {
    if (search(p, best)) return best;
    best = some_distance(p);
    search(p, best);
    return best;
  }
  best = endless;
  for (const Run& run : runs_)
    for (std::size_t i = 0; i < fan_out; ++i) best = std::min(best, distance_to(run, i, p));
  return best;
}

}  // namespace medial::verify_detail
