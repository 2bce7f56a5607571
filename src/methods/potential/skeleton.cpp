#include "methods/potential/skeleton.h"

#include <algorithm>
#include <cmath>

#include "methods/potential/force_lines.h"
#include "methods/potential/saddles.h"
#include "methods/potential/successor.h"

namespace medial::potential {
namespace {

/// The number of forces that the lines may use: about a second for a boundary of 2,000 edges. Mazes
/// take 35 per edge; above that size each force is a sum over more edges.
std::uint64_t forces_of(const Region& region) {
  const auto edges = std::uint64_t{region.edges()};
  return 20000 + 10 * edges + 50 * std::min<std::uint64_t>(edges, 2000) +
         200 * std::uint64_t{region.holes()};
}

/// Drops minima with one line that have a junction within two steps: they come from lines that met
/// the same valley at two places. The rest stays connected and keeps its cycles.
void drop_hooks(Skeleton& skeleton, double step) {
  constexpr double reach = 2;
  const std::size_t count = skeleton.points.size();
  std::vector<std::vector<std::uint32_t>> links(count);
  for (std::uint32_t i = 0; i < skeleton.links.size(); ++i)
    for (const std::uint32_t end : skeleton.links[i]) links[end].push_back(i);
  std::vector<bool> point_goes(count), link_goes(skeleton.links.size());
  const auto degree = [&](std::uint32_t i) {
    return std::count_if(links[i].begin(), links[i].end(),
                         [&](std::uint32_t link) { return !link_goes[link]; });
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    const ValleyPoint& tip = skeleton.points[i];
    if (tip.kind != ValleyPoint::Kind::minimum || degree(i) != 1) continue;
    std::vector<std::uint32_t> way, walked;
    std::uint32_t here = i;
    while (degree(here) == (here == i ? 1 : 2) &&
           distance(skeleton.points[here].place, tip.place) <= reach * std::min(step, tip.radius)) {
      walked.push_back(here);
      const auto next = std::find_if(links[here].begin(), links[here].end(), [&](auto link) {
        return !link_goes[link] && (way.empty() || link != way.back());
      });
      way.push_back(*next);
      const auto [from, to] = skeleton.links[*next];
      here = from == here ? to : from;
    }
    if (degree(here) < 3) continue;
    for (const std::uint32_t link : way) link_goes[link] = true;
    for (const std::uint32_t point : walked) point_goes[point] = true;
  }
  std::vector<std::uint32_t> number(count);
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (point_goes[i]) continue;
    skeleton.points[kept] = skeleton.points[i];
    number[i] = kept++;
  }
  skeleton.points.resize(kept);
  std::size_t left = 0;
  for (std::size_t i = 0; i < link_goes.size(); ++i)
    if (!link_goes[i])
      skeleton.links[left++] = {number[skeleton.links[i][0]], number[skeleton.links[i][1]]};
  skeleton.links.resize(left);
}

class Tracer {
 public:
  Tracer(const Region& region, const Charges& charges, const SkeletonOptions& options)
      : region_(region),
        charges_(charges),
        options_(options),
        graph_(options.step),
        lines_(charges, options_, graph_, forces_of(region)),
        saddles_(region, graph_, lines_) {}

  /// Force lines from all corners and bends.
  void trace_lines() {
    trace_corners();
    trace_bends();
    if (graph_.skeleton.points.empty()) trace_side();
  }

  /// Connects parts along the exact axis, which is computed only if lines leave parts unconnected.
  void connect() {
    if (complete() || lines_.exhausted() || !options_.axis) return;
    if (const Skeleton* axis = options_.axis()) saddles_.connect(*axis);
  }
  void traverse() {
    saddles_.traverse();
    saddles_.pass_necks(charges_);
    saddles_.traverse();
  }

  bool complete() const { return saddles_.complete(); }

  Skeleton take() {
    graph_.skeleton.order = options_.order;
    graph_.skeleton.work = lines_.work();
    graph_.skeleton.whole = complete();
    drop_hooks(graph_.skeleton, options_.step);
    return std::move(graph_.skeleton);
  }

 private:
  /// The first point inside a convex corner: on its bisector, where both its edges are still
  /// nearest.
  bool corner_start(std::uint32_t piece, Vec2& p, Vec2& direction) {
    const Charge& after = region_.pieces[piece];
    const Charge& before = region_.pieces[region_.before(piece)];
    const Vec2 out = unit(after.end - after.start), in = unit(before.start - before.end);
    direction = unit(out + in);
    if (norm(out + in) < 1e-6) direction = left_of(out);
    const double half_sine = std::abs(cross(direction, out));
    double s = std::min({0.5 * distance(after.start, after.end),
                         0.5 * distance(before.start, before.end), options_.step});
    for (int i = 0; i < 60; ++i, s /= 2) {
      p = after.start + s * direction;
      const double radius = lines_.distance_at(p);
      if (radius >= 0.99 * s * half_sine && radius > 0) return true;
    }
    return false;
  }

  void trace_corners() {
    for (const std::uint32_t piece : region_.corners) {
      const Vec2 corner = region_.pieces[piece].start;
      Vec2 p, direction;
      const bool found = corner_start(piece, p, direction);
      if (!found) continue;
      Trail trail = lines_.follow(p, direction, ForceLines::merge_share);
      double radius = lines_.distance_at(p);
      trail.points.insert(trail.points.begin(), {p, radius, direction, ValleyPoint::Kind::valley});
      const std::uint32_t leaf = graph_.add_point({corner, 0, {}, ValleyPoint::Kind::corner});
      lines_.keep(leaf, trail);
    }
  }

  /// A line from the middle of the first piece.
  void trace_side() {
    const Charge& side = region_.pieces.front();
    const Vec2 foot = midpoint(side.start, side.end);
    const Vec2 inward = unit(left_of(side.end - side.start));
    double height = std::min(0.1 * options_.step, 0.1 * distance(side.start, side.end));
    while (height > 0 && lines_.distance_at(foot + height * inward) < 0.999 * height) height /= 2;
    lines_.follow(foot + height * inward, inward, 0.1);
  }

  /// Decides by the side of the nearest piece.
  bool is_inside(Vec2 p) const {
    const Charge& piece = region_.pieces[charges_.nearest(p).piece];
    return cross(piece.end - piece.start, p - piece.start) > 0;
  }

  void trace_bends() {
    for (const auto& [circle, turn] : region_.bends) {
      if (turn < options_.least_turn) continue;
      const auto& [center, bend] = circle;
      double radius = 0;
      const Force force = lines_.force_at(center, radius);
      // Only the centre of a maximal disk is a leaf; chords are slightly nearer than their arc.
      if (!(radius > 0.99 * bend - region_.chord && is_inside(center))) continue;
      const Trail trail = lines_.follow(center, unit(force.force), ForceLines::merge_share);
      const std::uint32_t leaf =
          graph_.add_point({center, radius, unit(force.force), ValleyPoint::Kind::valley});
      lines_.keep(leaf, trail);
    }
  }

  const Region& region_;
  const Charges& charges_;
  const SkeletonOptions options_;
  ValleyGraph graph_;
  ForceLines lines_;
  SaddleSearch saddles_;
};

}  // namespace

Skeleton trace_valleys(const Region& region, const Charges& charges,
                       const SkeletonOptions& options) {
  SkeletonOptions own = options;
  own.bend = region.bend;
  Tracer tracer(region, charges, own);
  tracer.trace_lines();
  tracer.traverse();
  tracer.connect();
  return tracer.take();
}

}  // namespace medial::potential
