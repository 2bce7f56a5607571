#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "methods/exact/outline.h"

namespace medial::exact {

/// Bounds for the one disk that three sites touch in this counter-clockwise order, and which is
/// smaller than their own circles: proved to exist. None where that is not certain in this
/// precision. Where two or three of the sites are joined, it is the disk that touches their joint,
/// or the middle one's own circle.
template <class Real>
std::optional<DiskBounds<Real>> disk_bounds(const SiteLoops& outline,
                                            const std::array<std::uint32_t, 3>& sites);

/// Whether the foot of disk `to` lies further along the boundary on a site than that of `from`: 1,
/// -1, 0, or none where the bounds leave it open. Requires disks that touch the site.
template <class Real>
std::optional<int> further_along(const ExactSite& site, const DiskBounds<Real>& from,
                                 const DiskBounds<Real>& to);

/// Whether the foot of a disk's centre on the carrier of an edge may lie between the edge's ends:
/// false only where it surely lies beyond one of them. Always true for a vertex.
template <class Real>
bool may_have_foot(const ExactSite& site, const DiskBounds<Real>& disk);

/// Whether a disk keeps clear of a site, all of it and seen from either side: 1, reaches over it:
/// -1, or touches it, as far as the numbers can tell: 0. `touched`: vertices that the disk touches
/// anyway.
template <class Real>
int clearance(const ExactSite& site, const DiskBounds<Real>& disk,
              std::span<const Vec2> touched = {});

/// The disk that grows along a spoke until it touches a site's carrier; none where it never does.
template <class Real>
std::optional<DiskBounds<Real>> disk_along(const Spoke<Bounded<Real>>& spoke,
                                           const ExactSite& site);
/// The same from `foot` in a direction.
template <class Real>
std::optional<DiskBounds<Real>> disk_from(Vec2 foot, Vec2 direction, const ExactSite& site);

}  // namespace medial::exact
