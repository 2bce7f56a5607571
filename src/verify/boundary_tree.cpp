#include "verify/boundary_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/spatial_order.h"

namespace medial::verify_detail {
namespace {

constexpr std::size_t kFanOut = 4;
/// Below this many edges no tree is built.
constexpr std::size_t kBruteForce = 16;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const Vec2 from_a = p - a, from_b = p - b;
  const double along_a = dot(from_a, d), along_b = -dot(from_b, d);
  if (along_a <= 0) return norm(from_a);
  if (along_b <= 0) return norm(from_b);
  return std::abs(cross(d, along_a <= along_b ? from_a : from_b)) / norm(d);
}

BoundaryTree::BoundaryTree(const Shape& shape) {
  std::vector<Segment> unordered;
  std::vector<Vec2> middle;
  unordered.reserve(shape.points.size());
  middle.reserve(shape.points.size());
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    for (std::size_t j = 0; j < loop.size(); ++j) {
      unordered.push_back({loop[j], loop[j + 1 < loop.size() ? j + 1 : 0]});
      middle.push_back(midpoint(unordered.back().a, unordered.back().b));
    }
  }
  if (unordered.size() <= kBruteForce) {
    segments_ = std::move(unordered);
    return;
  }
  segments_.reserve(unordered.size());
  for (const std::uint32_t i : spatial_order(middle, kFanOut)) segments_.push_back(unordered[i]);

  // Empty places of the last box in a level are boxes that nothing is near to.
  const Boxes empty{{kInfinity, kInfinity, kInfinity, kInfinity},
                    {kInfinity, kInfinity, kInfinity, kInfinity},
                    {-kInfinity, -kInfinity, -kInfinity, -kInfinity},
                    {-kInfinity, -kInfinity, -kInfinity, -kInfinity}};
  std::vector<Boxes> level((segments_.size() + kFanOut - 1) / kFanOut, empty);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const auto [a, b] = segments_[i];
    Boxes& boxes = level[i / kFanOut];
    boxes.low_x[i % kFanOut] = std::min(a.x, b.x);
    boxes.low_y[i % kFanOut] = std::min(a.y, b.y);
    boxes.high_x[i % kFanOut] = std::max(a.x, b.x);
    boxes.high_y[i % kFanOut] = std::max(a.y, b.y);
  }
  levels_.push_back(std::move(level));
  while (levels_.back().size() > 1) {
    const std::vector<Boxes>& below = levels_.back();
    std::vector<Boxes> above((below.size() + kFanOut - 1) / kFanOut, empty);
    for (std::size_t i = 0; i < below.size(); ++i) {
      Boxes& boxes = above[i / kFanOut];
      const std::size_t j = i % kFanOut;
      boxes.low_x[j] = *std::min_element(below[i].low_x, below[i].low_x + kFanOut);
      boxes.low_y[j] = *std::min_element(below[i].low_y, below[i].low_y + kFanOut);
      boxes.high_x[j] = *std::max_element(below[i].high_x, below[i].high_x + kFanOut);
      boxes.high_y[j] = *std::max_element(below[i].high_y, below[i].high_y + kFanOut);
    }
    levels_.push_back(std::move(above));
  }
}

bool BoundaryTree::search(Vec2 p, double& best) const {
  // The boxes' squared distances round; a bound one part in 10^15 larger loses no edge.
  constexpr double slack = 1 + 8 * std::numeric_limits<double>::epsilon();
  double bound = best * best * slack;
  bool found = false;
  struct Visit {
    std::uint32_t level, index;
    double squared;
  };
  // Three brothers wait on each of at most 16 levels.
  std::array<Visit, 64> stack;
  std::size_t size = 0;
  stack[size++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0, 0};
  while (size > 0) {
    const Visit visit = stack[--size];
    if (visit.squared > bound) continue;
    const Boxes& boxes = levels_[visit.level][visit.index];
    double squared[kFanOut];
    for (std::size_t j = 0; j < kFanOut; ++j) {
      const double below_x = boxes.low_x[j] - p.x, above_x = p.x - boxes.high_x[j];
      const double below_y = boxes.low_y[j] - p.y, above_y = p.y - boxes.high_y[j];
      const double outer_x = below_x > above_x ? below_x : above_x;
      const double outer_y = below_y > above_y ? below_y : above_y;
      const double x = outer_x > 0 ? outer_x : 0, y = outer_y > 0 ? outer_y : 0;
      squared[j] = x * x + y * y;
    }
    const auto child = static_cast<std::uint32_t>(visit.index * kFanOut);
    if (visit.level == 0) {
      for (std::uint32_t j = 0; j < kFanOut; ++j) {
        if (!(squared[j] <= bound) || child + j >= segments_.size()) continue;
        const double d = segment_distance(child + j, p);
        if (d <= best) {
          best = d;
          bound = d * d * slack;
          found = true;
        }
      }
      continue;
    }
    // The nearest child goes on top.
    const std::size_t base = size;
    for (std::uint32_t j = 0; j < kFanOut; ++j) {
      if (!(squared[j] <= bound)) continue;
      std::size_t at = size++;
      for (; at > base && stack[at - 1].squared < squared[j]; --at) stack[at] = stack[at - 1];
      stack[at] = {visit.level - 1, child + j, squared[j]};
    }
  }
  return found;
}

double BoundaryTree::some_distance(Vec2 p) const {
  // Down to the nearest box of each level.
  std::uint32_t index = 0;
  for (std::size_t level = levels_.size(); level-- > 0;) {
    const Boxes& boxes = levels_[level][index];
    std::uint32_t best = 0;
    double nearest = kInfinity;
    for (std::uint32_t j = 0; j < kFanOut; ++j) {
      const double x = std::max({boxes.low_x[j] - p.x, 0.0, p.x - boxes.high_x[j]});
      const double y = std::max({boxes.low_y[j] - p.y, 0.0, p.y - boxes.high_y[j]});
      if (std::hypot(x, y) < nearest) {
        nearest = std::hypot(x, y);
        best = j;
      }
    }
    index = index * static_cast<std::uint32_t>(kFanOut) + best;
  }
  return index < segments_.size() ? segment_distance(index, p) : kInfinity;
}

double BoundaryTree::distance(Vec2 p, double expected) const {
  double best = expected;
  if (!levels_.empty()) {
    if (search(p, best)) return best;
    best = some_distance(p);
    search(p, best);
    return best;
  }
  best = kInfinity;
  for (std::uint32_t i = 0; i < segments_.size(); ++i)
    best = std::min(best, segment_distance(i, p));
  return best;
}

}  // namespace medial::verify_detail
