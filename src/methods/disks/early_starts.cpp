#include "methods/disks/early_starts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "methods/disks/certainty.h"
#include "site/tangent_disk.h"

namespace medial::disks {
namespace {

using site::Site;
using Hit = Contacts::Hit;

/// How many disks are tried for each early start: most touch what is near along the boundary.
constexpr int most_tries = 12;
/// A run gets no early start if none of its first places has one: on coasts, no place has, and each
/// costs about 120 searches.
constexpr std::size_t enough_in_vain = 4;
/// How many tolerances away everything else is. The disk is off by four at most, and disks of the
/// same edge nearer to where the walk comes from reach no further beyond the two feet.
constexpr double clear_tolerances = 256;
/// In a disk that touches many sites a search takes time in proportion to them: a run that has such
/// a disk gets no more early starts.
constexpr std::size_t crowd = 16;
/// The cosine of the least angle between the two normals where a disk touches.
constexpr double turned = 0.5;

std::pair<std::uint32_t, std::uint32_t> sites_of(const EarlyStart& start) {
  return {start.right, start.left};
}

/// Finds early starts in one run.
class Finder {
 public:
  Finder(const WalkContext& context, std::uint32_t component)
      : context_(context), run_(context.boundary.runs[component]), component_(component) {}

  /// Adds some, each with `least` sites between its two and beside them.
  void find(std::uint32_t least, std::vector<EarlyStart>& starts) {
    bool has_some = false;
    std::size_t places = 0;
    for (std::uint64_t place = run_.first + std::uint64_t{least};
         place + least < run_.last && !is_crowded_ && (has_some || places < enough_in_vain);
         place += 2 * std::uint64_t{least}, ++places)
      if (const auto start = near(static_cast<std::uint32_t>(place), least)) {
        starts.push_back(*start);
        has_some = true;
      }
  }

 private:
  const Site& site(std::uint32_t i) const { return context_.boundary.sites[i]; }
  double clear() const { return clear_tolerances * context_.joints; }
  bool is_edge(std::uint32_t i) const { return context_.boundary.elements[i] == Element::edge; }

  std::optional<EarlyStart> near(std::uint32_t own, std::uint32_t least) {
    for (int i = 0; i < most_tries && !is_crowded_; ++i) {
      while (own < run_.last && !is_edge(own)) ++own;
      if (own + least > run_.last) break;
      auto [disk, touched] = grown_to_next(own);
      if (touched == Hit::none) {
        std::tie(disk, touched) = grown_at(own);
        is_crowded_ = !context_.tree.few_within(disk.center, disk.radius + clear(), crowd, near_);
      }
      if (touched == Hit::none || is_crowded_) break;
      const auto [right, left] = std::minmax(own, touched);
      const std::uint32_t between = left - right, beside = run_.last - run_.first - between;
      if (between >= least && beside >= least && is_sure(own, touched, disk))
        return EarlyStart{component_, right, left, disk,
                          4 * context_.tolerance + Certainty::rounding};
      // Further on, disks cut off more sites.
      own = between < least ? left + 1 + between / 2 : own + 1;
    }
    return std::nullopt;
  }

  /// The same as grown_at() where that surely touches the next edge. Nothing else is near then. (In
  /// a star, a large disk reaches over thousands of teeth.)
  std::pair<Disk, std::uint32_t> grown_to_next(std::uint32_t own) {
    const Vec2 foot = site(own).at(0.5 * site(own).length), normal = site(own).normal();
    for (const std::uint32_t next : {own - 1, own + 1}) {
      if (next < run_.first || next > run_.last || !is_edge(next) ||
          dot(normal, site(next).normal()) > turned)
        continue;
      const double radius = site::touching_radius(foot, normal, site(next));
      if (!(radius <= context_.radius_limit)) continue;
      const Disk disk{foot + radius * normal, radius};
      if (context_.tree.few_within(disk.center, radius + clear(), 2, near_) && near_.size() == 2 &&
          (near_[0] == next || near_[1] == next))
        return {disk, next};
    }
    return {Disk{}, Hit::none};
  }

  /// The disk that grows in the middle of an edge until it touches something, and what that is.
  std::pair<Disk, std::uint32_t> grown_at(std::uint32_t own) const {
    const Vec2 foot = site(own).at(0.5 * site(own).length), normal = site(own).normal();
    const auto disk_of = [&](double radius) { return Disk{foot + radius * normal, radius}; };
    Disk disk = disk_of(context_.radius_limit);
    std::uint32_t touched = Hit::none;
    while (const Hit hit = context_.tree.nearest(disk.center, disk.radius - context_.tolerance,
                                                 run_.first, run_.last)) {
      const double smaller = site::touching_radius(foot, normal, site(hit.site));
      if (!(smaller < disk.radius)) break;
      touched = hit.site;
      disk = disk_of(smaller);
    }
    return {disk, touched};
  }

  /// Whether the disk touches these two edges, inside them, and nothing else. Feet far apart on it
  /// leave no more than rounding open of where it is.
  bool is_sure(std::uint32_t own, std::uint32_t touched, const Disk& disk) const {
    if (near_.size() != 2 || !is_edge(touched)) return false;
    const Site &edge = site(own), &other = site(touched);
    const double along = dot(disk.center - other.point, other.direction);
    return dot(edge.normal(), other.normal()) <= turned && 0.5 * edge.length > clear() &&
           along > clear() && along < other.length - clear() &&
           std::abs(site::carrier_distance(other, disk.center) - disk.radius) <= context_.tolerance;
  }

  const WalkContext& context_;
  const Boundary::SiteRange& run_;
  const std::uint32_t component_;
  bool is_crowded_ = false;
  std::vector<std::uint32_t> near_;  ///< to the last disk
};

}  // namespace

std::vector<EarlyStart> early_starts(const WalkContext& context, std::uint32_t least) {
  std::vector<EarlyStart> starts;
  if (context.boundary.has_arcs || context.boundary.sides == Sides::both) return starts;
  for (std::uint32_t component = 0; component < context.boundary.runs.size(); ++component)
    if (!context.is_in_precise(component)) Finder(context, component).find(least, starts);
  ranges::sort(starts, {}, sites_of);
  const auto twice = std::unique(starts.begin(), starts.end(), [](const auto& a, const auto& b) {
    return sites_of(a) == sites_of(b);
  });
  starts.erase(twice, starts.end());
  return starts;
}

const EarlyStart* early_start_of(const Span& span, const std::vector<EarlyStart>& starts) {
  const std::pair sites(span.right, span.left);
  const auto found = ranges::lower_bound(starts, sites, {}, sites_of);
  return found != starts.end() && sites_of(*found) == sites ? &*found : nullptr;
}

}  // namespace medial::disks
