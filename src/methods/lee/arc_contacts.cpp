#include "methods/lee/arc_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "site/tangent_disk.h"

namespace medial::lee {
namespace {

using Three = std::array<std::uint32_t, 3>;

struct InOrder {
  std::uint32_t before, after;
};
/// Two neighbours on the boundary; the last element of a list comes before its first one.
InOrder in_order(std::uint32_t a, std::uint32_t b) {
  const auto [i, j] = std::minmax(a, b);
  return j - i == 1 ? InOrder{i, j} : InOrder{j, i};
}

}  // namespace

/// Along a spoke, no foot moves; from a corner that is nearly flat, hardly any does. There the
/// distance from the joint orders the disks.
site::Bisector ArcContacts::bisector(std::uint32_t i, std::uint32_t j) const {
  site::Bisector bisector(site(j), site(i));
  const auto place = are_joined(i, j) ? std::optional(joint_of(i, j)) : flat_corner(i, j);
  if (!place) return bisector;
  bisector.reference = nullptr;
  bisector.direction = j - i == 1 ? place->normal : -place->normal;
  return bisector;
}

ArcContacts::Disks ArcContacts::disks_of(const Three& three) {
  Disks found;
  if (!add_at_joint(three, found)) add_tangent_disks(three, found);
  return found;
}

bool ArcContacts::touches(std::uint32_t i, const Disk& disk) const {
  const site::Site& s = site(i);
  if (s.is_vertex()) {
    const std::uint32_t before = elements_.before(i), after = i + 1;
    const Vec2 d = disk.center - s.point;
    if (dot(left_of(site(before).end_normal()), d) <= 0 && dot(site(after).direction, d) <= 0)
      return true;
    return site::gap(site(before), disk) >= -limits_.tolerance &&
           site::gap(site(after), disk) >= -limits_.tolerance;
  }
  if (disk.radius * s.curvature <= 1) {
    const double foot = site::carrier_parameter(s, disk.center);
    if (foot >= 0 && foot <= s.length) return true;
  }
  return std::abs(site::gap(site(i), disk)) <= limits_.tolerance;
}

bool ArcContacts::is_tied(std::uint32_t i, const Disk& disk) const {
  return std::abs(site::gap(site(i), disk)) <= tie() &&
         std::abs(site::carrier_distance(site(i), disk.center) - disk.radius) <= limits_.tolerance;
}

bool ArcContacts::are_joined(std::uint32_t a, std::uint32_t b) const {
  const auto [i, j] = std::minmax(a, b);
  return elements_.beside(i, j) == Beside::smooth;
}

site::SmoothPlace ArcContacts::joint_of(std::uint32_t a, std::uint32_t b) const {
  const auto [before, after] = in_order(a, b);
  return site::smooth_place(site(before), site(after));
}

/// The point at which two consecutive edges meet almost collinearly, with the mean of their
/// normals.
std::optional<site::SmoothPlace> ArcContacts::flat_corner(std::uint32_t a, std::uint32_t b) const {
  constexpr double flat = 0.999;
  const auto [i, j] = in_order(a, b);
  const site::Site &before = site(i), &after = site(j);
  if (before.is_vertex() || after.is_vertex() || !(before.is_arc() || after.is_arc()) ||
      !site::meets(before, after))
    return std::nullopt;
  const Vec2 first = before.end_normal(), second = after.normal();
  if (!(dot(first, second) > flat)) return std::nullopt;
  const Vec2 sum = first + second;
  return site::SmoothPlace{after.point, (1 / norm(sum)) * sum};
}

/// The disk that touches all of a convex arc.
Disk ArcContacts::own_circle(std::uint32_t arc) const {
  const double radius = 1 / site(arc).curvature;
  return {site(arc).point + radius * site(arc).normal(), radius};
}

/// The disk that touches the boundary at a point, and the carrier of another element.
std::optional<Disk> ArcContacts::disk_at(const site::SmoothPlace& place, std::uint32_t other,
                                         double limit) const {
  const double radius = site::tangent_radius(place.point, place.normal, site(other));
  if (!(radius <= limit)) return std::nullopt;
  return Disk{place.point + radius * place.normal, radius};
}

/// Adds the disks that touch three elements of which two or more are joined smoothly: the own
/// circle of an element that is joined to both others and is at least as curved, up to rounding; or
/// a disk at a joint, no larger than the circles of the arcs joined there. Returns false if none
/// are joined.
bool ArcContacts::add_at_joint(const Three& three, Disks& found) const {
  std::size_t joined = 0, apart = 0, other = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool are = are_joined(three[(k + 1) % 3], three[(k + 2) % 3]);
    joined += are ? 1 : 0;
    (are ? other : apart) = k;
  }
  if (joined == 0) return false;
  const std::size_t alone = joined == 1 ? other : apart;
  const std::uint32_t a = three[(alone + 1) % 3], b = three[(alone + 2) % 3], c = three[alone];
  if (joined > 1) {
    const double curvature = site(c).curvature;
    if (!(curvature > 0)) return true;
    const Disk own = own_circle(c);
    const auto is_no_rounder = [&](std::uint32_t i) {
      return site(i).curvature <= curvature || is_tied(i, own);
    };
    if (is_no_rounder(a) && is_no_rounder(b)) found.add(own);
    return true;
  }
  const std::uint32_t rounder = site(a).curvature < site(b).curvature ? b : a;
  const bool is_convex = elements_.is_convex_arc(rounder);
  const Disk own = is_convex ? own_circle(rounder) : Disk{};
  const double limit =
      is_convex ? std::min(limits_.radius_limit, own.radius) : limits_.radius_limit;
  const auto disk = disk_at(joint_of(a, b), c, limit);
  if (disk && touches(c, *disk))
    found.add(*disk);
  else if (is_convex && is_tied(c, own))
    found.add(own);
  return true;
}

/// Adds the disks that touch three elements, no two of which are joined smoothly.
void ArcContacts::add_tangent_disks(const Three& three, Disks& found) {
  for (const std::uint32_t i : three) {
    if (!elements_.is_convex_arc(i)) continue;
    const Disk own = own_circle(i);
    if (std::all_of(three.begin(), three.end(), [&](std::uint32_t k) { return is_tied(k, own); }))
      found.add(own);
  }
  ++statistics_.apollonius;
  const auto disks = site::tangent_disks(site(three[0]), site(three[1]), site(three[2]));
  for (std::size_t i = 0; i < disks.count; ++i)
    if (disks.disk[i].radius <= limits_.radius_limit) add_if_touching(disks.disk[i], three, found);
  // If carriers are nearly tangent, rounding may have lost all solutions.
  for (std::size_t k = 0; k < 3 && found.count == 0; ++k)
    if (const auto place = flat_corner(three[(k + 1) % 3], three[(k + 2) % 3]))
      if (const auto disk = disk_at(*place, three[k], limits_.radius_limit))
        add_if_touching(*disk, three, found);
}

void ArcContacts::add_if_touching(Disk disk, const Three& three, Disks& found) {
  site::polish(disk, site(three[0]), site(three[1]), site(three[2]), tie(), limits_.tolerance,
               statistics_.precision_retries);
  if (std::all_of(three.begin(), three.end(), [&](std::uint32_t k) { return touches(k, disk); }))
    found.add(disk);
}

}  // namespace medial::lee
