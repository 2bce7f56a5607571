#include "methods/potential/potential.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "axis/node_kinds.h"
#include "axis/sites.h"
#include "base/disjoint_sets.h"
#include "base/stopwatch.h"
#include "base/threads.h"
#include "methods/potential/charges.h"
#include "methods/potential/coarse_to_fine.h"
#include "methods/potential/region.h"
#include "methods/potential/skeleton.h"
#include "methods/potential/successor.h"
#include "site/site.h"

namespace medial::potential {
namespace {

/// Which sites the pieces of a region are, by the numbers of the result.
class SiteNames {
 public:
  SiteNames(const Shape& shape, const site::SiteNumbers& numbers)
      : shape_(shape), numbers_(numbers) {}

  /// The site that is nearest to p, of which `piece` is known to be the nearest charge.
  std::uint32_t nearest(const Charge& piece, Vec2 p) const {
    const Vec2 along = piece.end - piece.start;
    const double t = dot(p - piece.start, along) / squared_norm(along);
    const std::uint32_t edge = piece.site;
    if (t <= 0 && numbers_.is_site(edge) && piece.first) return numbers_.edge[edge] - 1;
    if (t >= 1 && piece.last) {
      const std::uint32_t next = next_of(edge);
      if (numbers_.is_site(next)) return numbers_.edge[next] - 1;
    }
    return numbers_.edge[edge];
  }

 private:
  std::uint32_t next_of(std::uint32_t point) const {
    const auto loop = std::upper_bound(shape_.loop_begin.begin(), shape_.loop_begin.end(), point);
    return point + 1 == *loop ? *(loop - 1) : point + 1;
  }
  const Shape& shape_;
  const site::SiteNumbers& numbers_;
};

/// The order of the force lines, by default: valleys of lower ones join where branches
/// of nearly flat corners are not near the axis.
constexpr double usual_order = 512;

/// The same where a part is asked for: valleys are followed upward then, which takes a force that
/// can be distinguished from none.
constexpr double partial_order = 4;

/// Between valley points whose successors lie further apart than this many steps, others are put.
constexpr double widest_gap = 1.5;
constexpr int most_halvings = 3;

/// The points with the minima where those of the final order are, and what is near them moved
/// along, the less the further it is: a branch must not overshoot its end.
std::vector<ValleyPoint> shifted(const Skeleton& skeleton, const Charges& charges,
                                 const SuccessorOptions& options) {
  std::vector<ValleyPoint> points = skeleton.points;
  std::vector<std::vector<std::uint32_t>> neighbors(points.size());
  for (const auto& [from, to] : skeleton.links) {
    neighbors[from].push_back(to);
    neighbors[to].push_back(from);
  }
  Evaluator evaluator(charges);
  constexpr double reach = 4;  // of the shift, in lengths of it
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (skeleton.points[i].kind != ValleyPoint::Kind::minimum) continue;
    const Vec2 place = skeleton.points[i].place;
    const Vec2 shift = minimum_near(evaluator, skeleton.points[i], options) - place;
    const double size = norm(shift);
    if (!(size > 0)) continue;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> queue = {{i, i}};  // and from where
    for (std::size_t k = 0; k < queue.size(); ++k) {
      const auto [here, before] = queue[k];
      const double away = distance(skeleton.points[here].place, place);
      if (skeleton.points[here].kind == ValleyPoint::Kind::corner || away >= reach * size) continue;
      points[here].place = skeleton.points[here].place + (1 - away / (reach * size)) * shift;
      for (const std::uint32_t next : neighbors[here])
        if (next != before && queue.size() < 1000) queue.emplace_back(next, here);
    }
  }
  return points;
}

/// The successors of all points, and of further ones between them where they part.
struct Refined {
  std::vector<Successor> points;
  std::vector<std::array<std::uint32_t, 2>> links;
};

Refined successors_of(const Skeleton& skeleton, const Charges& charges,
                      const SuccessorOptions& options) {
  Refined result;
  result.points.resize(skeleton.points.size());
  const std::vector<ValleyPoint> points = shifted(skeleton, charges, options);
  constexpr std::size_t grain = 16;
  parallel_ranges(skeleton.points.size(), grain, [&](std::size_t i, std::size_t end) {
    Evaluator evaluator(charges);
    for (; i < end; ++i) result.points[i] = generalized_successor(evaluator, points[i], options);
  });
  std::vector<std::vector<Successor>> between(skeleton.links.size());
  parallel_ranges(skeleton.links.size(), grain, [&](std::size_t i, std::size_t end) {
    Evaluator evaluator(charges);
    for (; i < end; ++i) {
      const auto [from, to] = skeleton.links[i];
      const auto halve = [&](const auto& self, const ValleyPoint& a, const Successor& at_a,
                             const ValleyPoint& b, const Successor& at_b, int depth) -> void {
        if (depth == 0 || distance(at_a.place, at_b.place) <= widest_gap * options.step) return;
        ValleyPoint middle = a.kind == ValleyPoint::Kind::corner ? b : a;
        middle.kind = ValleyPoint::Kind::valley;
        middle.place = midpoint(a.place, b.place);
        const Vec2 along = b.place - a.place;
        if (norm(along) > 0) middle.tangent = (1 / norm(along)) * along;
        middle.radius = evaluator.place(middle.place).distance;
        const Successor found = generalized_successor(evaluator, middle, options);
        self(self, a, at_a, middle, found, depth - 1);
        between[i].push_back(found);
        self(self, middle, found, b, at_b, depth - 1);
      };
      halve(halve, points[from], result.points[from], points[to], result.points[to], most_halvings);
    }
  });
  for (std::size_t i = 0; i < skeleton.links.size(); ++i) {
    std::uint32_t last = skeleton.links[i][0];
    for (const Successor& point : between[i]) {
      const auto index = static_cast<std::uint32_t>(result.points.size());
      result.points.push_back(point);
      result.links.push_back({last, index});
      last = index;
    }
    result.links.push_back({last, skeleton.links[i][1]});
  }
  return result;
}

/// Makes one of linked points that have come to the same place: a link needs a direction.
void join_equal(Refined& axis) {
  DisjointSets sets(axis.points.size());
  for (const auto& [from, to] : axis.links)
    if (axis.points[from].place == axis.points[to].place) sets.join(from, to);
  std::vector<std::uint32_t> number(axis.points.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    const std::uint32_t first = sets.find(i);  // no higher than i
    number[i] = first == i ? count++ : number[first];
    axis.points[number[i]] = axis.points[i];
  }
  axis.points.resize(count);
  for (auto& link : axis.links) link = {number[link[0]], number[link[1]]};
  std::erase_if(axis.links, [](const auto& link) { return link[0] == link[1]; });
}

/// How the valleys of a region are traced; a seed and a box in the frame's units.
SkeletonOptions tracing_of(const Region& region, const Problem& problem) {
  const auto& own = problem.own<method::Potential>();
  const LocalFrame& frame = problem.frame;
  SkeletonOptions tracing;
  tracing.order = own.base_order > 0 ? own.base_order
                  : own.order > 0    ? std::min(own.order, usual_order)
                                     : usual_order;
  if (!own.whole() && own.base_order == 0) tracing.order = std::min(tracing.order, partial_order);
  tracing.step = own.step * region.size;
  tracing.cancel = problem.options.cancel;
  if (own.from) tracing.from = frame.to_local(*own.from);
  if (own.within)
    tracing.within = Box{frame.to_local(own.within->low), frame.to_local(own.within->high)};
  return tracing;
}

/// The points of the axis: the skeleton's own, where its order is the one asked for.
Refined points_of(const Skeleton& skeleton, const Charges& charges, const Region& region,
                  const SkeletonOptions& tracing, const method::Potential& own) {
  Refined refined;
  if (own.order == skeleton.order) {
    for (const ValleyPoint& point : skeleton.points)
      refined.points.push_back({point.place, point.radius, skeleton.order});
    refined.links = skeleton.links;
  } else {
    SuccessorOptions search;
    search.order = own.order;
    search.angle = own.angle * std::numbers::pi / 180;
    search.movement = own.movement * region.size;
    // Points on a valley of some order are no worse than that.
    search.least_order = skeleton.order;
    search.step = tracing.step;
    search.accuracy = tracing.step / 64;
    refined = successors_of(skeleton, charges, search);
  }
  join_equal(refined);
  return refined;
}

/// The two sites that a link passes between, on its left first: what is nearest halfway to the
/// border, at right angles to it. Where a link that is shorter than the accuracy of its ends points
/// at the border, that is one site; then what lies across from it is the other.
std::array<std::uint32_t, 2> sites_beside(const Successor& inner, Vec2 along, const Region& region,
                                          const Charges& charges, const SiteNames& names) {
  const auto nearest = [&](Vec2 p) {
    return names.nearest(region.pieces[charges.nearest(p).piece], p);
  };
  const double length = norm(along);
  const Vec2 aside = length > 0 ? (0.5 * inner.radius / length) * left_of(along) : Vec2{};
  const std::array touched{nearest(inner.place + aside), nearest(inner.place - aside)};
  if (touched[0] != touched[1]) return touched;
  const Charge& piece = region.pieces[charges.nearest(inner.place).piece];
  const Vec2 foot = site::foot(site::make_segment(piece.start, piece.end), inner.place);
  const std::uint32_t across = nearest(inner.place - 0.5 * (foot - inner.place));
  const bool is_left = cross(along, foot - inner.place) > 0;
  return is_left ? std::array{touched[0], across} : std::array{across, touched[0]};
}

/// Makes the points of one component nodes of the axis, and their links edges between the nearest
/// charges on both sides.
void append(MedialAxis& axis, std::uint32_t component, const Refined& refined, const Region& region,
            const Charges& charges, const SiteNames& names, const LocalFrame& frame) {
  const auto base = static_cast<std::uint32_t>(axis.nodes.size());
  for (const Successor& point : refined.points)
    axis.nodes.push_back({{frame.to_input(point.place), point.radius * frame.inverse},
                          component,
                          NodeKind::site_change});
  for (const auto& [from, to] : refined.links) {
    const Successor &a = refined.points[from], &b = refined.points[to];
    const Successor& inner = a.radius > 0 ? a : b;
    const auto touched = sites_beside(inner, b.place - a.place, region, charges, names);
    const Disk &first = axis.nodes[base + from].disk, &last = axis.nodes[base + to].disk;
    const Disk middle{midpoint(first.center, last.center), 0.5 * (first.radius + last.radius)};
    axis.edges.push_back({{base + from, base + to}, touched, middle, 1});
  }
}

}  // namespace

std::optional<Error> refuse(const Problem& problem) {
  const method::Potential& options = problem.own<method::Potential>();
  const auto invalid = [](const char* text) { return Error{ErrorCode::invalid_option, text, {}}; };
  const auto is_order = [](double n) { return n >= 1 && n <= largest_order; };
  if (!(options.order == 0 || is_order(options.order)) ||
      !(options.base_order == 0 || is_order(options.base_order)))
    return invalid("the order of the potential must be in [1, 4096]");
  if (!(options.step >= 1e-4 && options.step <= 0.1))
    return invalid("the step must be in [1e-4, 0.1]");
  if (!(options.coarse >= 0 && options.coarse <= 0.2))
    return invalid("the coarse polygon's distance must be in [0, 0.2]");
  if (!(options.angle > 0 && options.angle <= 90))
    return invalid("the angle must be in (0, 90] degrees");
  if (!(options.movement > 0 && options.movement <= 0.1))
    return invalid("the movement must be in (0, 0.1]");
  return std::nullopt;
}

Result<MedialAxis> run(const Problem& problem) {
  Stopwatch watch;
  const Options& options = problem.options;
  const LocalFrame& frame = problem.frame;
  const auto& own = problem.own<method::Potential>();
  MedialAxis axis;
  axis.method = "potential";
  axis.tolerance = problem.tolerance;
  axis.sites = problem.result_sites();
  const SiteNames names(problem.shape, problem.numbers());
  axis.statistics.seconds_sites = watch.lap();

  // Arcs become chords within a hundredth of a step.
  const Vec2 extent = problem.box.high - problem.box.low;
  const double whole = std::max(extent.x, extent.y);
  const std::vector<Region> regions = regions_of(problem, 0.01 * own.step * whole * frame.scale);
  bool seeded = !own.from;
  for (std::uint32_t component = 0; component < regions.size(); ++component) {
    const Region& region = regions[component];
    const Charges charges(region.pieces);
    axis.statistics.seconds_tree += watch.lap();
    const SkeletonOptions tracing = tracing_of(region, problem);
    if (tracing.from && !encloses(region, *tracing.from)) continue;
    seeded = true;
    axis.resolution = std::max(axis.resolution, tracing.step * frame.inverse);
    const Skeleton skeleton =
        own.coarse > 0 && own.whole()
            ? trace_coarse_to_fine(region, charges, tracing, own.coarse * region.size)
            : trace_valleys(region, charges, tracing);
    axis.statistics.queries += skeleton.forces;
    axis.statistics.seconds_walk += watch.lap();
    if (problem.is_cancelled()) break;
    if (!skeleton.whole)
      return Error{ErrorCode::unsupported,
                   "the potential's valleys are too flat to be connected: use the method disks",
                   {}};
    append(axis, component, points_of(skeleton, charges, region, tracing, own), region, charges,
           names, frame);
    axis.statistics.seconds_collect += watch.lap();
    if (problem.is_cancelled()) break;
    if (options.progress) options.progress((component + 1.0) / static_cast<double>(regions.size()));
  }
  if (!seeded) return Error{ErrorCode::invalid_option, "the seed lies outside of the shape", {}};
  set_node_kinds(axis);
  return axis;
}

}  // namespace medial::potential
