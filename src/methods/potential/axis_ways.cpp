#include "methods/potential/axis_ways.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/numbers.h"

namespace medial::potential {
namespace {

/// The point of the axis whose disk contains p, with p as close to its centre as possible.
std::uint32_t seen_from(const Skeleton& axis, Vec2 p) {
  std::pair<double, std::uint32_t> best{std::numeric_limits<double>::infinity(), 0};
  for (std::uint32_t i = 0; i < axis.points.size(); ++i) {
    const ValleyPoint& point = axis.points[i];
    best = std::min(best, {distance(point.place, p) - point.radius, i});
  }
  return best.second;
}

}  // namespace

std::vector<AxisWay> ways_between(const Skeleton& axis, const Skeleton& skeleton,
                                  std::span<const std::uint32_t> points) {
  const std::size_t count = axis.points.size();
  std::vector<std::vector<std::uint32_t>> links(count);
  for (std::uint32_t i = 0; i < axis.links.size(); ++i)
    for (const std::uint32_t end : axis.links[i]) links[end].push_back(i);
  std::vector<AxisWay> ways;
  // Breadth-first search from all points at once. Each link that the search does not use is in a
  // way.
  std::vector<std::uint32_t> seed(count, none), reached_by(count, none), queue;
  for (const std::uint32_t point : points) {
    const std::uint32_t start = seen_from(axis, skeleton.points[point].place);
    if (seed[start] != none) {  // both ends are in its disk
      ways.push_back(
          {seed[start], point, {skeleton.points[seed[start]].place, skeleton.points[point].place}});
      continue;
    }
    seed[start] = point;
    queue.push_back(start);
  }
  std::vector<bool> used(axis.links.size());
  const auto other_end = [&](std::uint32_t link, std::uint32_t end) {
    return axis.links[link][0] == end ? axis.links[link][1] : axis.links[link][0];
  };
  for (std::size_t k = 0; k < queue.size(); ++k)
    for (const std::uint32_t link : links[queue[k]]) {
      const std::uint32_t next = other_end(link, queue[k]);
      if (seed[next] != none) continue;
      seed[next] = seed[queue[k]];
      reached_by[next] = link;
      used[link] = true;
      queue.push_back(next);
    }
  const auto add_back = [&](std::uint32_t here, std::vector<Vec2>& places) {
    places.push_back(axis.points[here].place);
    for (; reached_by[here] != none; places.push_back(axis.points[here].place))
      here = other_end(reached_by[here], here);
  };
  for (std::uint32_t i = 0; i < axis.links.size(); ++i) {
    const auto [a, b] = axis.links[i];
    if (used[i] || seed[a] == none) continue;
    AxisWay& way = ways.emplace_back(AxisWay{seed[a], seed[b], {}});
    add_back(a, way.places);
    way.places.push_back(skeleton.points[seed[a]].place);
    std::reverse(way.places.begin(), way.places.end());
    add_back(b, way.places);
    way.places.push_back(skeleton.points[seed[b]].place);
  }
  return ways;
}

}  // namespace medial::potential
