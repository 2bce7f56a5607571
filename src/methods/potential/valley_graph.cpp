#include "methods/potential/valley_graph.h"

#include <algorithm>
#include <cmath>

namespace medial::potential {
namespace {

double segment_distance(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double square = squared_norm(along);
  const double t = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
  return distance(p, a + t * along);
}

}  // namespace

template <class Visit>
void LinkIndex::visit(int level, Vec2 low, Vec2 high, const Visit& act) {
  const double cell = std::ldexp(1.0, level);
  const auto at = [cell](double x) { return static_cast<std::int64_t>(std::floor(x / cell)); };
  const std::int64_t right = std::min(at(high.x), at(low.x) + 8);
  const std::int64_t top = std::min(at(high.y), at(low.y) + 8);
  for (std::int64_t i = at(low.x); i <= right; ++i)
    for (std::int64_t k = at(low.y); k <= top; ++k) {
      const auto hash = static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15U ^
                        static_cast<std::uint64_t>(k) * 0xC2B2AE3D27D4EB4FU ^
                        static_cast<std::uint64_t>(level) * 0x165667B19E3779F9U;
      act(hash);
    }
}

void LinkIndex::add(std::uint32_t link, Vec2 a, Vec2 b, double scale) {
  visit(std::ilogb(scale), {std::min(a.x, b.x), std::min(a.y, b.y)},
        {std::max(a.x, b.x), std::max(a.y, b.y)},
        [&](std::uint64_t key) { cells_[key].push_back(link); });
}

template <class Take>
void LinkIndex::near(Vec2 p, double reach, double scale, const Take& take) const {
  const int level = std::ilogb(scale);
  for (int l = level - 2; l <= level + 2; ++l) {
    visit(l, {p.x - reach, p.y - reach}, {p.x + reach, p.y + reach}, [&](std::uint64_t key) {
      const auto cell = cells_.find(key);
      if (cell == cells_.end()) return;
      for (const std::uint32_t link : cell->second) take(link);
    });
  }
}

std::uint32_t ValleyGraph::add_point(const ValleyPoint& point) {
  skeleton.points.push_back(point);
  first_.push_back(no_point);
  return parts_.add();
}

void ValleyGraph::add_link(std::uint32_t from, std::uint32_t to) {
  if (from == to) return;
  const ValleyPoint &a = skeleton.points[from], &b = skeleton.points[to];
  links_.add(static_cast<std::uint32_t>(skeleton.links.size()), a.place, b.place,
             reach(std::max(a.radius, b.radius)));
  for (const std::uint32_t end : {from, to}) {
    next_.push_back(first_[end]);
    first_[end] = static_cast<std::uint32_t>(next_.size() - 1);
  }
  skeleton.links.push_back({from, to});
  parts_.join(from, to);
}

std::vector<Vec2> ValleyGraph::way(std::uint32_t from, std::uint32_t to) const {
  // Breadth-first search from the far end, so that the way is found in order.
  std::vector<std::uint32_t> after(skeleton.points.size(), no_point);
  std::vector<std::uint32_t> queue = {to};
  after[to] = to;
  for (std::size_t i = 0; i < queue.size() && after[from] == no_point; ++i)
    for (std::uint32_t end = first_[queue[i]]; end != no_point; end = next_[end]) {
      const std::uint32_t other = skeleton.links[end / 2][1 - end % 2];
      if (after[other] != no_point) continue;
      after[other] = queue[i];
      queue.push_back(other);
    }
  std::vector<Vec2> places = {skeleton.points[from].place};
  while (from != to && after[from] != no_point) {
    from = after[from];
    places.push_back(skeleton.points[from].place);
  }
  return places;
}

std::uint32_t ValleyGraph::minimum_at(const ValleyPoint& point) {
  for (const std::uint32_t known : minima_) {
    const ValleyPoint& other = skeleton.points[known];
    if (distance(other.place, point.place) <= 0.1 * reach(std::min(point.radius, other.radius)))
      return known;
  }
  const std::uint32_t index = add_point(point);
  minima_.push_back(index);
  ++skeleton.minima;
  return index;
}

std::uint32_t ValleyGraph::joined(Vec2 q, double radius, Vec2 direction, double share,
                                  bool any_way) const {
  const double scale = reach(radius);
  double best = share * scale;
  std::uint32_t next = no_point;
  links_.near(q, best, scale, [&](std::uint32_t index) {
    const auto& link = skeleton.links[index];
    const Vec2 a = skeleton.points[link[0]].place, b = skeleton.points[link[1]].place;
    const double away = segment_distance(q, a, b);
    if (away >= best) return;
    const double same = dot(b - a, direction), enough = 0.3 * norm(b - a);
    if (!(same >= enough || (any_way && same <= -enough))) return;
    best = away;
    next = same > 0 ? link[1] : link[0];
  });
  return next;
}

std::uint32_t ValleyGraph::crossed(Vec2 p, Vec2 q, double radius) const {
  std::uint32_t found = no_point;
  links_.near(midpoint(p, q), 0.5 * distance(p, q), reach(radius), [&](std::uint32_t index) {
    const auto [from, to] = skeleton.links[index];
    const Vec2 a = skeleton.points[from].place, b = skeleton.points[to].place;
    const double at_a = cross(q - p, a - p), at_b = cross(q - p, b - p);
    const double at_p = cross(b - a, p - a), at_q = cross(b - a, q - a);
    // If both ends are on one line, they do not cross; if one is, they do.
    if (at_a * at_b > 0 || at_p * at_q > 0 || (at_a == 0 && at_b == 0)) return;
    found = std::abs(at_a) < std::abs(at_b) ? from : to;
  });
  return found;
}

}  // namespace medial::potential
