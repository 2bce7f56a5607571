#include "engines/biarc_dc/maximal_disk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/tangent_disk.h"

namespace medial::biarc_dc {
namespace {

using geometry::Bisector;
using geometry::Site;

constexpr double nowhere = std::numeric_limits<double>::infinity();

/// Halving an interval of doubles more often than this cannot change it.
constexpr int most_halvings = 128;

/// Arcs of one circle: their curvatures differ by rounding at most.
constexpr double same_curvature = 1e-9;

/// Correcting a disk moves it by no more, against the radius; what is further is another solution.
constexpr double polish_reach = 1e-3;

/// Rounding may put a disk a little behind the one where a bisector begins; what is further behind
/// is another solution. Next to the centre of the arc by whose foot positions are told, a disk's
/// error counts for more, by the radius over the distance from there.
double slack(const Context& context, const Bisector& bisector, const Disk& from) {
  double factor = 4;
  if (bisector.reference != nullptr) {
    const double size = geometry::view_of_arc(*bisector.reference, from.center).size;
    factor *= bisector.reference->is_arc() ? std::abs(bisector.scale) / std::min(1.0, size) : 1.0;
  }
  return factor * context.tolerance + 1e-9 * from.radius;
}

/// Whether a disk reaches over a closed site by more than `slack`.
bool overlaps(const Disk& disk, const Site& site, double slack) {
  const double reach = disk.radius - slack;
  return reach > 0 && geometry::squared_distance(site, disk.center) < reach * reach;
}
bool touches(const Disk& disk, const Site& site, double slack) {
  return std::abs(std::sqrt(geometry::squared_distance(site, disk.center)) - disk.radius) <= slack;
}

/// Brings a disk's residual at three sites below the tolerance: by Newton's method, and where that
/// fails in higher precision.
Disk polished(Context& context, Disk disk, const Site& a, const Site& b, const Site& c) {
  double error = geometry::residual(disk, a, b, c);
  const double furthest = polish_reach * disk.radius;
  const Vec2 center = disk.center;
  const auto take_if_better = [&](const Disk& better) {
    const double better_error = geometry::residual(better, a, b, c);
    if (!(better_error < error && distance(better.center, center) <= furthest)) return false;
    disk = better;
    error = better_error;
    return true;
  };
  for (int step = 0; step < 2 && error > 0.25 * context.tolerance; ++step)
    if (!take_if_better(geometry::improve(disk, a, b, c))) break;
  if (error <= context.tolerance) return disk;
  ++context.statistics.precision_retries;
  Disk precise;
  if (geometry::tangent_disk_in_high_precision(a, b, c, disk, precise)) take_if_better(precise);
  return disk;
}

/// How fast, along the bisector, the disk grows over a third site.
double closing(const Bisector& bisector, const Disk& disk, const Site& third) {
  return dot(geometry::outward(bisector.right, disk.center) - geometry::outward(third, disk.center),
             bisector.tangent(disk.center));
}

/// The disk on the bisector that touches the carrier of `third`, between positions `low` and
/// `high`: the first one that begins to reach over it.
std::optional<Disk> contact_with_carrier(Context& context, const Bisector& bisector,
                                         const Disk& from, double high, const Site& third) {
  ++context.statistics.apollonius;
  const double low = bisector.position(from.center);
  const geometry::TangentDisks disks =
      geometry::tangent_disks(bisector.right, bisector.left, third);
  std::optional<Disk> best;
  double best_violation = slack(context, bisector, from);
  for (std::size_t i = 0; i < disks.count; ++i) {
    const Disk& disk = disks.disk[i];
    if (disk.radius > context.radius_limit) continue;
    const double position = bisector.position(disk.center);
    const double violation = std::max({0.0, low - position, position - high});
    const bool better = best && violation == best_violation
                            ? closing(bisector, disk, third) > closing(bisector, *best, third)
                            : violation <= best_violation;
    if (!better) continue;
    best = disk;
    best_violation = violation;
  }
  if (best) *best = polished(context, *best, bisector.right, bisector.left, third);
  if (best && bisector.position(best->center) < low) best = from;
  return best;
}

/// The nearer end of an arc or segment.
Site end_near(const Site& site, Vec2 center) {
  const bool at_end = geometry::foot_parameter(site, center) > 0.5 * site.length;
  return geometry::make_vertex(at_end ? site.end() : site.point);
}

/// Where closed forms fail: halves the way from a disk that does not overlap the site to one that
/// does. Always ends.
Disk bracket(Context& context, const Bisector& bisector, const Disk& from, const Site& third,
             double high) {
  ++context.statistics.brackets;
  double low = bisector.position(from.center);
  Disk disk = from;
  for (int step = 0; step < most_halvings; ++step) {
    const double middle = 0.5 * (low + high);
    if (!(low < middle && middle < high)) break;
    const Disk tried = bisector.disk_at(middle, from);
    if (!(tried.radius <= context.radius_limit) || overlaps(tried, third, 0)) {
      high = middle;
    } else {
      low = middle;
      disk = tried;
    }
  }
  const double s = third.is_vertex() ? 0 : geometry::carrier_parameter(third, disk.center);
  const Site& touched = s >= 0 && s <= third.length ? third : end_near(third, disk.center);
  const Disk better = polished(context, disk, bisector.right, bisector.left, touched);
  return touches(better, third, context.tolerance) ? better : disk;
}

/// The disk on a bisector, ahead of `from`, that first touches a third site, which the disk
/// `overlapping`, further on, reaches over.
Disk first_contact(Context& context, const Bisector& bisector, const Disk& from, const Site& third,
                   const Disk& overlapping) {
  if (touches(from, third, context.tolerance)) return from;
  const double high = bisector.position(overlapping.center);
  const auto reaches = [&](const std::optional<Disk>& disk) {
    return disk && touches(*disk, third, 2 * context.tolerance);
  };
  const auto on_carrier = contact_with_carrier(context, bisector, from, high, third);
  if (reaches(on_carrier)) return *on_carrier;
  if (!third.is_vertex()) {
    const Disk& near = on_carrier ? *on_carrier : overlapping;
    const auto on_end =
        contact_with_carrier(context, bisector, from, high, end_near(third, near.center));
    if (reaches(on_end)) return *on_end;
  }
  return bracket(context, bisector, from, third, high);
}

/// A disk, and whether it fits into the circles of the arcs that it touches at one place.
struct EndDisk {
  Disk disk;
  bool fits = true;
};

/// The disk that touches the boundary at the last place that a foot moving on an element gets to,
/// `forward` or backward, and touches the carrier of `other`.
std::optional<EndDisk> disk_at_end(const Context& context, const Subshape& subshape, std::size_t i,
                                   bool forward, const Site& other,
                                   const std::vector<Disk>& disks) {
  const Element& element = subshape.elements[i];
  const Site& own = context.site(element);
  const std::size_t neighbor = forward ? subshape.next(i) : subshape.before(i);
  const Site& next = context.site(subshape.elements[neighbor]);
  const Element& before_end = forward ? element : subshape.elements[neighbor];
  const bool passes = context.joins_smoothly(before_end);
  Vec2 foot = own.point, normal;
  double largest = std::max(0.0, own.curvature);
  if (!own.is_vertex()) {
    const double end = forward ? element.to : element.from;
    foot = own.at(end);
    normal = own.normal_at(end);
    // The directions of an arc whose length is some roundings are known to little: at a smooth
    // joint the longer edge tells.
    if (passes && next.length > own.length) normal = forward ? next.normal() : next.end_normal();
  } else if (passes) {
    normal = forward ? next.normal() : next.end_normal();
  } else {
    const Vec2 to_center = disks[before_end.disk_after].center - foot;
    normal = (1 / norm(to_center)) * to_center;
  }
  if (passes) largest = std::max(largest, next.curvature);
  const double radius = geometry::tangent_radius(foot, normal, other);
  constexpr double widest = 1e-7;  // a disk fits into an arc's circle up to this
  // In a narrow wedge the disk at the end may be far larger than the shape's.
  constexpr double far_end = 0x1p20;
  if (!(radius <= far_end * context.radius_limit)) return std::nullopt;
  return EndDisk{{foot + radius * normal, radius}, radius * largest <= 1 + widest};
}

/// Where a disk touches element `k`, or its neighbour if the nearest point of both is their joint
/// within rounding but lies inside of the neighbour.
Place place_on(const Context& context, const Subshape& subshape, std::size_t k, const Disk& disk) {
  int direction = 0;
  for (std::size_t step = 0; step < subshape.size(); ++step) {
    const Element& element = subshape.elements[k];
    const Site& site = context.site(element);
    const std::size_t before = subshape.before(k), next = subshape.next(k);
    const bool joins_before = context.joins_smoothly(subshape.elements[before]),
               joins_next = context.joins_smoothly(element);
    bool goes_back = false, goes_on = false;
    double s = 0;
    if (site.is_vertex()) {
      const auto lies_inside = [&](std::size_t i) {
        const Site& neighbor = context.site(subshape.elements[i]);
        const double there = geometry::foot_parameter(neighbor, disk.center);
        return there > 0 && there < neighbor.length;
      };
      goes_on = joins_next && lies_inside(next);
      goes_back = !goes_on && joins_before && lies_inside(before);
    } else {
      s = geometry::foot_parameter(site, disk.center);
      goes_back = s <= 0 && joins_before;
      goes_on = s >= site.length && joins_next;
    }
    if (!goes_back && !goes_on) return {k, false, std::clamp(s, element.from, element.to)};
    if (goes_back && direction > 0) return {before, true, 0};
    if (goes_on && direction < 0) return {k, true, 0};
    direction = goes_on ? 1 : -1;
    k = goes_on ? next : before;
  }
  return {k, false, 0};
}

/// The dividing disk, if any, beyond which a disk would touch element `k`. Where many sites are
/// nearly touched by one disk, three that enclose small angles may ask for a disk there; the
/// dividing disk, which they touch within the tolerance, is their branching then.
const Disk* disk_passed(const Context& context, const Subshape& subshape, std::size_t k,
                        const Disk& disk, const std::vector<Disk>& disks) {
  constexpr double rounding = 0x1p-50;
  const Element& element = subshape.elements[k];
  const Element& before = subshape.elements[subshape.before(k)];
  const Site& site = context.site(element);
  if (site.is_vertex()) return nullptr;
  const double s = geometry::foot_parameter(site, disk.center);
  if (s < element.from - rounding && !before.is_joined()) return &disks[before.disk_after];
  if (s > element.to + rounding && !element.is_joined()) return &disks[element.disk_after];
  return nullptr;
}

}  // namespace

MaximalDisk maximal_disk(Context& context, const Subshape& subshape, const Place& place) {
  ++context.statistics.queries;
  const std::size_t i = place.element, n = subshape.size();
  const Element& own = subshape.elements[i];
  const std::size_t after = subshape.next(i), before = subshape.before(i);
  std::size_t base = i;  // the arc whose normal the disk has
  double parameter = place.parameter;
  if (place.at_joint) {
    base = context.site(own).is_vertex() ? after : i;
    parameter = base == i ? context.site(own).length : 0;
  }
  const Site& arc = context.site(subshape.elements[base]);
  const Vec2 foot = arc.at(parameter), normal = arc.normal_at(parameter);
  double radius = context.radius_limit;
  if (arc.curvature > 0) radius = std::min(radius, 1 / arc.curvature);

  // What joins the place smoothly is touched nowhere else. (Two neighbours of monotonic curvature
  // have nested circles, and a disk that touches both sides of a reflex vertex has it inside.)
  const auto is_beside = [&](std::size_t k) {
    if (k == i) return true;
    if (place.at_joint && k == after) return true;
    if (k == after || (place.at_joint && k == subshape.next(after)))
      return context.joins_smoothly(subshape.elements[subshape.before(k)]);
    return k == before && context.joins_smoothly(subshape.elements[before]);
  };
  std::size_t touched = n;
  Disk disk{foot + radius * normal, radius};
  for (std::size_t step = 1, k = after; step < n; ++step, k = subshape.next(k)) {
    const Site& site = context.site(subshape.elements[k]);
    if (!overlaps(disk, site, context.rounding()) || is_beside(k)) continue;
    const double smaller = geometry::touching_radius(foot, normal, site);
    if (!(smaller > 0 && smaller < disk.radius)) continue;
    disk = {foot + smaller * normal, smaller};
    touched = k;
  }
  MaximalDisk result{disk, {place}};
  if (touched < n) result.contacts.push_back(place_on(context, subshape, touched, disk));
  return result;
}

std::optional<MaximalDisk> branching_disk(Context& context, const Subshape& subshape, std::size_t i,
                                          const std::vector<Disk>& disks) {
  ++context.statistics.queries;
  const std::size_t left = i, right = subshape.next(i);
  const Element &on_left = subshape.elements[left], &on_right = subshape.elements[right];
  if (left == right) return std::nullopt;
  const Disk& from = disks[on_left.disk_after];
  const Bisector bisector(context.site(on_right), context.site(on_left));
  const double low = bisector.position(from.center);

  // As long as both feet are on their elements, disks further on reach over all that the disks
  // before them do; so the scan begins where the first foot gets to its end. At a joint it passes
  // on to the neighbour there; elsewhere only rounding lets the disk reach over no neighbour.
  std::optional<Place> third;
  Disk disk;
  double position = nowhere;
  const std::size_t after = subshape.next(right), before = subshape.before(left);
  const bool passes_right = context.joins_smoothly(on_right),
             passes_left = context.joins_smoothly(subshape.elements[before]);
  const auto bound_by = [&](std::size_t own, std::size_t other, bool forward, const Place& place) {
    const auto at_end =
        disk_at_end(context, subshape, own, forward, context.site(subshape.elements[other]), disks);
    if (!at_end) return;
    const double there = bisector.position(at_end->disk.center);
    if (there < low - slack(context, bisector, from) || !(there < position)) return;
    disk = there < low ? from : at_end->disk;
    position = std::max(there, low);
    third.reset();
    if (at_end->fits) third = place;
  };
  bound_by(right, left, true, Place{passes_right ? right : after, passes_right, 0});
  bound_by(left, right, false, Place{before, passes_left, 0});
  // Arcs of one circle between the two: the axis ends in its centre. Joints so near to each other
  // would leave the disk open.
  const Site& next = context.site(subshape.elements[after]);
  bool is_apex = next.curvature > 0 && 1 / next.curvature <= context.radius_limit;
  for (std::size_t k = right; is_apex && k != left; k = subshape.next(k)) {
    const Element& element = subshape.elements[k];
    is_apex = element.is_joined() && context.outline.joints[element.site] == Joint::smooth &&
              (k == right || std::abs(context.site(element).curvature - next.curvature) <=
                                 same_curvature * next.curvature);
  }
  if (is_apex) {
    const double radius = 1 / next.curvature;
    disk = {next.point + radius * next.normal(), radius};
    position = std::max(low, bisector.position(disk.center));
    third = Place{after, false, 0.5 * next.length};
  }
  if (position == nowhere) {
    position = bisector.last_position(from, context.radius_limit);
    disk = bisector.disk_at(position, from);
  }

  for (std::size_t k = after; k != left && !is_apex; k = subshape.next(k)) {
    if ((k == after && passes_right) || (k == before && passes_left)) continue;
    const Site& site = context.site(subshape.elements[k]);
    if (!overlaps(disk, site, context.rounding())) continue;
    disk = first_contact(context, bisector, from, site, disk);
    position = bisector.position(disk.center);
    third = Place{k, false, geometry::foot_parameter(site, disk.center)};
  }
  if (!third) return std::nullopt;
  for (const std::size_t k : {right, third->element, left}) {
    const Disk* const passed = disk_passed(context, subshape, k, disk, disks);
    if (passed == nullptr) continue;
    disk = *passed;
    break;
  }
  MaximalDisk result{disk, {}};
  const bool right_at_joint = third->at_joint && third->element == right;
  const bool left_at_joint = third->at_joint && third->element == before;
  const auto add = [&](const Place& place) {
    for (const Place& known : result.contacts)
      if (known.element == place.element && known.at_joint == place.at_joint) return;
    result.contacts.push_back(place);
  };
  if (!right_at_joint) add(place_on(context, subshape, right, disk));
  add(third->at_joint ? *third : place_on(context, subshape, third->element, disk));
  if (!left_at_joint) add(place_on(context, subshape, left, disk));
  return result;
}

}  // namespace medial::biarc_dc
