#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "medial/axis.h"
#include "methods/exact/outline.h"

namespace medial::exact {

/// Bounds for the one disk near `start` that three sites touch in this counter-clockwise order, and
/// which is smaller than their own circles: proved to exist. None where that is not certain in this
/// precision. Where two or three of the sites are joined, it is the disk that touches their joint,
/// or the middle one's own circle, and `start` is not needed.
///
/// Otherwise, in more digits than double's, it is disk_of_three(). In double it is the zero of
/// three quadratic functions F_i = f_i + u_i.x - r + q_i (x.x - r r) of the way (x, r) from the
/// starting disk, with unit vectors u_i to first order. With A twice the area of the triangle of
/// the u_i, and |f_i| <= f, |q_i| <= q, Newton's map with the slopes at the start takes the ball
/// |x|, |r| <= 2 (C + 1) f into itself and contracts it if 8 q (C + 1)^2 f < 1, C = 2 (|u_2 - u_1|
/// + |u_3 - u_1|) / A (Newton and Kantorovich): the bounds.
template <class Real>
std::optional<DiskBounds<Real>> disk_bounds(const SiteLoops& outline,
                                            const std::array<std::uint32_t, 3>& sites,
                                            const Disk& start);

/// Whether the foot of disk `to` lies further along the boundary on a site than that of `from`: 1,
/// -1, 0, or none where the bounds leave it open. Requires disks that touch the site.
template <class Real>
std::optional<int> further_along(const ExactSite& site, const DiskBounds<Real>& from,
                                 const DiskBounds<Real>& to);

}  // namespace medial::exact
