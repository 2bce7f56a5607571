#pragma once

#include <array>
#include <cstdint>
#include <optional>

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

}  // namespace medial::exact
