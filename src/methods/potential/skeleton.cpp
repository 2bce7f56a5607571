#include "methods/potential/skeleton.h"

#include <algorithm>
#include <cmath>

#include "methods/potential/force_lines.h"
#include "methods/potential/saddles.h"
#include "methods/potential/successor.h"

namespace medial::potential {
namespace {

/// Valleys of higher order are connected as those of this one: still a force between parallel sides
/// some widths long, and few enough minima.
constexpr double connecting_order = 24;

/// Where these do not connect either, the next lower order is this share.
constexpr double lower_order = 0.25;

/// How many forces one order may take, and how often that all orders together: mazes take most of
/// it three times, pixel noise all of it.
std::uint64_t forces_of_an_order(const Region& region) {
  return 30000 + 50 * std::uint64_t{region.edges()} + 1000 * std::uint64_t{region.holes()};
}
constexpr std::uint64_t most_orders = 3;

/// Takes minima with one line away that have a junction within two steps: lines that met the same
/// valley in two places made them. What is left stays connected and keeps its cycles.
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
        lines_(charges, options_, graph_, forces_left(region, options)),
        saddles_(region, graph_, lines_) {}

  /// Force lines from all corners and bends.
  void trace_lines() {
    trace_corners();
    trace_bends();
    if (!graph_.skeleton.points.empty()) return;
    Trail trail;
    saddles_.probe(0, 0.5, trail);
    if (trail.closes == no_point) return;
    // Around a ring of one width, which has no minimum: any point of it stands for one.
    ValleyPoint start = trail.points[trail.closes];
    start.kind = ValleyPoint::Kind::minimum;
    trail.points.erase(trail.points.begin(), trail.points.begin() + trail.closes + 1);
    trail.closes = no_point;
    trail.end = graph_.minimum_at(start);
    lines_.keep(trail.end, trail);
  }

  void connect() { saddles_.connect(corner_labels_); }
  void traverse() {
    saddles_.traverse();
    saddles_.pass_necks(charges_);
    saddles_.traverse();
  }

  /// Connects through places in the valleys where a skeleton of lower order has its saddles.
  void connect_as(const Skeleton& coarse) {
    Evaluator evaluator(charges_);
    SuccessorOptions search;
    search.step = 0.25 * options_.step;
    search.accuracy = 0.01 * options_.step;
    for (ValleyPoint point : coarse.points) {
      if (complete()) return;
      if (point.kind != ValleyPoint::Kind::saddle) continue;
      point.place = successor(evaluator, point, options_.order, search);
      point.radius = evaluator.place(point.place).distance;
      saddles_.pass(point, ForceLines::Start::either);
    }
  }

  void trace_part() {
    if (options_.from) {
      trace_branch(*options_.from);
      return;
    }
    trace_corners();
    trace_bends();
    trace_box(*options_.within);
  }

  bool complete() const { return saddles_.complete(); }
  std::uint64_t forces() const { return graph_.skeleton.forces; }

  Skeleton take() {
    graph_.skeleton.order = options_.order;
    if (!options_.from && !options_.within) drop_hooks(graph_.skeleton, options_.step);
    return std::move(graph_.skeleton);
  }

 private:
  static std::uint64_t forces_left(const Region& region, const SkeletonOptions& options) {
    const std::uint64_t one = forces_of_an_order(region), all = most_orders * one;
    return options.spent < all ? std::min(one, all - options.spent) : 0;
  }

  // ---- Where lines begin.

  bool wanted(Vec2 p) const { return !options_.within || contains(*options_.within, p); }

  /// The first point inside of a convex corner: on its bisector, as far as both its edges are
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
    corner_labels_.resize(region_.corners.size());
    for (std::size_t i = 0; i < region_.corners.size(); ++i) {
      const std::uint32_t piece = region_.corners[i];
      const Vec2 corner = region_.pieces[piece].start;
      if (!wanted(corner)) continue;
      Vec2 p, direction;
      const bool found = corner_start(piece, p, direction);
      if (!found) continue;
      Trail trail = lines_.follow(p, direction, ForceLines::merge_share);
      double radius = lines_.distance_at(p);
      trail.points.insert(trail.points.begin(), {p, radius, direction, ValleyPoint::Kind::valley});
      if (trail.closes != no_point) ++trail.closes;
      const std::uint32_t leaf = graph_.add_point({corner, 0, {}, ValleyPoint::Kind::corner});
      corner_labels_[i] = lines_.keep(leaf, trail);
      graph_.labels[leaf] = corner_labels_[i];
    }
  }

  void trace_bends() {
    for (const auto& [center, bend] : region_.bends) {
      if (!wanted(center)) continue;
      double radius = 0;
      const Force force = lines_.force_at(center, radius);
      // Only the centre of a maximal disk is a leaf; chords are a little nearer than their arc.
      if (!(radius > 0.99 * bend - region_.chord)) continue;
      const Trail trail = lines_.follow(center, unit(force.force), ForceLines::merge_share);
      const std::uint32_t leaf =
          graph_.add_point({center, radius, unit(force.force), ValleyPoint::Kind::valley});
      graph_.labels[leaf] = lines_.keep(leaf, trail);
    }
  }

  // ---- A part only.

  /// Step 1 of the algorithm: from a seed to the floor of a valley, as the force leads. False where
  /// it leads to a minimum without one, or out of the box.
  bool reach_valley(Vec2 p, ValleyPoint& contact) {
    double radius = 0;
    Force force = lines_.force_at(p, radius);
    constexpr int most_steps = 1000;
    for (int i = 0; i < most_steps && radius > 0 && wanted(p); ++i) {
      Vec2 direction = unit(force.force);
      if (lines_.settle(p, radius, force, direction)) {
        contact = {p, radius, direction, ValleyPoint::Kind::valley};
        return true;
      }
      p = p + 0.4 * lines_.reach(radius) * unit(force.force);
      force = lines_.force_at(p, radius);
    }
    return false;
  }

  /// Follows a valley upward, to a corner, to a saddle, out of the box, or to where it ends.
  std::uint32_t climb(std::uint32_t from, Vec2 direction) {
    Vec2 p = graph_.skeleton.points[from].place;
    double radius = graph_.skeleton.points[from].radius, scale = 0.5;
    std::uint32_t last = from;
    constexpr int most_steps = 10000;
    for (int i = 0; i < most_steps && scale > 0.05; ++i) {
      if (options_.within && !contains(*options_.within, p)) break;
      if (radius < 0.02 * options_.step) return link_to_corner(last);
      Vec2 q;
      Force force;
      double next_radius = 0;
      if (!lines_.advance(p, direction, scale * lines_.reach(radius), q, force, next_radius) ||
          dot(unit(q - p), direction) < 0.8) {
        scale /= 2;
        continue;
      }
      direction = unit(q - p);
      if (dot(force.force, direction) > 0) break;
      p = q;
      radius = next_radius;
      scale = std::min(0.5, 1.5 * scale);
      const std::uint32_t known =
          graph_.joined(p, radius, -direction, ForceLines::merge_share, false);
      const std::uint32_t index =
          known != no_point ? known
                            : graph_.add_point({p, radius, -direction, ValleyPoint::Kind::valley});
      graph_.add_link(index, last);
      if (known != no_point) return known;
      last = index;
    }
    return last;
  }

  std::uint32_t link_to_corner(std::uint32_t last) {
    const ValleyPoint& point = graph_.skeleton.points[last];
    for (const std::uint32_t piece : region_.corners) {
      const Vec2 corner = region_.pieces[piece].start;
      if (distance(corner, point.place) > 0.1 * options_.step) continue;
      const std::uint32_t leaf = graph_.add_point({corner, 0, {}, ValleyPoint::Kind::corner});
      graph_.add_link(leaf, last);
      return leaf;
    }
    return last;
  }

  /// Steps 2 and 3: the branch of the skeleton that the force leads to from a seed, both ways.
  void trace_branch(Vec2 seed) {
    ValleyPoint contact;
    if (!reach_valley(seed, contact)) return;
    if (!wanted(contact.place)) return;
    if (graph_.joined(contact.place, contact.radius, contact.tangent, ForceLines::merge_share,
                      false) != no_point)
      return;
    const std::uint32_t first = graph_.add_point(contact);
    climb(first, -contact.tangent);
    lines_.keep(first, lines_.follow(contact.place, contact.tangent, ForceLines::merge_share));
  }

  /// Branches that cross the box without a corner in it, from seeds all over it.
  void trace_box(const Box& box) {
    constexpr int seeds = 8;  // a side
    for (int i = 0; i < seeds; ++i)
      for (int k = 0; k < seeds; ++k) {
        const Vec2 seed{box.low.x + (i + 0.5) / seeds * (box.high.x - box.low.x),
                        box.low.y + (k + 0.5) / seeds * (box.high.y - box.low.y)};
        if (encloses(region_, seed)) trace_branch(seed);
      }
  }

  const Region& region_;
  const Charges& charges_;
  const SkeletonOptions options_;
  ValleyGraph graph_;
  ForceLines lines_;
  SaddleSearch saddles_;
  std::vector<Label> corner_labels_;
};

}  // namespace

Skeleton trace_valleys(const Region& region, const Charges& charges,
                       const SkeletonOptions& options) {
  SkeletonOptions own = options;
  own.through_flats = own.order > connecting_order;
  own.bend = region.bend;
  Tracer tracer(region, charges, own);
  if (own.from || own.within) {
    tracer.trace_part();
    return tracer.take();
  }
  tracer.trace_lines();
  tracer.traverse();
  if (!own.through_flats) tracer.connect();
  if (tracer.complete() || own.order <= 1) {
    const bool whole = tracer.complete();
    Skeleton skeleton = tracer.take();
    skeleton.whole = whole;
    return skeleton;
  }
  own.spent += tracer.forces();
  const bool stopped = own.cancel != nullptr && own.cancel->load();
  if (stopped || own.spent >= most_orders * forces_of_an_order(region)) {
    Skeleton parts = tracer.take();
    parts.whole = false;
    return parts;
  }
  own.order = own.through_flats ? connecting_order : std::max(1.0, lower_order * own.order);
  Skeleton coarse = trace_valleys(region, charges, own);
  if (own.through_flats) {
    tracer.connect_as(coarse);
    tracer.traverse();
    if (tracer.complete()) {
      Skeleton skeleton = tracer.take();
      skeleton.forces += coarse.forces;
      return skeleton;
    }
  }
  coarse.forces += tracer.take().forces;
  return coarse;
}

}  // namespace medial::potential
