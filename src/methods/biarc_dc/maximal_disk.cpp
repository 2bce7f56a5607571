#include "methods/biarc_dc/maximal_disk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "methods/disks/boundary.h"
#include "site/bisector.h"
#include "site/smooth_place.h"
#include "site/tangent_disk.h"

namespace medial::biarc_dc {
namespace {

using site::Bisector;
using site::Site;

constexpr double nowhere = std::numeric_limits<double>::infinity();

/// After this many halvings, an interval of doubles cannot change any more.
constexpr int most_halvings = 128;

/// The curvatures of arcs of one circle differ by at most this share, by rounding.
constexpr double same_curvature = 1e-9;

/// The distance by which rounding may put a disk behind the one where a bisector begins; a disk
/// further behind is another solution. Near the centre of the arc whose foot gives positions,
/// errors are magnified by the radius over the distance from the centre.
double slack(const Context& context, const Bisector& bisector, const Disk& from) {
  double factor = 4;
  if (bisector.reference != nullptr) {
    const double size = site::view_of_arc(*bisector.reference, from.center).size;
    factor *= bisector.reference->is_arc() ? std::abs(bisector.scale) / std::min(1.0, size) : 1.0;
  }
  return factor * context.tolerance + 1e-9 * from.radius;
}

/// Whether a disk reaches over a closed site by more than `slack`.
bool overlaps(const Disk& disk, const Site& site, double slack) {
  const double reach = disk.radius - slack;
  return reach > 0 && !is_far(site, disk.center, reach) &&
         site::squared_distance(site, disk.center) < reach * reach;
}
bool touches(const Disk& disk, const Site& site, double slack) {
  return std::abs(site::gap(site, disk)) <= slack;
}

Disk polished(Context& context, Disk disk, const Site& a, const Site& b, const Site& c) {
  site::polish(disk, a, b, c, 0.25 * context.tolerance, context.tolerance,
               context.statistics.precision_retries);
  return disk;
}

/// The rate at which the disk grows over a third site along the bisector.
double closing(const Bisector& bisector, const Disk& disk, const Site& third) {
  return dot(site::outward(bisector.right, disk.center) - site::outward(third, disk.center),
             bisector.tangent(disk.center));
}

/// The disk on the bisector that touches the carrier of `third`, between the position of `from` and
/// `high`: the first one after which disks reach over it.
std::optional<Disk> contact_with_carrier(Context& context, const Bisector& bisector,
                                         const Disk& from, double high, const Site& third) {
  ++context.statistics.apollonius;
  const double low = bisector.position(from.center);
  const site::TangentDisks disks = site::tangent_disks(bisector.right, bisector.left, third);
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
  const bool at_end = site::foot_parameter(site, center) > 0.5 * site.length;
  return site::make_vertex(at_end ? site.end() : site.point);
}

/// Used if closed forms fail: bisects between a disk that does not overlap the site and one that
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
  const double s = third.is_vertex() ? 0 : site::carrier_parameter(third, disk.center);
  const Site& touched = s >= 0 && s <= third.length ? third : end_near(third, disk.center);
  const Disk better = polished(context, disk, bisector.right, bisector.left, touched);
  return touches(better, third, context.tolerance) ? better : disk;
}

/// The first disk on a bisector after `from` that touches a third site. `overlapping`, further on,
/// reaches over that site.
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

/// A disk, and whether it fits into the circles of the arcs that it touches at one point.
struct EndDisk {
  Disk disk;
  bool fits = true;
};

/// The disk that touches the boundary at the last point that a foot on an element reaches,
/// `forward` or backward, and touches the carrier of `other`.
std::optional<EndDisk> disk_at_end(const Context& context, const Subshape& subshape, std::size_t i,
                                   bool forward, const Site& other, const DiskList& disks) {
  const Element& element = subshape.elements[i];
  const Site& own = context.site(element);
  const std::size_t neighbor = forward ? subshape.next(i) : subshape.before(i);
  const Site& next = context.site(subshape.elements[neighbor]);
  const Element& before_end = forward ? element : subshape.elements[neighbor];
  const bool passes = context.joins_smoothly(before_end);
  Vec2 foot = own.point, normal;
  double largest = std::max(0.0, own.curvature);
  if (passes) {
    const auto place = forward ? site::smooth_place(own, next) : site::smooth_place(next, own);
    foot = place.point;
    normal = place.normal;
  } else if (!own.is_vertex()) {
    const double end = forward ? element.to : element.from;
    foot = own.at(end);
    normal = own.normal_at(end);
  } else {
    const Vec2 to_center = disks[before_end.disk_after].center - foot;
    normal = (1 / norm(to_center)) * to_center;
  }
  if (passes) largest = std::max(largest, next.curvature);
  const double radius = site::tangent_radius(foot, normal, other);
  constexpr double widest = 1e-7;  // a disk fits into an arc's circle up to this share
  // In a narrow wedge, the disk at the end may be far larger than any disk in the shape.
  constexpr double far_end = 0x1p20;
  if (!(radius <= far_end * context.radius_limit)) return std::nullopt;
  return EndDisk{{foot + radius * normal, radius}, radius * largest <= 1 + widest};
}

/// Of the copies of a reflex vertex that cutting disks make, the one that a disk around `center`
/// touches; `k` if the sub-shape has none.
std::size_t facing_copy(Context& context, const Subshape& subshape, std::size_t k, Vec2 point,
                        Vec2 center, const DiskList& disks) {
  constexpr double same_place = 0x1p-48;
  context.tree.within(point, same_place, subshape.elements.front().site,
                      subshape.elements.back().site, context.found);
  for (const std::uint32_t site : context.found) {
    const std::size_t copy = subshape.find(site);
    if (copy < subshape.size() && context.outline.sites[site].is_vertex() &&
        faces(context, subshape, copy, center, disks))
      return copy;
  }
  return k;
}

/// The place where a disk touches element `k`. If cutting disks have divided the boundary, it may
/// be another copy of the touched vertex: because the disk is not in the vertex's range of
/// directions, or because the foot is at the end of the site, beyond the element.
Place place_or_copy(Context& context, const Subshape& subshape, std::size_t k, const Disk& disk,
                    const DiskList& disks) {
  const Element& element = subshape.elements[k];
  const Site& site = context.site(element);
  const double s = site.is_vertex() ? 0 : site::foot_parameter(site, disk.center);
  const bool is_beyond =
      (s <= 0 && element.from > 0) || (s >= site.length && element.to < site.length);
  const Place place{k, false, std::clamp(s, element.from, element.to)};
  if (context.outline.cutting_disks.empty()) return place;
  if (site.is_vertex() ? faces(context, subshape, k, disk.center, disks) : !is_beyond) return place;
  const std::size_t copy = facing_copy(
      context, subshape, k, site.at(std::clamp(s, 0.0, site.length)), disk.center, disks);
  return copy == k ? place : Place{copy, false, 0};
}

/// The place where a disk touches element `k`, or its neighbour if the nearest point of the element
/// is their joint within rounding, but that of the neighbour is in its inside.
Place place_on(Context& context, const Subshape& subshape, std::size_t k, const Disk& disk,
               const DiskList& disks) {
  int direction = 0;
  for (std::size_t step = 0; step < subshape.size(); ++step) {
    const Element& element = subshape.elements[k];
    const Site& site = context.site(element);
    const std::size_t before = subshape.before(k), next = subshape.next(k);
    const bool joins_before = context.joins_smoothly(subshape.elements[before]),
               joins_next = context.joins_smoothly(element);
    bool goes_back = false, goes_on = false;
    if (site.is_vertex()) {
      const auto lies_inside = [&](std::size_t i) {
        const Site& neighbor = context.site(subshape.elements[i]);
        const double there = site::foot_parameter(neighbor, disk.center);
        return there > 0 && there < neighbor.length;
      };
      goes_on = joins_next && lies_inside(next);
      goes_back = !goes_on && joins_before && lies_inside(before);
    } else {
      const double s = site::foot_parameter(site, disk.center);
      goes_back = s <= 0 && joins_before;
      goes_on = s >= site.length && joins_next;
    }
    if (!goes_back && !goes_on) return place_or_copy(context, subshape, k, disk, disks);
    if (goes_back && direction > 0) return {before, true, 0};
    if (goes_on && direction < 0) return {k, true, 0};
    direction = goes_on ? 1 : -1;
    k = goes_on ? next : before;
  }
  return {k, false, 0};
}

/// The dividing disk, if any, that the walk passes before a disk touches element `k`. If one disk
/// nearly touches many sites, three of them that enclose small angles may yield such a disk; the
/// dividing disk, which they touch within the tolerance, is their branching then.
const Disk* disk_passed(const Context& context, const Subshape& subshape, std::size_t k,
                        const Disk& disk, const DiskList& disks) {
  constexpr double rounding = 0x1p-50;
  const Element& element = subshape.elements[k];
  const Element& before = subshape.elements[subshape.before(k)];
  const Site& site = context.site(element);
  if (site.is_vertex()) return nullptr;
  const double s = site::foot_parameter(site, disk.center);
  if (s < element.from - rounding && !before.is_joined()) return &disks[before.disk_after];
  if (s > element.to + rounding && !element.is_joined()) return &disks[element.disk_after];
  return nullptr;
}

}  // namespace

bool faces(const Context& context, const Subshape& subshape, std::size_t k, Vec2 center,
           const DiskList& disks) {
  const Element &own = subshape.elements[k], &before = subshape.elements[subshape.before(k)];
  const Vec2 vertex = context.site(own).point;
  const Vec2 first = before.is_joined() ? context.site(before).end_normal()
                                        : disks[before.disk_after].center - vertex;
  const Vec2 last = own.is_joined() ? context.site(subshape.elements[subshape.next(k)]).normal()
                                    : disks[own.disk_after].center - vertex;
  return disks::in_wedge(first, last, center - vertex);
}

namespace {

/// A range of sites in boundary order from one element of a sub-shape to another, including those
/// of other sub-shapes in between.
struct Range {
  std::uint32_t first, last;
  std::optional<std::pair<std::uint32_t, std::uint32_t>> rest = {};  ///< beyond the end of the list

  Range(const Subshape& subshape, std::size_t from, std::size_t to)
      : first(subshape.elements[from].site), last(subshape.elements[to].site) {
    if (from <= to) return;
    rest = {subshape.elements.front().site, last};
    last = subshape.elements.back().site;
  }
  /// The site nearest to a disk's centre, among those that the disk overlaps by more than `slack`.
  site::BoundaryTree::Hit nearest(const site::BoundaryTree& tree, const Disk& disk,
                                  double slack) const {
    const auto hit = tree.nearest(disk.center, disk.radius - slack, first, last);
    if (!rest) return hit;
    const double reach = hit ? std::sqrt(hit.squared_distance) : disk.radius - slack;
    const auto other = tree.nearest(disk.center, reach, rest->first, rest->second);
    return other ? other : hit;
  }
};

/// The disk that touches a sub-shape's boundary at one place; elements make it smaller.
struct DiskAtPlace {
  Context& context;
  const Subshape& subshape;
  const Place& place;
  Vec2 foot, normal;
  Disk disk{};
  std::size_t touched = subshape.size();

  DiskAtPlace(Context& a_context, const Subshape& a_subshape, const Place& a_place)
      : context(a_context), subshape(a_subshape), place(a_place) {
    const Site& own = context.site(subshape.elements[place.element]);
    double bend = own.curvature;
    if (place.at_joint) {
      const Site& next = context.site(subshape.elements[subshape.next(place.element)]);
      const auto joint = site::smooth_place(own, next);
      foot = joint.point;
      normal = joint.normal;
      bend = std::max(bend, next.curvature);
    } else {
      foot = own.at(place.parameter);
      normal = own.normal_at(place.parameter);
    }
    const double largest = context.radius_limit;
    set(bend > 0 ? std::min(largest, 1 / bend) : largest);
  }
  void set(double radius) { disk = {foot + radius * normal, radius}; }

  /// The number of elements to skip after the place, in boundary order, and before it: elements
  /// that join the place smoothly touch the disk nowhere else. (Two neighbours of monotonic
  /// curvature have nested circles, and a disk that touches both sides of a reflex vertex contains
  /// it.)
  std::size_t beside_after() const {
    const std::size_t k = place.at_joint ? subshape.next(place.element) : place.element;
    return (place.at_joint ? 1 : 0) + (context.joins_smoothly(subshape.elements[k]) ? 1 : 0);
  }
  std::size_t beside_before() const {
    return context.joins_smoothly(subshape.elements[subshape.before(place.element)]) ? 1 : 0;
  }

  /// Makes the disk smaller, so that it touches a site. Returns false if it already is.
  bool shrink(std::uint32_t site) {
    if (place.at_joint && context.ends_at(site, foot)) return false;
    const double smaller = site::touching_radius(foot, normal, context.outline.sites[site]);
    if (!(smaller > 0 && smaller < disk.radius)) return false;
    set(smaller);
    return true;
  }

  void scan() {
    const std::size_t n = subshape.size(), end = n - beside_before();
    for (std::size_t step = 1 + beside_after(); step < end; ++step) {
      const std::size_t k = (place.element + step) % n;
      const std::uint32_t site = subshape.elements[k].site;
      if (overlaps(disk, context.outline.sites[site], context.rounding()) && shrink(site))
        touched = k;
    }
  }

  /// The same as scan(), by the tree. A disk that is maximal in the sub-shape is maximal in the
  /// shape, so it does not matter which sites make it smaller, as long as the last one belongs to
  /// the sub-shape. Returns false if rounding prevents this.
  bool search() {
    const std::size_t n = subshape.size();
    const Range range(subshape, (place.element + 1 + beside_after()) % n,
                      (place.element + n - 1 - beside_before()) % n);
    std::uint32_t last = none;
    while (const auto hit = range.nearest(context.tree, disk, context.rounding())) {
      if (!shrink(hit.site)) return false;
      last = hit.site;
    }
    if (last != none) touched = subshape.find(last);
    return last == none || touched < n;
  }
};

/// If an arc's own circle reaches over nothing up to rounding, a neighbour with a smaller circle,
/// if any: the axis ends in the centre of that circle.
std::optional<Place> rounder_neighbor(const Context& context, const Subshape& subshape,
                                      const Place& place) {
  const auto is_smooth = [&](std::size_t k) {
    const Element& element = subshape.elements[k];
    return element.is_joined() && context.outline.joints[element.site] == Joint::smooth;
  };
  const std::size_t i = place.element, before = subshape.before(i), after = subshape.next(i);
  std::size_t roundest = i;
  const auto take_if_rounder = [&](std::size_t k) {
    const double bend = context.site(subshape.elements[k]).curvature;
    if (bend > context.site(subshape.elements[roundest]).curvature) roundest = k;
  };
  if (is_smooth(before)) take_if_rounder(before);
  if (is_smooth(i)) take_if_rounder(after);
  if (roundest == i) return std::nullopt;
  const Element& element = subshape.elements[roundest];
  return Place{roundest, false, 0.5 * (element.from + element.to)};
}

}  // namespace

MaximalDisk maximal_disk(Context& context, const Subshape& subshape, const Place& place,
                         const DiskList& disks) {
  ++context.statistics.queries;
  DiskAtPlace at(context, subshape, place);
  const double largest = at.disk.radius;
  if (subshape.size() <= most_scanned || !at.search()) {
    at.set(largest);
    at.scan();
  }
  if (at.touched == subshape.size())
    if (const auto rounder = rounder_neighbor(context, subshape, place))
      return maximal_disk(context, subshape, *rounder, disks);
  MaximalDisk result{at.disk};
  result.add(place);
  if (at.touched < subshape.size())
    result.add(place_on(context, subshape, at.touched, at.disk, disks));
  return result;
}

namespace {

/// The end of a walk along a bisector: a disk that touches a third place, or is as large as any
/// disk in the shape.
struct Stop {
  Disk disk;
  double position = nowhere;
  std::optional<Place> third = {};
};

/// The walk from a gate, between the gate's two elements, to its end.
struct BranchWalk {
  Context& context;
  const Subshape& subshape;
  const DiskList& disks;
  std::size_t right, left;  ///< elements
  Disk from;
  Bisector bisector{context.site(subshape.elements[right]), context.site(subshape.elements[left])};
  double low = bisector.position(from.center);
  std::size_t after = subshape.next(right), before = subshape.before(left);
  bool passes_right = context.joins_smoothly(subshape.elements[right]);
  bool passes_left = context.joins_smoothly(subshape.elements[before]);

  /// Whether a disk overlaps an arc's circle, but no part of the arc.
  bool reaches_over_circle(const Disk& disk, std::size_t element) const {
    const Site& site = context.site(subshape.elements[element]);
    return site.is_arc() && !overlaps(disk, site, context.rounding()) &&
           site::carrier_distance(site, disk.center) < disk.radius - context.rounding();
  }

  /// While both feet are on their elements, each disk reaches over everything that the disks before
  /// it reach over. So the scan starts at the first foot that reaches the end of its element. At a
  /// joint, the neighbour continues; elsewhere, only rounding lets the disk reach over no
  /// neighbour.
  Stop end_of_feet() const {
    Stop stop;
    const auto bound_by = [&](std::size_t own, std::size_t other, bool forward,
                              const Place& place) {
      const auto at_end = disk_at_end(context, subshape, own, forward,
                                      context.site(subshape.elements[other]), disks);
      if (!at_end) return;
      Disk disk = at_end->disk;
      double there = bisector.position(disk.center);
      if (there < low - slack(context, bisector, from)) return;
      // At a convex joint, the disk reaches over the neighbour, which an earlier disk touches. Near
      // the centre of an arc, only the arc's circle shows this.
      const std::size_t neighbor = forward ? after : before;
      const bool is_convex = subshape.elements[forward ? right : before].is_joined() &&
                             !(forward ? passes_right : passes_left) && neighbor != other;
      if (is_convex && there > low && reaches_over_circle(disk, neighbor)) {
        const auto earlier = contact_with_carrier(context, bisector, from, there,
                                                  context.site(subshape.elements[neighbor]));
        if (earlier) disk = *earlier;
        there = bisector.position(disk.center);
      }
      if (!(there < stop.position)) return;
      stop = {there < low ? from : disk, std::max(there, low), {}};
      if (at_end->fits) stop.third = place;
    };
    bound_by(right, left, true, Place{passes_right ? right : after, passes_right, 0});
    bound_by(left, right, false, Place{before, passes_left, 0});
    if (stop.position == nowhere) {
      stop.position = bisector.last_position(from, context.radius_limit);
      stop.disk = bisector.disk_at(stop.position, from);
    }
    return stop;
  }

  /// If arcs of one circle are between the two elements, the axis ends in the centre of the circle.
  /// Joints so close to each other would not determine the disk.
  std::optional<Stop> apex() const {
    const double bend = context.site(subshape.elements[after]).curvature;
    if (!(bend > 0 && 1 / bend <= context.radius_limit)) return std::nullopt;
    std::size_t roundest = after;
    for (std::size_t k = right; k != left; k = subshape.next(k)) {
      const Element& element = subshape.elements[k];
      const double own = context.site(element).curvature;
      if (!(element.is_joined() && context.outline.joints[element.site] == Joint::smooth &&
            (k == right || std::abs(own - bend) <= same_curvature * bend)))
        return std::nullopt;
      if (k != right && own > context.site(subshape.elements[roundest]).curvature) roundest = k;
    }
    const Site& arc = context.site(subshape.elements[roundest]);
    const double radius = 1 / arc.curvature;
    const Disk disk{arc.point + radius * arc.normal(), radius};
    return Stop{disk, std::max(low, bisector.position(disk.center)),
                Place{roundest, false, 0.5 * arc.length}};
  }

  /// Moves the disk back along the bisector to where it touches the element that it reaches over.
  void move_back(Stop& stop, std::size_t k) const {
    const Site& site = context.site(subshape.elements[k]);
    stop.disk = first_contact(context, bisector, from, site, stop.disk);
    stop.position = bisector.position(stop.disk.center);
    stop.third = Place{k, false, site::foot_parameter(site, stop.disk.center)};
  }

  /// Whether an element is another copy of the vertex `right` or `left`, or ends in one.
  bool ends_at_vertex(std::size_t k) const {
    for (const Site* site : {&bisector.right, &bisector.left})
      if (site->is_vertex() && context.ends_at(subshape.elements[k].site, site->point)) return true;
    return false;
  }

  void scan(Stop& stop) const {
    for (std::size_t k = after; k != left; k = subshape.next(k)) {
      if ((k == after && passes_right) || (k == before && passes_left)) continue;
      if (overlaps(stop.disk, context.site(subshape.elements[k]), context.rounding()) &&
          !ends_at_vertex(k))
        move_back(stop, k);
    }
  }

  /// The same as scan(), by the tree. Returns false if, by rounding, it reaches an element of
  /// another sub-shape, or one element twice.
  bool search(Stop& stop) const {
    const std::size_t first = passes_right ? subshape.next(after) : after,
                      last = passes_left ? subshape.before(before) : before;
    const Range range(subshape, first, last);
    while (const auto hit = range.nearest(context.tree, stop.disk, context.rounding())) {
      const double position = stop.position;
      const std::size_t k = subshape.find(hit.site);
      if (k == subshape.size() || ends_at_vertex(k)) return false;
      move_back(stop, k);
      if (!(stop.position < position)) return false;
    }
    return true;
  }

  /// The first disk after the gate that touches a third place.
  Stop first_stop() const {
    if (const auto at_apex = apex()) return *at_apex;
    const Stop at_end = end_of_feet();
    Stop stop = at_end;
    const bool is_large = after != left && subshape.count(after, before) > most_scanned;
    if (is_large && search(stop)) return stop;
    stop = at_end;
    scan(stop);
    return stop;
  }

  /// The disk and its places on both elements and on the third one, without duplicates.
  MaximalDisk result(const Disk& disk, const Place& third) const {
    MaximalDisk maximal{disk};
    const auto add = [&](const Place& place) {
      for (const Place& known : maximal.contacts())
        if (known.element == place.element && known.at_joint == place.at_joint) return;
      maximal.add(place);
    };
    const bool right_at_joint = third.at_joint && third.element == right;
    const bool left_at_joint = third.at_joint && third.element == before;
    if (!right_at_joint) add(place_on(context, subshape, right, disk, disks));
    add(third.at_joint ? third : place_on(context, subshape, third.element, disk, disks));
    if (!left_at_joint) add(place_on(context, subshape, left, disk, disks));
    return maximal;
  }
};

}  // namespace

std::optional<MaximalDisk> branching_disk(Context& context, const Subshape& subshape,
                                          const Gate& gate, const DiskList& disks) {
  ++context.statistics.queries;
  if (gate.right == gate.left) return std::nullopt;
  const BranchWalk walk{context, subshape, disks, gate.right, gate.left, gate.disk};
  Stop stop = walk.first_stop();
  if (!stop.third) return std::nullopt;
  if (!stop.third->at_joint)
    stop.third = place_or_copy(context, subshape, stop.third->element, stop.disk, disks);
  for (const std::size_t k : {walk.right, stop.third->element, walk.left}) {
    const Disk* const passed = disk_passed(context, subshape, k, stop.disk, disks);
    if (passed == nullptr) continue;
    stop.disk = *passed;
    break;
  }
  return walk.result(stop.disk, *stop.third);
}

}  // namespace medial::biarc_dc
