#include "methods/potential/potential.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "axis/node_kinds.h"
#include "axis/sites.h"
#include "base/disjoint_sets.h"
#include "base/stopwatch.h"
#include "base/threads.h"
#include "medial/compute.h"
#include "medial/verify.h"
#include "methods/potential/charges.h"
#include "methods/potential/coarse_to_fine.h"
#include "methods/potential/force_lines.h"
#include "methods/potential/limit.h"
#include "methods/potential/region.h"
#include "methods/potential/skeleton.h"
#include "methods/potential/successor.h"
#include "site/site.h"

namespace medial::potential {
namespace {

/// Maps the pieces of a region to the numbers of their sites in the result.
class SiteNames {
 public:
  SiteNames(const Shape& shape, const site::SiteNumbers& numbers)
      : shape_(shape), numbers_(numbers) {}

  /// The site nearest to p, given the nearest charge `piece`.
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

  /// The site with the nearest charge to p, except `own`: at the end of a slit, two sites almost
  /// coincide. O(n).
  std::uint32_t other(const Region& region, Vec2 p, std::uint32_t own) const {
    std::pair<double, std::uint32_t> best{std::numeric_limits<double>::infinity(), own};
    for (const Charge& piece : region.pieces) {
      const site::Site segment = site::make_segment(piece.start, piece.end);
      const std::uint32_t site = numbers_.edge[piece.site];
      if (site != own) best = std::min(best, {distance(p, site::foot(segment, p)), site});
    }
    return best.second;
  }

 private:
  std::uint32_t next_of(std::uint32_t point) const {
    const auto loop = std::upper_bound(shape_.loop_begin.begin(), shape_.loop_begin.end(), point);
    return point + 1 == *loop ? *(loop - 1) : point + 1;
  }
  const Shape& shape_;
  const site::SiteNumbers& numbers_;
};

/// Points are inserted between valley points whose successors are further apart than this many
/// steps.
constexpr double widest_gap = 1.5;
constexpr int most_halvings = 3;

/// The points, with minima moved to the minima of the final order. Points near a minimum move with
/// it, less with increasing distance, so that a branch does not overshoot its end.
std::vector<ValleyPoint> shifted(const Skeleton& skeleton, const Charges& charges,
                                 const SuccessorOptions& options) {
  std::vector<ValleyPoint> points = skeleton.points;
  std::vector<std::vector<std::uint32_t>> neighbors(points.size());
  for (const auto& [from, to] : skeleton.links) {
    neighbors[from].push_back(to);
    neighbors[to].push_back(from);
  }
  Evaluator evaluator(charges);
  constexpr double reach = 4;  // in multiples of the shift
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (skeleton.points[i].kind != ValleyPoint::Kind::minimum) continue;
    const Vec2 place = skeleton.points[i].place;
    const Vec2 shift = minimum_near(evaluator, skeleton.points[i], options) - place;
    const double size = norm(shift);
    if (!(size > 0)) continue;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> queue = {
        {i, i}};  // a point, and the point before it
    for (std::size_t k = 0; k < queue.size(); ++k) {
      const auto [here, before] = queue[k];
      const double away = distance(skeleton.points[here].place, place);
      if (is_fixed(skeleton.points[here]) || away >= reach * size) continue;
      points[here].place = skeleton.points[here].place + (1 - away / (reach * size)) * shift;
      for (const std::uint32_t next : neighbors[here])
        if (next != before && queue.size() < 1000) queue.emplace_back(next, here);
    }
  }
  return points;
}

/// The junction where the valleys through two points meet, if it is no further from either point
/// than they are apart. Points on a line that joined another valley too early cut off its corner.
std::optional<Successor> junction_between(Evaluator& evaluator, const Successor& a,
                                          const Successor& b) {
  constexpr double broad = 64;  // an order whose valleys are wider than the error of points
  const auto valley_at = [&](const Successor& point) {
    evaluator.place(point.place);
    return valley_direction(evaluator.force(broad), broad);
  };
  if (!(a.radius > 0 && b.radius > 0)) return std::nullopt;
  const Vec2 along_a = valley_at(a), along_b = valley_at(b), between = b.place - a.place;
  const double sine = cross(along_a, along_b), gap = norm(between);
  const double t = cross(between, along_b) / sine, u = cross(between, along_a) / sine;
  if (!(std::max(std::abs(t), std::abs(u)) <= 1.5 * gap)) return std::nullopt;
  const Vec2 place = a.place + t * along_a;
  const double radius = evaluator.place(place).distance;
  const bool is_inside = std::abs(radius - a.radius) <= 2 * gap;
  return is_inside ? std::optional<Successor>({place, radius, a.order}) : std::nullopt;
}

/// The successors of all points, and of points that are inserted where they diverge.
struct Refined {
  std::vector<Successor> points;
  std::vector<std::array<std::uint32_t, 2>> links;
};

/// None if the cost exceeds `most_work`.
std::optional<Refined> successors_of(const Skeleton& skeleton, const Charges& charges,
                                     const SuccessorOptions& options, std::uint64_t most_work) {
  Refined result;
  std::atomic<std::uint64_t> work = 0;
  // Checks the work of all threads between batches, so that the result does not depend on their
  // number.
  const auto in_batches = [&](std::size_t count, const auto& act) {
    constexpr std::size_t batch = 512, grain = 16;
    for (std::size_t begin = 0; begin < count && work <= most_work; begin += batch)
      parallel_ranges(std::min(batch, count - begin), grain, [&](std::size_t i, std::size_t end) {
        Evaluator evaluator(charges);
        for (; i < end; ++i) act(evaluator, begin + i);
        work += evaluator.work();
      });
  };
  result.points.resize(skeleton.points.size());
  const std::vector<ValleyPoint> points = shifted(skeleton, charges, options);
  in_batches(skeleton.points.size(), [&](Evaluator& evaluator, std::size_t i) {
    result.points[i] = generalized_successor(evaluator, points[i], options);
  });
  std::vector<std::vector<Successor>> between(skeleton.links.size());
  in_batches(skeleton.links.size(), [&](Evaluator& evaluator, std::size_t i) {
    const auto [from, to] = skeleton.links[i];
    const auto halve = [&](const auto& self, const ValleyPoint& a, const Successor& at_a,
                           const ValleyPoint& b, const Successor& at_b, int depth) -> void {
      if (distance(at_a.place, at_b.place) <= widest_gap * options.step) return;
      if (depth == 0) {
        const auto junction = junction_between(evaluator, at_a, at_b);
        if (junction) between[i].push_back(*junction);
        return;
      }
      ValleyPoint middle = is_fixed(a) ? b : a;
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
  });
  if (work > most_work) return std::nullopt;
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

/// Merges linked points that have come to the same place, since a link needs a direction.
Refined joined(Refined axis) {
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
  return axis;
}

/// The points of a skeleton as they are.
Refined unmoved(const Skeleton& skeleton) {
  Refined refined;
  for (const ValleyPoint& point : skeleton.points)
    refined.points.push_back({point.place, point.radius, skeleton.order});
  refined.links = skeleton.links;
  return refined;
}

/// The two sites between which a link passes, the left one first: the nearest sites at the points
/// halfway to the boundary, perpendicular to the link. If a link is shorter than the error of its
/// ends and points at the boundary, both are the same site; then the other one is the site across
/// from it.
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
  std::uint32_t across = nearest(inner.place - 0.5 * (foot - inner.place));
  if (across == touched[0]) across = names.other(region, inner.place, across);
  const bool is_left = cross(along, foot - inner.place) > 0;
  return is_left ? std::array{touched[0], across} : std::array{across, touched[0]};
}

/// For an axis close to the medial axis, lines are used up to this many edges. Above, they take
/// seconds, as each of their forces is a sum over more edges.
constexpr std::size_t most_lined = 2000;

/// The largest cost of the forces for such lines, and for moving their points, per shape: about 0.6
/// seconds. The rest then starts on the exact axis.
constexpr std::uint64_t most_work = 18'000'000;
constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// How the points of an axis are found. If verify() refuses the result, the next way is used.
enum class Way : std::uint8_t {
  lines,   ///< by force lines, or from coarse to fine
  limit,   ///< from the limit of high orders
  unmoved  ///< that limit, without moving its points
};

class Tracing {
 public:
  explicit Tracing(const Problem& problem)
      : problem_(problem),
        own_(problem.own<method::Potential>()),
        names_(problem.shape, problem.numbers()) {
    // Arcs become chords within a hundredth of a step.
    const Vec2 extent = problem.box.high - problem.box.low;
    const double whole = std::max(extent.x, extent.y) * problem.frame.scale;
    regions_ = regions_of(problem, 0.01 * own_.step * whole);
  }

  Result<MedialAxis> run(Way way) {
    MedialAxis axis;
    axis.method = "potential";
    axis.tolerance = problem_.tolerance;
    axis.sites = problem_.result_sites();
    bool seeded = !own_.from;
    for (std::uint32_t component = 0; component < regions_.size(); ++component) {
      const Region& region = regions_[component];
      if (own_.from && !encloses(region, problem_.frame.to_local(*own_.from))) continue;
      seeded = true;
      axis.resolution = std::max(axis.resolution, own_.step * region.size * problem_.frame.inverse);
      const Charges charges(region.pieces);
      const auto points = points_of(way, component, charges, axis.statistics);
      if (!points) return points.error();
      append(axis, component, *points, charges);
      if (problem_.is_cancelled()) return axis;
      if (problem_.options.progress)
        problem_.options.progress((component + 1.0) / static_cast<double>(regions_.size()));
    }
    if (!seeded) return refused("the place to start from lies outside the shape");
    if (own_.within && axis.edges.empty()) return refused("none of the axis lies in the box");
    set_node_kinds(axis);
    return axis;
  }

 private:
  static Error refused(const char* text) { return {ErrorCode::invalid_option, text, {}}; }

  Result<Refined> points_of(Way way, std::uint32_t component, const Charges& charges,
                            Statistics& statistics) {
    const Region& region = regions_[component];
    if (way == Way::lines) {
      const std::optional<Skeleton> skeleton = traced(component, charges);
      if (skeleton) {
        std::optional<Refined> points =
            own_.order == skeleton->order
                ? unmoved(*skeleton)
                : successors_of(*skeleton, charges, search(region, *skeleton), work_left_);
        if (points) {
          statistics.queries += skeleton->forces;
          return joined(std::move(*points));
        }
      }
    }
    if (const auto error = find_limits()) return *error;
    const Skeleton limit = wanted(component, charges);
    if (way == Way::unmoved) return joined(unmoved(limit));
    if (own_.order > 0 && own_.order < limit_order)
      return joined(unmoved(descended(limit, charges, search(region, limit))));
    return joined(*successors_of(limit, charges, search(region, limit), unlimited));
  }

  /// Computes the exact axis once; remembers if there is none.
  std::optional<Error> find_limits() {
    if (!limits_.empty() || no_limits_) return no_limits_;
    const Options& options = problem_.options;
    const auto exact = compute(problem_.shape, {.corner_angle = options.corner_angle,
                                                .threads = options.threads,
                                                .cancel = options.cancel});
    if (exact)
      limits_ = limits_of(*exact, regions_, problem_.frame, own_.step);
    else
      no_limits_ = exact.error();
    return no_limits_;
  }

  /// The order of the first force lines.
  double lines_order() const {
    if (own_.base_order > 0) return own_.base_order;
    return own_.order > 0 ? std::min(own_.order, line_order) : line_order;
  }

  /// By force lines, or from coarse to fine; none if the result is not connected. Between parallel
  /// sides, low orders have a force where it vanishes for higher ones.
  std::optional<Skeleton> traced(std::uint32_t component, const Charges& charges) {
    const Region& region = regions_[component];
    SkeletonOptions options;
    options.axis = [&] { return find_limits() ? nullptr : &limits_[component]; };
    options.order = lines_order();
    options.step = own_.step * region.size;
    options.cancel = problem_.options.cancel;
    const bool to_the_axis = own_.order == 0 || own_.order > line_order;
    if (to_the_axis) options.least_turn = 0;
    if (own_.coarse > 0)
      return trace_coarse_to_fine(region, charges, options, own_.coarse * region.size);
    if (options.order > line_order) return std::nullopt;
    constexpr double ratio = 4;
    for (; options.order >= 1; options.order = std::floor(options.order / ratio)) {
      if (to_the_axis) options.most_work = work_left_;
      Skeleton skeleton = trace_valleys(region, charges, options);
      if (to_the_axis) work_left_ -= std::min(work_left_, skeleton.work);
      if (skeleton.whole) return skeleton;
      if (!to_the_axis || problem_.is_cancelled()) break;
    }
    return std::nullopt;
  }

  SuccessorOptions search(const Region& region, const Skeleton& skeleton) const {
    SuccessorOptions options;
    options.order = own_.order;
    options.angle = own_.angle * std::numbers::pi / 180;
    options.movement = own_.movement * region.size;
    // Points on a valley of this order are at least as accurate.
    options.least_order = skeleton.order;
    options.step = own_.step * region.size;
    options.accuracy = options.step / 64;
    if (skeleton.order >= limit_order) options.furthest = options.step / 8;
    return options;
  }

  /// The requested part of a whole limit.
  Skeleton wanted(std::uint32_t component, const Charges& charges) const {
    const Skeleton& limit = limits_[component];
    const LocalFrame& frame = problem_.frame;
    if (own_.from)
      return branch_at(limit, charges, frame.to_local(*own_.from), std::max(own_.order, line_order),
                       own_.step * regions_[component].size);
    if (own_.within)
      return part_within(limit,
                         {frame.to_local(own_.within->low), frame.to_local(own_.within->high)});
    return limit;
  }

  /// Adds the points of one component as nodes of the axis, and their links as edges between the
  /// nearest charges on both sides.
  void append(MedialAxis& axis, std::uint32_t component, const Refined& refined,
              const Charges& charges) const {
    const LocalFrame& frame = problem_.frame;
    const auto base = static_cast<std::uint32_t>(axis.nodes.size());
    for (const Successor& point : refined.points)
      axis.nodes.push_back({{frame.to_input(point.place), point.radius * frame.inverse},
                            component,
                            NodeKind::site_change});
    for (const auto& [from, to] : refined.links) {
      const Successor &a = refined.points[from], &b = refined.points[to];
      const auto touched = sites_beside(a.radius > 0 ? a : b, b.place - a.place,
                                        regions_[component], charges, names_);
      const Disk &first = axis.nodes[base + from].disk, &last = axis.nodes[base + to].disk;
      const Disk middle{midpoint(first.center, last.center), 0.5 * (first.radius + last.radius)};
      axis.edges.push_back({{base + from, base + to}, touched, middle, 1});
    }
  }

  const Problem& problem_;
  const method::Potential& own_;
  const SiteNames names_;
  std::vector<Region> regions_;
  std::vector<Skeleton> limits_;  ///< of all components; computed on demand
  std::optional<Error> no_limits_;
  /// for force lines to the axis, unless the caller requested these
  std::uint64_t work_left_ = own_.base_order > 0 || own_.coarse > 0 ? unlimited : most_work;
};

bool follows_lines(const Problem& problem) {
  const auto& own = problem.own<method::Potential>();
  if (!own.whole()) return false;
  if (own.coarse > 0 || (own.order > 0 && own.order <= line_order)) return true;
  return own.base_order == 0 ? problem.shape.points.size() <= most_lined
                             : own.base_order <= line_order;
}

}  // namespace

std::optional<Error> refuse(const Problem& problem) {
  const method::Potential& options = problem.own<method::Potential>();
  const auto invalid = [](const char* text) { return Error{ErrorCode::invalid_option, text, {}}; };
  const auto is_order = [](double n) { return n >= 1 && n <= largest_order; };
  if (!(options.order == 0 || is_order(options.order)) ||
      !(options.base_order == 0 || is_order(options.base_order)))
    return invalid("orders of the potential must be 0 or in [1, 4096]");
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
  const auto& own = problem.own<method::Potential>();
  Stopwatch watch;
  Tracing tracing(problem);
  const double setting_up = watch.lap();
  Certificate certificate;
  for (const Way way : {Way::lines, Way::limit, Way::unmoved}) {
    if (way == Way::lines ? !follows_lines(problem) : own.coarse > 0) continue;
    Result<MedialAxis> axis = tracing.run(way);
    if (!axis) return axis;
    axis->statistics.seconds_sites = setting_up;
    axis->statistics.seconds_walk = watch.lap();
    if (problem.is_cancelled() || !own.whole()) return axis;
    certificate =
        verify(problem.shape, *axis,
               {.corner_angle = problem.options.corner_angle, .threads = problem.options.threads});
    if (certificate.passed) return axis;
  }
  return Error{ErrorCode::unsupported,
               "the potential's valleys make no axis: use another order, or the method disks (" +
                   certificate.failures.front() + ")",
               {}};
}

}  // namespace medial::potential
