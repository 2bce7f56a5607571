#include "methods/potential/coarse_to_fine.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/threads.h"
#include "medial/compute.h"
#include "medial/shape.h"
#include "methods/potential/limit.h"
#include "methods/potential/successor.h"

namespace medial::potential {
namespace {

/// The points of a closed line to keep, so that no other point is further than `tolerance` from the
/// simplified line (Douglas and Peucker): at least three, in order.
std::vector<std::uint32_t> kept_points(const std::vector<Vec2>& points, double tolerance) {
  const auto count = static_cast<std::uint32_t>(points.size());
  const auto furthest = [&](std::uint32_t first, std::uint32_t last, const auto& away) {
    std::pair<double, std::uint32_t> best{-1, first};
    for (std::uint32_t i = first + 1; i < last; ++i)
      best = std::max(best, {away(points[i % count]), i});
    return best;
  };
  const auto from_start = [&](Vec2 p) { return distance(p, points[0]); };
  const std::uint32_t opposite = furthest(0, count, from_start).second;
  std::vector<std::uint32_t> kept = {0, opposite};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack = {{0, opposite}, {opposite, count}};
  std::pair<double, std::uint32_t> aside{-1, 0};  // the furthest of the points that were left out
  while (!stack.empty()) {
    const auto [first, last] = stack.back();
    stack.pop_back();
    const Vec2 a = points[first], along = points[last % count] - a;
    const auto away = [&](Vec2 p) {
      const double t = std::clamp(dot(p - a, along) / squared_norm(along), 0.0, 1.0);
      return distance(p, a + t * along);
    };
    const auto [far, i] = furthest(first, last, away);
    if (far <= tolerance) {
      aside = std::max(aside, {far, i});
      continue;
    }
    kept.push_back(i);
    stack.push_back({first, i});
    stack.push_back({i, last});
  }
  if (kept.size() < 3) kept.push_back(aside.second);
  std::sort(kept.begin(), kept.end());
  return kept;
}

struct Polygon {
  Region region;
  Shape shape;
};

/// The polygon within `tolerance` of a region's boundary; none if it crosses itself.
std::optional<Polygon> approximation(const Region& region, double tolerance) {
  Region result;
  std::vector<Ring> rings;
  for (const Region::PieceLoop& loop : region.loops) {
    std::vector<Vec2> points;
    for (std::uint32_t i = loop.begin; i < loop.end; ++i) points.push_back(region.pieces[i].start);
    const std::vector<std::uint32_t> kept = kept_points(points, tolerance);
    Region::PieceLoop range = loop;
    range.begin = static_cast<std::uint32_t>(result.pieces.size());
    Ring& ring = rings.emplace_back();
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const Vec2 before = points[kept[(k + kept.size() - 1) % kept.size()]];
      const Vec2 here = points[kept[k]], next = points[kept[(k + 1) % kept.size()]];
      (cross(here - before, next - here) > 0 ? result.corners : result.reflex)
          .push_back(static_cast<std::uint32_t>(result.pieces.size()));
      result.pieces.push_back({here, next, region.pieces[loop.begin + kept[k]].site});
      ring.points.push_back(here);
    }
    range.end = static_cast<std::uint32_t>(result.pieces.size());
    result.loops.push_back(range);
  }
  auto shape = build_shape(rings);
  if (!shape || shape->component_count() != 1 || shape->loop_count() != region.loops.size())
    return std::nullopt;
  result.size = region.size;
  return Polygon{std::move(result), std::move(*shape)};
}

/// The skeleton by force lines, or in the limit of high orders; none if neither finds one.
std::optional<Skeleton> first_skeleton(const Polygon& polygon, const Charges& charges,
                                       const SkeletonOptions& options) {
  std::vector<Skeleton> limits;
  bool is_asked_for = false;
  SkeletonOptions own = options;
  own.axis = [&]() -> const Skeleton* {
    if (!std::exchange(is_asked_for, true))
      if (const auto exact = compute(polygon.shape, {.cancel = options.cancel}))
        limits = limits_of(*exact, {&polygon.region, 1}, LocalFrame{},
                           options.step / polygon.region.size);
    return limits.empty() ? nullptr : &limits.front();
  };
  if (options.order <= line_order) {
    Skeleton traced = trace_valleys(polygon.region, charges, own);
    if (traced.whole) return traced;
  }
  if (own.axis() == nullptr) return std::nullopt;
  Skeleton limit = std::move(limits.front());
  if (options.order >= limit_order) return limit;
  SuccessorOptions search;
  search.order = options.order;
  search.step = 0.25 * options.step;
  search.accuracy = options.step / 64;
  return descended(std::move(limit), charges, search);
}

/// Moves a skeleton to the valleys of another boundary. Removes points outside of it, and attaches
/// their links to the next point downward.
void move_to(const Region& region, const Charges& charges, double step, Skeleton& skeleton) {
  SuccessorOptions search;
  search.order = skeleton.order;
  search.step = 0.25 * step;
  search.accuracy = step / 64;
  const std::size_t count = skeleton.points.size();
  std::vector<std::uint32_t> instead(count);
  for (std::uint32_t i = 0; i < count; ++i) instead[i] = i;
  parallel_ranges(count, 16, [&](std::size_t i, std::size_t end) {
    Evaluator evaluator(charges);
    for (; i < end; ++i) {
      ValleyPoint& point = skeleton.points[i];
      if (point.kind == ValleyPoint::Kind::corner) continue;
      if (!encloses(region, point.place)) {
        instead[i] = static_cast<std::uint32_t>(count);
        continue;
      }
      point.radius = evaluator.place(point.place).distance;
      const Vec2 moved = point.kind == ValleyPoint::Kind::junction ? point.place
                         : point.kind == ValleyPoint::Kind::minimum
                             ? minimum_near(evaluator, point, search)
                             : successor(evaluator, point, search.order, search);
      if (encloses(region, moved)) point.place = moved;
      point.radius = evaluator.place(point.place).distance;
    }
  });
  const std::vector<bool> outside = [&] {
    std::vector<bool> flags(count);
    for (std::size_t i = 0; i < count; ++i) flags[i] = instead[i] == count;
    return flags;
  }();
  for (const auto& [from, to] : skeleton.links)
    if (outside[from]) instead[from] = to;
  const auto settled = [&](std::uint32_t i) {
    for (std::size_t k = 0; k < count && i < count && outside[i]; ++k) i = instead[i];
    return i;
  };
  std::vector<std::uint32_t> number(count, static_cast<std::uint32_t>(count));
  std::vector<ValleyPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    if (outside[i]) continue;
    number[i] = static_cast<std::uint32_t>(points.size());
    points.push_back(skeleton.points[i]);
  }
  std::vector<std::array<std::uint32_t, 2>> links;
  for (const auto& [from, to] : skeleton.links) {
    const std::uint32_t a = settled(from), b = settled(to);
    if (a < count && b < count && a != b && number[a] < count && number[b] < count)
      links.push_back({number[a], number[b]});
  }
  skeleton.points = std::move(points);
  skeleton.links = std::move(links);
}

}  // namespace

std::optional<Skeleton> trace_coarse_to_fine(const Region& region, const Charges& charges,
                                             const SkeletonOptions& options, double coarse) {
  // Below this distance, a polygon's valleys equal the boundary's up to the accuracy of a search.
  const double least = options.step / 64;
  std::optional<Skeleton> skeleton;
  for (double tolerance = coarse; tolerance > least; tolerance /= 2) {
    const std::optional<Polygon> polygon = approximation(region, tolerance);
    if (!polygon) continue;
    const Charges charged(polygon->region.pieces);
    if (skeleton)
      move_to(polygon->region, charged, options.step, *skeleton);
    else
      skeleton = first_skeleton(*polygon, charged, options);
  }
  if (skeleton) move_to(region, charges, options.step, *skeleton);
  return skeleton;
}

}  // namespace medial::potential
