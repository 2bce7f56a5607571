#include "methods/disks/node_distance.h"

#include <type_traits>
#include <utility>

#include "base/compat.h"
#include "methods/disks/certainty.h"

namespace medial::disks {

bool NodeDistance::is_short() const {
  const bool in_double = is_short(a_.disk, b_.disk, 0);
  if (is_short(a_.disk, b_.disk, rounding) == is_short(a_.disk, b_.disk, -rounding))
    return in_double;
  for (const bool first : {true, false}) {
    const auto near = is_within([&](const auto& one, const auto& other) {
      return std::remove_cvref_t<decltype(one.radius)>(short_edge) * (first ? one : other).radius;
    });
    if (!near) return in_double;
    if (!*near) return false;
  }
  return true;
}

std::optional<bool> NodeDistance::is_within_in_double(double length, double tolerance) const {
  constexpr double surely = 16;  // tolerances
  const double way = distance(a_.disk.center, b_.disk.center);
  if (way > surely * tolerance) return false;
  const bool known = std::abs(way - length) > error_of(a_) + error_of(b_);
  return known ? std::optional(way <= length) : std::nullopt;
}

bool NodeDistance::is_within(double length) const {
  const auto near = is_within([&](const auto& one, const auto&) {
    return std::remove_cvref_t<decltype(one.radius)>(length);
  });
  return near ? *near : distance(a_.disk.center, b_.disk.center) <= length;
}

/// Whether the centres are no further apart than `most` of the disks; none where that is not known.
template <class Most>
std::optional<bool> NodeDistance::is_within(const Most& most) const {
  if (!three_of(a_) || !three_of(b_)) return std::nullopt;
  const auto near = is_within_in<Twofold>(most);
  return near ? near : is_within_in<exact::Precise>(most);
}

template <class Real, class Most>
std::optional<bool> NodeDistance::is_within_in(const Most& most) const {
  const auto from = disk_in<Real>(a_), to = from ? disk_in<Real>(b_) : std::nullopt;
  if (!to) return std::nullopt;
  const auto way = to->center - from->center;
  const Bounded<Real> bound = most(*from, *to);
  const auto sign = (bound * bound - dot(way, way)).sign();
  return sign ? std::optional(*sign >= 0) : std::nullopt;
}

/// The sites of a node that touches three; of several pieces of one site, one.
NodeDistance::ThreeSites NodeDistance::three_of(const TouchingNode& node) const {
  const Originals& originals = exact_.boundary.originals;
  std::array<std::uint32_t, 3> sites;
  std::size_t count = 0;
  for (const Touch& contact : node.contacts) {
    const std::uint32_t own = originals[contact.site];
    const auto known = std::span(sites).first(count);
    if (ranges::any_of(known, [&](std::uint32_t s) { return originals[s] == own; })) continue;
    if (count == 3) return std::nullopt;
    sites[count++] = contact.site;
  }
  return count == 3 ? std::optional(sites) : std::nullopt;
}

/// How far a node's exact disk may be from the one in double; nothing else is known of one that
/// touches more than three sites.
double NodeDistance::error_of(const TouchingNode& node) const {
  const auto sites = three_of(node);
  if (!sites) return 0;
  const Boundary& boundary = exact_.boundary;
  const auto [a, b, c] = *sites;
  const auto joins = [&](std::uint32_t i, std::uint32_t j) {
    return i + 1 == j && boundary.is_smooth(i);
  };
  return joins(a, b)   ? Certainty::error_at_joint(boundary, a, b, c, node.disk)
         : joins(b, c) ? Certainty::error_at_joint(boundary, b, c, a, node.disk)
                       : Certainty::error_of_three(boundary, *sites, node.disk);
}

/// The disk of a node that touches three sites.
template <class Real>
std::optional<exact::DiskBounds<Real>> NodeDistance::disk_in(const TouchingNode& node) const {
  auto sites = *three_of(node);
  // Where pieces lie on two sides of a bridge their order is open.
  for (int order = 0; order < 2; ++order, std::swap(sites[1], sites[2])) {
    const auto disk = exact_.disk_of<Real>(sites);
    if (!disk) continue;
    const Vec2 center{static_cast<double>(disk->center.x.value),
                      static_cast<double>(disk->center.y.value)};
    constexpr double of_radius = 0.125, apart = 0x1p-48;
    if (distance(center, node.disk.center) <= of_radius * node.disk.radius + apart) return disk;
  }
  return std::nullopt;
}

}  // namespace medial::disks
