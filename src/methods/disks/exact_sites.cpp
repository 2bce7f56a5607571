#include "methods/disks/exact_sites.h"

namespace medial::disks {

const exact::SiteLoops& ExactSites::outline() const {
  std::call_once(once_, [&] {
    outline_ = make_();
    before_.resize(outline_.next.size());
    for (std::uint32_t i = 0; i < before_.size(); ++i) before_[outline_.next[i]] = i;
  });
  return outline_;
}

std::optional<std::uint32_t> ExactSites::joined_before(std::uint32_t site) const {
  const std::uint32_t before = outline().next.empty() ? outline_.before(site) : before_[site];
  return outline_.joined(before, site) ? std::optional(before) : std::nullopt;
}

std::optional<ExactSites::Touch> ExactSites::first_touch(
    Vec2 foot, std::span<const std::uint32_t> sites) const {
  return outline().is_wide ? first_touch_in<exact::Wide>(foot, sites)
                           : first_touch_in<exact::Precise>(foot, sites);
}

template <class Real>
std::optional<ExactSites::Touch> ExactSites::first_touch_in(
    Vec2 foot, std::span<const std::uint32_t> sites) const {
  std::optional<exact::DiskBounds<Real>> best;
  std::uint32_t touched = 0;
  for (const std::uint32_t site : sites) {
    const exact::ExactSite exact_site = this->site(site);
    const auto disk = exact::disk_from<Real>(foot, outreach, exact_site);
    if (!disk || !exact::may_have_foot(exact_site, *disk)) continue;
    if (best && boundary.is_same(site, touched)) {
      // Pieces of one arc: the disk is the same, and touches the nearest one.
      const double radius = static_cast<double>(disk->radius.value);
      const Vec2 center = foot + radius * outreach;
      if (site::squared_distance(boundary.sites[site], center) <
          site::squared_distance(boundary.sites[touched], center))
        touched = site;
      continue;
    }
    const int smaller = best ? (best->radius - disk->radius).sign().value_or(0) : 1;
    // Where an edge is touched in its end, so is the vertex there, which stands for both.
    if (smaller < 0 || (smaller == 0 && boundary.elements[site] == Element::edge)) continue;
    best = disk;
    touched = site;
  }
  if (!best) return std::nullopt;
  return Touch{touched, static_cast<double>(best->radius.value)};
}

}  // namespace medial::disks
