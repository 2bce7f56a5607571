#include "methods/disks/contacts.h"

#include <cmath>
#include <numbers>

namespace medial::disks {
namespace {

/// The angle from one direction to another, clockwise.
double turn(Vec2 from, Vec2 to) { return std::atan2(-cross(from, to), dot(from, to)); }

}  // namespace

bool Contacts::faces(std::uint32_t i, Vec2 c) const {
  if (element(i) == Element::edge) return faces_edge(site(i), c);
  const auto bound = [&](std::uint32_t beside) {
    if (element(beside) == Element::bridge) return bridge_direction(i, beside);
    return beside < i ? site(beside).end_normal() : site(beside).normal();
  };
  const bool all_around = element(i - 1) == Element::bridge && element(i + 1) == Element::bridge &&
                          boundary_.originals[i - 1] == boundary_.originals[i + 1];
  return all_around || in_wedge(bound(i - 1), bound(i + 1), c - site(i).point);
}

std::uint32_t Contacts::facing(std::uint32_t i, Vec2 center, const Span& span) const {
  if (faces(i, center)) return i;
  const double reach = std::sqrt(site::squared_distance(site(i), center));
  context_.tree.within(center, reach + 2 * context_.tolerance, span.right + 1, span.left - 1,
                       together_);
  for (const std::uint32_t other : together_)
    if (in_one_place(other, i, center, reach) && faces(other, center)) return other;
  return i;
}

std::uint32_t Contacts::owner(std::uint32_t i, Vec2 center, const Span& span) const {
  if (boundary_.two_sided) return facing(i, center, span);
  if (element(i) == Element::edge) {
    // At an end that is a vertex site or a smooth joint, what goes on from there is touched.
    const double s = site::foot_parameter(site(i), center);
    if (s <= 0 && i - 1 > span.right && boundary_.is_smooth(i - 1))
      --i;
    else if (s >= site(i).length && i + 1 < span.left && boundary_.is_smooth(i))
      ++i;
  }
  if (element(i) != Element::vertex || context_.bridges.empty()) return i;
  // Normals turn to the right along a vertex. A vertex with several bridges takes several steps.
  std::uint32_t copy = i;
  for (std::size_t step = 0; step <= context_.bridges.size(); ++step) {
    const Vec2 to = center - site(copy).point;
    std::uint32_t next = copy;
    // An outer loop without a convex corner may begin with a vertex, which no bridge stands before.
    if (copy > 0 && element(copy - 1) == Element::bridge &&
        cross(bridge_direction(copy, copy - 1), to) > 0)
      next = other_copy(copy - 1, copy);
    else if (copy + 1 < boundary_.sites.size() && element(copy + 1) == Element::bridge &&
             cross(to, bridge_direction(copy, copy + 1)) > 0)
      next = other_copy(copy + 1, copy);
    if (next == copy) break;
    copy = next;
  }
  return copy > span.right && copy < span.left ? copy : i;
}

/// From a vertex towards the centre of the bridge beside it.
Vec2 Contacts::bridge_direction(std::uint32_t vertex, std::uint32_t bridge) const {
  return context_.bridges[boundary_.originals[bridge]].disk.center - site(vertex).point;
}

/// The copy of a vertex on the other side of the bridge at place `bridge`, next to which it stands.
std::uint32_t Contacts::other_copy(std::uint32_t bridge, std::uint32_t vertex) const {
  const auto [first, second] = boundary_.bridge_places[boundary_.originals[bridge]];
  if (first == second) return vertex;  // the boundary ends there
  const bool on_hole = vertex > first && vertex < second;
  if (bridge == first) return on_hole ? second - 1 : second + 1;
  return on_hole ? first + 1 : first - 1;
}

bool Contacts::touches(std::uint32_t i, const Disk& disk, double slack) const {
  if (std::abs(std::sqrt(site::squared_distance(site(i), disk.center)) - disk.radius) > slack)
    return false;
  if (site(i).is_vertex() || touches_all(i, disk)) return true;
  const double s = site::carrier_parameter(site(i), disk.center);
  if (s > 0 && s < site(i).length) return true;
  // At a smooth joint both touch.
  const std::uint32_t end = s > 0 ? i : i - 1;
  return boundary_.has_arcs && element(end) == element(end + 1) && boundary_.is_smooth(end);
}

bool Contacts::touches_all(std::uint32_t i, const Disk& disk) const {
  const site::Site& arc = site(i);
  // On a much flatter arc the disk would have to be tiny.
  if (!(arc.curvature * disk.radius > 0.5)) return false;
  const auto on_disk = [&](Vec2 p) {
    return std::abs(distance(p, disk.center) - disk.radius) <= 2 * context_.tolerance;
  };
  return on_disk(arc.point) && on_disk(arc.end()) && on_disk(arc.at(0.5 * arc.length));
}

bool Contacts::is_reflex_chain(const Span& span) const {
  if (span.left - span.right > longest_flat_chain || site(span.right).curvature > 0) return false;
  constexpr double almost_half = 3;  // of a turn: pi, less room for rounding
  double turned = 0;
  Vec2 before = site(span.right).end_normal();
  for (std::uint32_t i = span.right; i < span.left; ++i) {
    if (!boundary_.is_smooth(i)) return false;
    const site::Site& next = site(i + 1);
    if (next.curvature > 0) return false;
    if (next.is_vertex()) continue;
    if (!site(span.right).is_vertex() || i > span.right) turned += turn(before, next.normal());
    before = next.end_normal();
    if (i + 1 < span.left) turned += turn(next.normal(), before);
  }
  return turned < almost_half;
}

bool Contacts::are_distinct(std::uint32_t first, std::uint32_t second, double angle,
                            const Disk& disk) const {
  if (angle >= distinct_contacts) return true;
  if (!(angle > 0) || boundary_.two_sided || site(first).is_arc() || site(second).is_arc())
    return false;
  const double apart = distinct_feet * context_.tolerance;
  return squared_norm(site::foot(site(second), disk.center) -
                      site::foot(site(first), disk.center)) > apart * apart;
}

const std::vector<std::uint32_t>& Contacts::touched_between(const Span& span, const Disk& disk,
                                                            bool all_around) {
  ++statistics_.queries;
  context_.tree.within(disk.center, disk.radius + context_.tolerance, span.right + 1, span.left - 1,
                       touched_);
  if (touched_.empty()) return touched_;
  // Along the boundary the contacts go around the disk counter-clockwise. What comes out of order
  // is another copy of a vertex that was touched before.
  // An arc touched all along counts from the first of its points to the last.
  const auto foot_on = [&](std::uint32_t i, double share) {
    return touches_all(i, disk) ? site(i).at(share * site(i).length)
                                : site::foot(site(i), disk.center);
  };
  const Vec2 start = foot_on(span.right, 0) - disk.center;
  const auto angle_of = [&](std::uint32_t i, double share) {
    const Vec2 to = foot_on(i, share) - disk.center;
    const double angle = std::atan2(cross(start, to), dot(start, to));
    return angle > 0 ? angle : angle + 2 * std::numbers::pi;
  };
  const double end_angle = all_around ? 2 * std::numbers::pi : angle_of(span.left, 1);
  double angle_before = 0;
  std::uint32_t before = span.right;
  std::size_t kept = 0;
  for (const std::uint32_t hit : touched_) {
    if (boundary_.two_sided && !faces(hit, disk.center)) continue;
    const std::uint32_t i = boundary_.two_sided ? hit : owner(hit, disk.center, span);
    if (i <= before || i >= span.left || !touches(i, disk, context_.tolerance)) continue;
    const double angle = angle_of(i, 0.5);
    if (!are_distinct(before, i, angle - angle_before, disk) ||
        !are_distinct(i, span.left, end_angle - angle, disk))
      continue;
    touched_[kept++] = before = i;
    angle_before = angle;
  }
  touched_.resize(kept);
  return touched_;
}

void Contacts::split(const Span& span, const Disk& disk, std::uint32_t sure, bool all_around,
                     std::vector<Span>& parts) {
  parts.clear();
  std::uint32_t before = span.right;
  for (const std::uint32_t i : touched_between(span, disk, all_around)) {
    parts.push_back({before, i, span.node});
    before = i;
  }
  if (parts.empty()) {
    if (sure > span.right && sure < span.left) {
      parts.push_back({span.right, sure, span.node});
      before = sure;
    } else if (!touches_all(span.right, disk) && !touches_all(span.left, disk)) {
      return;
    }
  }
  parts.push_back({before, span.left, span.node});
}

}  // namespace medial::disks
