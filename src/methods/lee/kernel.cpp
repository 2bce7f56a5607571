#include "methods/lee/kernel.h"

#include <algorithm>
#include <limits>

#include "methods/disks/boundary.h"
#include "methods/exact/outline.h"
#include "methods/exact/touch.h"

namespace medial::lee {
namespace {

using exact::Precise;
using Vector = PreciseSite::Vector;

Vector precise(Vec2 p) { return {Precise(p.x), Precise(p.y)}; }
Precise size_of(const Vector& a) { return sqrt(dot(a, a)); }

PreciseSite whole(const exact::ExactSite& site) {
  if (site.is_vertex()) return {precise(site.start), {}, Precise(0), true};
  const Vector along = precise(site.end) - precise(site.start);
  const Precise length = size_of(along);
  return {precise(site.start), (1 / length) * along, length, false};
}

Precise parameter(const PreciseSite& site, const Vector& c) {
  const Precise s = dot(site.direction, c - site.point);
  return s < 0 ? Precise(0) : s > site.length ? site.length : s;
}
Vector foot(const PreciseSite& site, const Vector& c) {
  return site.point + parameter(site, c) * site.direction;
}

/// Half of a disk's tangent at its foot on a site, before the foot or from it on.
PreciseSite half_tangent(const InPrecise::Disk& disk, const PreciseSite& touched, bool is_before) {
  const Vector at = foot(touched, disk.center);
  const Vector normal = (1 / disk.radius) * (disk.center - at);
  const Vector direction{normal.y, -normal.x};
  return {is_before ? at - disk.radius * direction : at, direction, disk.radius, false};
}

/// The disk of a bridge from a hole's furthest vertex to what it touches; `about` where it touches
/// none.
InPrecise::Disk precise_bridge(Vec2 vertex, const exact::ExactSite& touched, const Disk& about) {
  const auto disk = exact::disk_from<exact::Precise>(vertex, disks::outreach, touched);
  if (!disk) return {precise(about.center), Precise(about.radius)};
  return {{disk->center.x.value, disk->center.y.value}, disk->radius.value};
}

}  // namespace

PreciseSites precise_sites(const Problem& problem, const Elements& elements) {
  const exact::SiteLoops outline = exact::outline_of(problem, problem.numbers());
  PreciseSites all;
  all.elements.reserve(elements.size());
  for (const std::uint32_t site : elements.originals)
    all.elements.push_back(site == none ? PreciseSite{} : whole(outline.sites[site]));
  // A bridge passes into its hole, at the hole's furthest vertex, and later out of it.
  std::vector<InPrecise::Disk> of_bridge(elements.passages.size() / 2);
  std::vector<bool> is_known(of_bridge.size());
  for (std::size_t i = 0; i < elements.passages.size(); ++i) {
    const auto [begin, bridge] = elements.passages[i];
    if (!is_known[bridge])
      of_bridge[bridge] = precise_bridge(outline.sites[elements.originals[begin + 1]].start,
                                         outline.sites[elements.originals[begin - 2]],
                                         elements.disks_of_passages[i]);
    is_known[bridge] = true;
    all.passages.push_back(of_bridge[bridge]);
  }
  // What a bridge touches ends there, and begins again after it.
  for (std::size_t i = 0; i < all.passages.size(); ++i) {
    const std::uint32_t begin = elements.passages[i].begin;
    const InPrecise::Disk& disk = all.passages[i];
    PreciseSite &before = all.elements[begin - 2], &after = all.elements[begin + 1];
    all.elements[begin - 1] = half_tangent(disk, before, false);
    all.elements[begin] = half_tangent(disk, after, true);
    if (!before.is_vertex()) before.length = parameter(before, disk.center);
    if (after.is_vertex()) continue;
    const Precise from = parameter(after, disk.center);
    after.point = after.point + from * after.direction;
    after.length -= from;
  }
  return all;
}

Vector direction_along(const PreciseSite& right, const PreciseSite& left) {
  if (right.is_vertex() && left.is_vertex()) {
    const Vector chord = left.point - right.point;
    return {chord.y, -chord.x};
  }
  Vector difference = right.direction - left.direction;
  if (dot(difference, difference) > 0) return difference;
  // Pieces of one segment, around what a bridge led to.
  return dot(right.direction, right.point - left.point) > 0 ? right.normal() : -right.normal();
}

Precise squared_distance(const PreciseSite& site, const Vector& c) {
  const Vector d = c - foot(site, c);
  return dot(d, d);
}

Precise carrier_distance(const PreciseSite& site, const Vector& c) {
  return site.is_vertex() ? size_of(c - site.point) : cross(site.direction, c - site.point);
}

Precise tangent_radius(const Vector& foot, const Vector& normal, const PreciseSite& site) {
  const Precise infinite(std::numeric_limits<double>::max());
  const Vector d = foot - site.point;
  if (site.is_vertex()) {
    const Precise ahead = -2 * dot(normal, d);
    return ahead > 0 ? Precise(dot(d, d) / ahead) : infinite;
  }
  const Precise height = cross(site.direction, d), closing = 1 - dot(normal, site.normal());
  return height >= 0 && closing > InPrecise::tolerance ? Precise(height / closing) : infinite;
}

PreciseDisks tangent_disks(const PreciseSite& a, const PreciseSite& b, const PreciseSite& c) {
  using Carrier = site::apollonius::Carrier<Precise>;
  const auto carrier = [](const PreciseSite& site) {
    return Carrier{site.point, site.normal(), Precise(site.vertex ? 1 : 0),
                   Precise(site.vertex ? 0 : 1), site.vertex};
  };
  const Carrier carriers[] = {carrier(a), carrier(b), carrier(c)};
  return site::apollonius::solve<Precise>({&carriers[0], &carriers[1], &carriers[2]});
}

}  // namespace medial::lee
