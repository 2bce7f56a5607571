#include "methods/exact/divide.h"

#include <algorithm>
#include <array>
#include <utility>

#include "methods/exact/disk_bounds.h"
#include "methods/exact/touch.h"

namespace medial::exact {
namespace {

/// Whether one disk may touch three sites in this counter-clockwise order, on convex arcs between
/// their ends. Of joined sites it touches the joint.
bool may_touch(const SiteLoops& outline, const std::array<std::uint32_t, 3>& sites) {
  const auto disk = disk_bounds<Precise>(outline, sites, {});
  if (!disk) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t site = sites[k];
    if (outline.joined(site, sites[(k + 1) % 3]) || outline.joined(sites[(k + 2) % 3], site))
      continue;
    const ExactSite own = outline.sites[site];
    if (own.bulge > 0 && !may_have_foot(own, *disk)) return false;
  }
  return true;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> divide(const SiteLoops& outline,
                                               std::span<const std::uint32_t> sites,
                                               Decisions& decisions) {
  std::vector<std::vector<std::uint32_t>> nodes;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides{
      {0, static_cast<std::uint32_t>(sites.size() - 1)}};
  // Convex arcs are not touched by disks larger than their own circles: not every three sites have
  // a disk then.
  const bool some_fit_into_circles = std::any_of(
      sites.begin(), sites.end(), [&](std::uint32_t i) { return outline.sites[i].bulge > 0; });
  while (!sides.empty()) {
    const std::uint32_t low = sides.back().first, high = sides.back().second;
    sides.pop_back();
    if (high < low + 2) continue;
    // Those met first, all by one disk; and of a run of sites that all bend away from the disk,
    // each joined to the next, which it can touch in one place only: all of the run touches nearly
    // one disk, so it turns by less than a full turn, and two places would take more.
    std::vector<std::uint32_t> first, run;
    const auto offer = [&](std::vector<std::uint32_t>& best,
                           const std::vector<std::uint32_t>& next) {
      const Sign sign = best.empty() ? Sign::positive
                                     : in_disk(outline, sites[low], sites[best.back()],
                                               sites[next.front()], sites[high], decisions);
      if (sign == Sign::positive) best.clear();
      if (sign == Sign::positive || sign == Sign::zero)
        best.insert(best.end(), next.begin(), next.end());
      return sign;
    };
    bool passed = false;
    for (std::uint32_t i = low + 1; i < high; ++i) {
      if (some_fit_into_circles && high > low + 2)
        if (!may_touch(outline, {sites[low], sites[i], sites[high]})) continue;
      const auto bends_away = [&](std::uint32_t site) { return !(outline.sites[site].bulge > 0); };
      if (!run.empty() && (passed || run.back() + 1 == i) &&
          outline.joined(sites[i - 1], sites[i]) && bends_away(sites[i - 1]) &&
          bends_away(sites[i])) {
        passed = passed || offer(run, {i}) == Sign::negative;
        continue;
      }
      if (!run.empty()) offer(first, run);
      run.assign(1, i);
      passed = false;
    }
    if (!run.empty()) offer(first, run);
    if (first.empty()) first.push_back(low + 1);
    std::vector<std::uint32_t> node{low};
    node.insert(node.end(), first.begin(), first.end());
    node.push_back(high);
    for (std::size_t i = 1; i < node.size(); ++i) sides.emplace_back(node[i - 1], node[i]);
    nodes.push_back(std::move(node));
  }
  return nodes;
}

}  // namespace medial::exact
