#include "methods/disks/events.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "site/tangent_disk.h"

namespace medial::disks {
namespace {

using site::Site;
using Hit = Contacts::Hit;

constexpr double nowhere = std::numeric_limits<double>::infinity();

/// How often a disk is grown or shrunk by closed forms before its event is left open; about three
/// rounds are usual.
constexpr int most_rounds = 200;
/// From this round on, one that shortens the way by less than half is followed by a part of the
/// way.
constexpr int slow_round = 2;
/// How far beyond() may look, against the radius: there the bisector is still straight.
constexpr double widest_window = 1e-7;
/// In tolerances: the radius of a disk that is as good as a point.
constexpr double as_good_as_point = 8;

}  // namespace

Event EventSearch::local_event(bool on_right) {
  const auto [own, next, other] = side(on_right);
  if (boundary_.is_smooth(std::min(own, next))) return event_at_smooth_joint(on_right);
  return element(next) == Element::bridge ? event_across_bridge(on_right)
                                          : event_at_corner(on_right);
}

Event EventSearch::event_at_smooth_joint(bool on_right) {
  const auto joint = disk_at_joint(on_right);
  if (!joint) return {};
  const double position = bisector_.position(joint->disk.center);
  // On a parabola the foot's normal may turn that far only on the way back.
  if (is_behind(position)) return {};
  const auto kind = !joint->fits ? Event::Kind::far
                    : on_right   ? Event::Kind::pass_right
                                 : Event::Kind::pass_left;
  return not_behind({kind, Hit::none, joint->disk, position});
}

Event EventSearch::event_across_bridge(bool on_right) {
  const auto [own, next, other] = side(on_right);
  const std::uint32_t across = on_right ? own + 2 : own - 2;
  const bool continues_other =
      (on_right ? across + 1 : across - 1) == other && boundary_.is_smooth(std::min(across, other));
  if (continues_other) return {};  // the other foot's own event
  // Another copy of what is touched already is no third site.
  for (const std::uint32_t touched : {span_.right, span_.left})
    if (contacts_.in_one_place(across, touched, from_.center, from_.radius)) return {};
  const auto contact = contact_with(across, nowhere);
  // What is across may face elsewhere, and a point may have another copy that was just left.
  const bool faces = contact && contacts_.faces(across, contact->disk.center);
  return faces && reaches(*contact) ? *contact : end_of_range(on_right);
}

Event EventSearch::event_at_corner(bool on_right) {
  const auto [own, next, other] = side(on_right);
  // At a convex corner too, before the foot gets to the corner: the disk there is not empty,
  // unless the corner is so flat that it touches both sides within the tolerance. Their carriers
  // would leave the place open.
  const Vec2 foot = on_right ? site(next).point : site(own).point;
  const Vec2 normal = on_right ? site(own).end_normal() : site(own).normal();
  const Vec2 next_normal = on_right ? site(next).normal() : site(next).end_normal();
  const double radius = site::tangent_radius(foot, normal, site(other));
  const bool in_reach = radius <= context_.radius_limit;
  // Where the disk is nearly an arc's circle, it reaches over the next arc by more than next to a
  // segment.
  const double intrusion = site(next).is_arc() && in_reach
                               ? radius - site::carrier_distance(site(next), foot + radius * normal)
                               : 0.5 * radius * squared_norm(normal - next_normal);
  const bool flat = in_reach && intrusion <= 0.5 * context_.tolerance;
  if (!flat) {
    auto contact = contact_at_joint(next);
    if (!contact) contact = contact_with(next, nowhere);
    if (contact && reaches(*contact)) return *contact;
  }
  if (!in_reach) return {};
  Disk disk{foot + radius * normal, radius};
  if (flat && !boundary_.has_arcs && dot(normal, next_normal) > 0) {
    // Between the two normals, so that the disk is as near to one side as to the other.
    const Vec2 between = normal + next_normal, middle = (1 / norm(between)) * between;
    const double halfway = site::tangent_radius(foot, middle, site(other));
    if (halfway <= context_.radius_limit) disk = {foot + halfway * middle, halfway};
  }
  const double position = bisector_.position(disk.center);
  if (is_behind(position)) return {};  // the foot turns that far on the way back only
  return {flat ? Event::Kind::contact : Event::Kind::far, next, disk, position};
}

Event EventSearch::end_of_range(bool on_right) const {
  const auto [own, next, other] = side(on_right);
  const Vec2 center = boundary_.bridge_at(next).disk.center, foot = site::foot(site(own), center),
             to = center - foot;
  const double radius = site::tangent_radius(foot, (1 / norm(to)) * to, site(other));
  if (!(radius <= context_.radius_limit)) return {};
  const Disk disk{foot + (radius / norm(to)) * to, radius};
  const double position = bisector_.position(disk.center);
  if (position < low_ - slack()) return {};
  return {Event::Kind::far, on_right ? own + 2 : own - 2, disk, position};
}

bool EventSearch::comes_later(bool on_right, const Event& event) const {
  const auto [own, next, other] = side(on_right);
  if (event.kind == Event::Kind::none || !boundary_.is_corner(std::min(own, next))) return false;
  const Vec2 center = event.disk.center;
  const double s = site::carrier_parameter(site(own), center);
  return s >= 0 && s <= site(own).length &&
         site::squared_distance(site(next), center) >= event.disk.radius * event.disk.radius;
}

std::optional<EventSearch::JointDisk> EventSearch::disk_at_joint(bool on_right) const {
  const auto [own, next, other] = side(on_right);
  if (boundary_.has_arcs)
    if (const auto circle = circle_of_apex(next, other)) return JointDisk{*circle};
  const auto [foot, normal] = boundary_.smooth_place(std::min(own, next), std::max(own, next));
  const double radius = site::tangent_radius(foot, normal, site(other));
  if (!(radius <= context_.radius_limit)) return std::nullopt;
  const bool fits =
      !boundary_.has_arcs ||
      radius * std::max(site(own).curvature, site(next).curvature) <= 1 + widest_window;
  return JointDisk{{foot + radius * normal, radius}, fits};
}

std::optional<Disk> EventSearch::circle_of_apex(std::uint32_t next, std::uint32_t other) const {
  const Site& arc = site(next);
  if (!(arc.curvature > 0) || !(1 / arc.curvature <= context_.radius_limit)) return std::nullopt;
  for (std::uint32_t i = std::min(next, other); i < std::max(next, other); ++i) {
    const Site& inner = next < other ? site(i) : site(i + 1);
    const bool same = std::abs(1 / inner.curvature - 1 / arc.curvature) <= context_.tolerance;
    if (element(i) != Element::edge || !boundary_.is_smooth(i) || !same) return std::nullopt;
  }
  const double radius = 1 / arc.curvature;
  return Disk{arc.point + radius * arc.normal(), radius};
}

std::optional<Event> EventSearch::contact_at_joint(std::uint32_t third) const {
  for (const bool on_right : {true, false}) {
    const auto [own, next, other] = side(on_right);
    if (third != next || !boundary_.is_smooth(std::min(own, next))) continue;
    const auto joint = disk_at_joint(on_right);
    if (!joint || !joint->fits) continue;
    const Disk& disk = joint->disk;
    return not_behind({Event::Kind::contact, third, disk, bisector_.position(disk.center)});
  }
  return std::nullopt;
}

std::optional<Event> EventSearch::contact_with(const Site& touched, std::uint32_t third,
                                               double high) {
  ++contacts_.statistics.apollonius;
  const site::TangentDisks disks = site::tangent_disks(bisector_.right, bisector_.left, touched);
  const auto speed_at = [&](const Disk& disk) {
    return closing(disk, touched, bisector_.tangent(disk.center));
  };
  Event best;
  double best_violation = nowhere;
  for (std::size_t i = 0; i < static_cast<std::size_t>(disks.count); ++i) {
    const Disk& disk = disks.disk[i];
    if (disk.radius > context_.radius_limit) continue;
    const double position = bisector_.position(disk.center);
    double violation = std::max({0.0, low_ - position, position - high});
    // Circles go on behind arcs: what touches them there is the last choice.
    if (bisector_.reference != nullptr && disks.count == 2 && violation == 0 &&
        !(contacts_.reaches(span_.right, disk) && contacts_.reaches(span_.left, disk)))
      violation = slack();
    // Of two, the one where the disk begins to reach over the site, not where it ceases to.
    const bool better = violation != best_violation ? violation < best_violation
                                                    : speed_at(disk) > speed_at(best.disk);
    if (better) {
      best_violation = violation;
      best = {Event::Kind::contact, third, disk, position};
    }
  }
  if (best_violation > slack()) return std::nullopt;
  polish(best.disk, touched);
  best.position = bisector_.position(best.disk.center);
  return not_behind(best);
}

void EventSearch::polish(Disk& disk, const Site& third) {
  site::polish(disk, bisector_.right, bisector_.left, third, 0.25 * context_.tolerance,
               context_.tolerance, contacts_.statistics.precision_retries);
}

Event EventSearch::by_neighbors() {
  // A foot that passes on smoothly is found at little cost, and makes most corners' events
  // needless.
  const bool right_first = boundary_.is_smooth(span_.right) || !boundary_.is_smooth(span_.left - 1);
  Event event = local_event(right_first);
  if (!comes_later(!right_first, event)) {
    const Event other = local_event(!right_first);
    if (other.position < event.position || (!right_first && other.position == event.position))
      event = other;
  }
  if (event.kind == Event::Kind::none) event = far_event(from_.radius);
  return event;
}

Event EventSearch::far_event(double radius) const {
  constexpr double times = 8;
  const double least = as_good_as_point * context_.tolerance, limit = context_.radius_limit;
  const double larger = radius > 0 ? std::min(times * std::max(radius, least), limit) : limit;
  Event event{Event::Kind::far, Hit::none, {}, bisector_.last_position(from_, larger), true};
  event.disk = bisector_.disk_at(event.position, from_);
  return event;
}

std::optional<Event> EventSearch::plain(const Event& by_neighbors) {
  if (by_neighbors.kind == Event::Kind::far || span_.left - span_.right == 2 ||
      is_in_point(by_neighbors) ||
      (by_neighbors.kind == Event::Kind::contact && is_at_node(by_neighbors.site)))
    return std::nullopt;
  return of_empty_disk(by_neighbors);
}

Event EventSearch::next(const Event& event) {
  if (event.kind == Event::Kind::contact) {
    if (is_at_node(event.site)) return at_node(event.site);
    // The only site in between is the one found; but a circle may be touched in the wrong place.
    const bool straight = bisector_.reference == nullptr && !site(event.site).is_arc();
    if (span_.left - span_.right == 2 && straight) return event;
  }
  return first_contact(event);
}

bool EventSearch::is_at_node(std::uint32_t touched) const {
  return from_.radius > 0 && contacts_.touches(touched, from_, context_.tolerance) &&
         contacts_.faces(touched, from_.center);
}

Event EventSearch::at_node(std::uint32_t touched) const {
  return {Event::Kind::at_node, touched, from_, low_};
}

Event EventSearch::first_contact(Event event) {
  double empty = low_;  // position up to which disks are known to be empty
  bool look_beyond = true, is_slow = false;
  // Every round comes earlier, but one that looked beyond and those that grow; rounding could make
  // rounds repeat.
  for (int round = 0; round < most_rounds; ++round) {
    if (is_in_point(event)) {
      if (boundary_.sides == Sides::both) return {};  // where edges meet, no foot passes on
      break;
    }
    const bool is_contact = event.kind == Event::Kind::contact;
    const bool asks_part = std::exchange(is_slow, false) && is_contact;
    Event asked = asks_part                   ? part_of_way(empty, event)
                  : is_contact && look_beyond ? beyond(event)
                                              : event;
    const Hit hit = contacts_.nearest(asked.disk, span_);
    if (!hit) {
      if (asks_part) {
        empty = asked.position;
        continue;
      }
      if (event.may_grow) {
        Event further = far_event(event.disk.radius);
        if (!(further.position > event.position)) further = far_event(0);
        if (further.position > event.position) {
          event = further;
          continue;
        }
      }
      const auto found = of_empty_disk(event);
      return found ? *found : left_open(event);
    }
    const std::uint32_t intruder = contacts_.owner(hit.site, asked.disk.center, span_);
    if (is_at_node(intruder)) return at_node(intruder);
    asked.site = intruder;
    const std::optional<Event> earlier = contact_before(asked);
    if (!earlier || !(earlier->position < asked.position)) {
      if (asks_part) continue;
      // A disk that is empty, and touched by what is beyond it, will do.
      if (!is_contact || !look_beyond) break;
      look_beyond = false;
      continue;
    }
    // The intruder's end touches the node's disk: a tie, not a later contact. (Next to arcs, that
    // does not tell.)
    if (contacts_.is_polygon() && is_at_node(earlier->site)) return at_node(earlier->site);
    is_slow = !asks_part && round >= slow_round &&
              earlier->position - empty > 0.5 * (asked.position - empty);
    look_beyond = earlier->position < event.position;
    event = *earlier;
  }
  return left_open(event);
}

bool EventSearch::is_in_point(const Event& event) const {
  return event.disk.radius <= as_good_as_point * context_.tolerance &&
         span_.left - span_.right > 2 && from_.radius > 0;
}

std::optional<Event> EventSearch::of_empty_disk(Event event) const {
  if (event.kind == Event::Kind::contact) {
    event.site = contacts_.owner(event.site, event.disk.center, span_);
    // Only the carrier was touched, short of the site, or a point whose other copy was before.
    if (!reaches(event) || !contacts_.faces(event.site, event.disk.center)) return std::nullopt;
  }
  // A foot has left its site: events on flat corners come in doubtful order.
  if (event.kind == Event::Kind::far || !contacts_.reaches(span_.right, event.disk) ||
      !contacts_.reaches(span_.left, event.disk))
    return std::nullopt;
  return event;
}

Event EventSearch::part_of_way(double empty, const Event& event) const {
  const double share = empty > low_ ? 0.5 : 0.125;
  Event part{Event::Kind::far, Hit::none, {}, empty + share * (event.position - empty)};
  part.disk = bisector_.disk_at(part.position, from_);
  return part;
}

Event EventSearch::beyond(const Event& contact) const {
  const Vec2 along = bisector_.tangent(contact.disk.center);
  const double speed = closing(contact.disk, site(contact.site), along);
  const double furthest = widest_window * contact.disk.radius;
  const double step = speed > 0 ? std::min(furthest, 0.5 * context_.tolerance / speed) : 0;
  Event event = contact;
  if (!(step > 0)) return event;
  event.disk.center = contact.disk.center + step * along;
  event.disk.radius = std::min(site::carrier_distance(bisector_.right, event.disk.center),
                               site::carrier_distance(bisector_.left, event.disk.center));
  event.position = bisector_.position(event.disk.center);
  return event;
}

double EventSearch::closing(const Disk& disk, const Site& third, Vec2 along) const {
  return dot(site::outward(bisector_.right, disk.center) - site::outward(third, disk.center),
             along);
}

std::optional<Event> EventSearch::contact_before(const Event& intruded) {
  const std::uint32_t i = intruded.site;
  const Site& intruder = site(i);
  if (const auto at_joint = contact_at_joint(i)) return at_joint;
  std::optional<Event> contact = contact_with(i, intruded.position);
  if (intruder.is_vertex() || (contact && reaches(*contact))) return contact;
  if (const auto other_side = contacts_.other_side(i)) {
    auto behind = contact_with(*other_side, i, intruded.position);
    if (behind && contacts_.reaches(i, behind->disk)) {
      behind->site = contacts_.owner(i, behind->disk.center, span_);
      if (contacts_.faces(behind->site, behind->disk.center)) return behind;
    }
  }
  // The carrier is touched short of the edge: one of its neighbours comes first.
  std::optional<Event> earliest;
  for (const std::uint32_t next : {i - 1, i + 1}) {
    if (next <= span_.right || next >= span_.left || element(next) == Element::bridge) continue;
    const auto on_next = contact_with(next, intruded.position);
    if (on_next && reaches(*on_next) &&
        on_next->position < (earliest ? *earliest : intruded).position)
      earliest = on_next;
  }
  if (earliest) return earliest;
  // Any disk that passes through the intruder comes earlier than one that it intrudes.
  const Vec2 place = site::foot(intruder, intruded.disk.center);
  const auto on_place = contact_with(site::make_vertex(place), i, intruded.position);
  return on_place ? on_place : contact;
}

Event EventSearch::left_open(Event event) const {
  for (const bool on_right : {true, false}) {
    const auto [own, next, other] = side(on_right);
    if (from_.radius > 0 && boundary_.is_smooth(std::min(own, next)) &&
        contacts_.touches_carrier(next, from_, context_.tolerance))
      return {on_right ? Event::Kind::pass_right : Event::Kind::pass_left, Hit::none, from_, low_};
  }
  event.kind = Event::Kind::none;
  return event;
}

}  // namespace medial::disks
