#include "methods/disks/planar_contacts.h"

#include <cmath>

namespace medial::disks {

bool PlanarContacts::faces(std::uint32_t i, Vec2 c) const {
  if (element(i) == Element::edge) return faces_edge(site(i), c);
  const auto bound = [&](std::uint32_t beside) {
    if (element(beside) == Element::bridge) return bridge_direction(i, beside);
    return beside < i ? site(beside).end_normal() : site(beside).normal();
  };
  const bool all_around = element(i - 1) == Element::bridge && element(i + 1) == Element::bridge &&
                          boundary_.originals[i - 1] == boundary_.originals[i + 1];
  return all_around || in_wedge(bound(i - 1), bound(i + 1), c - site(i).point);
}

std::uint32_t PlanarContacts::owner(std::uint32_t i, Vec2 center, const Span& span) const {
  if (faces(i, center)) return i;
  const double reach = std::sqrt(site::squared_distance(site(i), center));
  std::vector<std::uint32_t> together;
  context_.tree.within(center, reach + 2 * context_.tolerance, span.right + 1, span.left - 1,
                       together);
  for (const std::uint32_t other : together)
    if (in_one_place(other, i, center, reach) && faces(other, center)) return other;
  return i;
}

std::optional<site::Site> PlanarContacts::other_side(std::uint32_t i) const {
  return site::reversed(site(i));
}

std::unique_ptr<Contacts> contacts_with(const WalkContext& context, Statistics& statistics) {
  if (context.boundary.sides == Sides::both)
    return std::make_unique<PlanarContacts>(context, statistics);
  return std::make_unique<Contacts>(context, statistics);
}

}  // namespace medial::disks
