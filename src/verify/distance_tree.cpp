#include "verify/distance_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/spatial_order.h"
#include "base/threads.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace medial::verify_detail {
namespace {

constexpr std::size_t fan_out = 4;
/// Below this many edges no tree is built.
constexpr std::size_t brute_force = 16;
/// Above this many edges a set gets no slab: it would be about as wide as the box.
constexpr std::size_t largest_slab = 4096;
constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();
constexpr double endless = std::numeric_limits<double>::infinity();

/// Longer arcs are bounded piece by piece: the boxes of concentric half circles would lie in each
/// other, and all of them in the way of every query.
constexpr double longest_piece = std::numbers::pi / 8;

/// Calls `visit` with points whose hull holds the edge: its ends, and for an arc the corners of the
/// trapezoid whose other sides are tangent to it at the ends and in the middle.
template <class Visitor>
void for_each_hull_point(const BoundaryEdge& edge, const Visitor& visit) {
  visit(edge.start);
  visit(edge.end);
  if (edge.bulge == 0) return;
  const Vec2 chord = edge.chord();
  const Vec2 side = (0.25 * (1 - edge.bulge) * (1 + edge.bulge)) * chord;
  const Vec2 height = (-0.5 * edge.bulge) * left_of(chord);
  visit(edge.start + side + height);
  visit(edge.end - side + height);
}

/// Calls `visit` with the edge, cut into pieces of at most longest_piece.
template <class Visitor>
void for_each_piece(const BoundaryEdge& edge, const Visitor& visit) {
  const double angle = 4 * std::atan(edge.bulge);
  const double count = std::ceil(std::abs(angle) / longest_piece);
  if (count <= 1) {
    visit(edge);
    return;
  }
  const double length = length_of(edge);
  Vec2 start = edge.start;
  for (double k = 1; k <= count; ++k) {
    const Vec2 end = point_at(edge, length * (k / count));
    visit({start, end, std::tan(0.25 * angle / count)});
    start = end;
  }
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

DistanceTree::DistanceTree(const Shape& shape)
    : DistanceTree(edges_of(shape), bounding_box(shape), !shape.bulges.empty()) {}

DistanceTree::DistanceTree(std::span<const BoundaryEdge> edges, const Box& box, bool arcs) {
  if (edges.size() <= brute_force) {
    edges_.assign(edges.begin(), edges.end());
    return;
  }
  // Where there are arcs: the edge of each piece.
  std::vector<BoundaryEdge> pieces, wholes;
  std::vector<Vec2> middle;
  pieces.reserve(edges.size());
  middle.reserve(edges.size());
  for (const BoundaryEdge& edge : edges) {
    for_each_piece(edge, [&](const BoundaryEdge& piece) {
      pieces.push_back(piece);
      if (arcs) wholes.push_back(edge);
      middle.push_back(midpoint(piece.start, piece.end));
    });
  }
  const std::vector<std::uint32_t> order = spatial_order(middle, fan_out);
  const auto in_order = [&](const std::vector<BoundaryEdge>& unordered) {
    std::vector<BoundaryEdge> ordered;
    ordered.reserve(unordered.size());
    for (const std::uint32_t i : order) ordered.push_back(unordered[i]);
    return ordered;
  };
  pieces = in_order(pieces);
  if (arcs) edges_ = in_order(wholes);

  origin_ = box.low;
  slack_ = 16 * machine_epsilon * diagonal(box);
  // The ends of an arc's pieces are rounded.
  if (arcs)
    for (const double c : {box.low.x, box.low.y, box.high.x, box.high.y})
      slack_ = std::max(slack_, 16 * machine_epsilon * std::abs(c));
  std::size_t run = fan_out;  // edges below one bound
  while (true) {
    const std::size_t bounds = (pieces.size() + run - 1) / run;
    std::vector<Bounds> level((bounds + fan_out - 1) / fan_out);
    parallel_for(level.size() * fan_out, [&](std::size_t i) {
      const std::size_t begin = std::min(i * run, pieces.size());
      bound({pieces.data() + begin, std::min(run, pieces.size() - begin)}, level[i / fan_out],
            i % fan_out);
    });
    levels_.push_back(std::move(level));
    if (bounds <= fan_out) break;
    run *= fan_out;
  }
  if (!arcs) edges_ = std::move(pieces);
}

/// Bounds edges, or pieces of them; nothing is near to an empty set.
void DistanceTree::bound(std::span<const BoundaryEdge> edges, Bounds& bounds,
                         std::size_t place) const {
  Vec2 left{endless, 0}, right{-endless, 0}, bottom{0, endless}, top{0, -endless};
  const auto each_point = [&](auto work) {
    for (const BoundaryEdge& edge : edges) for_each_hull_point(edge, work);
  };
  each_point([&](Vec2 p) {
    if (p.x < left.x) left = p;
    if (p.x > right.x) right = p;
    if (p.y < bottom.y) bottom = p;
    if (p.y > top.y) top = p;
  });
  bounds.low_x[place] = left.x;
  bounds.high_x[place] = right.x;
  bounds.low_y[place] = bottom.y;
  bounds.high_y[place] = top.y;

  // Without a normal the slab is everything.
  Vec2 normal;
  double low = 0, high = 0;
  const Vec2 extent = right.x - left.x >= top.y - bottom.y ? right - left : top - bottom;
  if (!edges.empty() && edges.size() <= largest_slab && norm(extent) > 0) {
    normal = (1 / norm(extent)) * left_of(extent);
    low = endless;
    high = -endless;
    each_point([&](Vec2 p) {
      low = std::min(low, dot(normal, p - origin_));
      high = std::max(high, dot(normal, p - origin_));
    });
  }
  bounds.normal_x[place] = normal.x;
  bounds.normal_y[place] = normal.y;
  bounds.slab_low[place] = low;
  bounds.slab_high[place] = high;
}

/// Lower bounds of the squared distances from p to the four sets of edges.
inline void DistanceTree::squared_bounds(const Visit& visit, Vec2 p,
                                         double (&squared)[fan_out]) const {
  const Bounds& bounds = levels_[visit.level][visit.index];
  const Vec2 q = p - origin_;
#if defined(__SSE2__)
  const __m128d zero = _mm_setzero_pd();
  const __m128d px = _mm_set1_pd(p.x), py = _mm_set1_pd(p.y);
  const __m128d qx = _mm_set1_pd(q.x), qy = _mm_set1_pd(q.y);
  // How far two numbers lie outside two intervals.
  const auto outside = [zero](const double* low, const double* high, __m128d at) {
    return _mm_max_pd(
        _mm_max_pd(_mm_sub_pd(_mm_loadu_pd(low), at), _mm_sub_pd(at, _mm_loadu_pd(high))), zero);
  };
  for (std::size_t j = 0; j < fan_out; j += 2) {
    const __m128d x = outside(bounds.low_x + j, bounds.high_x + j, px);
    const __m128d y = outside(bounds.low_y + j, bounds.high_y + j, py);
    const __m128d along = _mm_add_pd(_mm_mul_pd(_mm_loadu_pd(bounds.normal_x + j), qx),
                                     _mm_mul_pd(_mm_loadu_pd(bounds.normal_y + j), qy));
    const __m128d across = outside(bounds.slab_low + j, bounds.slab_high + j, along);
    _mm_storeu_pd(squared + j, _mm_max_pd(_mm_add_pd(_mm_mul_pd(x, x), _mm_mul_pd(y, y)),
                                          _mm_mul_pd(across, across)));
  }
#else
  for (std::size_t j = 0; j < fan_out; ++j) {
    const auto larger = [](double a, double b) { return a > b ? a : b; };
    const double x = larger(larger(bounds.low_x[j] - p.x, p.x - bounds.high_x[j]), 0);
    const double y = larger(larger(bounds.low_y[j] - p.y, p.y - bounds.high_y[j]), 0);
    const double along = bounds.normal_x[j] * q.x + bounds.normal_y[j] * q.y;
    const double beside = larger(bounds.slab_low[j] - along, along - bounds.slab_high[j]);
    const double across = larger(beside, 0);
    squared[j] = larger(x * x + y * y, across * across);
  }
#endif
}

/// Bounds round as well: a square this much larger loses no edge.
double DistanceTree::limit_for(double distance) const {
  const double limit = (1 + 8 * machine_epsilon) * (distance + slack_);
  // Nothing reaches the infinite bounds of empty sets.
  return std::min(limit * limit, std::numeric_limits<double>::max());
}

bool DistanceTree::search(Vec2 p, double& best) const {
  double limit = limit_for(best);
  bool found = false;
  // Three brothers wait on each of at most 16 levels.
  std::array<Visit, 64> stack;
  std::size_t size = 0;
  stack[size++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0, 0};
  while (size > 0) {
    const Visit visit = stack[--size];
    if (visit.squared > limit) continue;
    double squared[fan_out];
    squared_bounds(visit, p, squared);
    // The nearest child goes on top.
    const auto child = static_cast<std::uint32_t>(visit.index * fan_out);
    const std::size_t base = size;
    for (std::uint32_t j = 0; j < fan_out; ++j) {
      if (!(squared[j] <= limit)) continue;
      if (visit.level == 0) {
        const std::size_t begin = std::size_t{child + j} * fan_out;
        for (std::size_t i = begin; i < std::min(begin + fan_out, edges_.size()); ++i) {
          const double d = distance_to_edge(p, edges_[i]);
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

void DistanceTree::near(Vec2 p, double reach, std::size_t most,
                        std::vector<std::uint32_t>& found) const {
  found.clear();
  if (levels_.empty()) return;
  const double limit = limit_for(reach);
  std::array<Visit, 64> stack;
  std::size_t size = 0;
  stack[size++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0, 0};
  while (size > 0) {
    const Visit visit = stack[--size];
    double squared[fan_out];
    squared_bounds(visit, p, squared);
    for (std::uint32_t j = 0; j < fan_out; ++j) {
      if (!(squared[j] <= limit)) continue;
      const auto child = static_cast<std::uint32_t>(visit.index * fan_out) + j;
      if (visit.level > 0) {
        stack[size++] = {visit.level - 1, child, squared[j]};
        continue;
      }
      const std::size_t begin = std::size_t{child} * fan_out;
      for (std::size_t i = begin; i < std::min(begin + fan_out, edges_.size()); ++i)
        if (distance_to_edge(p, edges_[i]) <= reach + slack_)
          found.push_back(static_cast<std::uint32_t>(i));
      if (found.size() > most) return found.clear();
    }
  }
}

double DistanceTree::some_distance(Vec2 p) const {
  // Down to the nearest box of each level.
  std::uint32_t index = 0;
  for (std::size_t level = levels_.size(); level-- > 0;) {
    const Bounds& boxes = levels_[level][index];
    std::uint32_t best = 0;
    double nearest = endless;
    for (std::uint32_t j = 0; j < fan_out; ++j) {
      const double x = std::max({boxes.low_x[j] - p.x, 0.0, p.x - boxes.high_x[j]});
      const double y = std::max({boxes.low_y[j] - p.y, 0.0, p.y - boxes.high_y[j]});
      if (std::hypot(x, y) < nearest) {
        nearest = std::hypot(x, y);
        best = j;
      }
    }
    index = index * static_cast<std::uint32_t>(fan_out) + best;
  }
  return distance_to_edge(p, edges_[std::min(index * fan_out, edges_.size() - 1)]);
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
  for (const BoundaryEdge& edge : edges_) best = std::min(best, distance_to_edge(p, edge));
  return best;
}

double DistanceTree::distance(Vec2 p, double expected, std::span<const std::uint32_t> near) const {
  double best = endless;
  for (const std::uint32_t i : near) best = std::min(best, distance_to_edge(p, edges_[i]));
  return best <= expected ? best : distance(p, expected);
}

}  // namespace medial::verify_detail
