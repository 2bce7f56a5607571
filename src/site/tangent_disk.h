#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "medial/geometry.h"
#include "site/site.h"

namespace medial::site {

/// The radius of the disk that touches the boundary at `foot`, with the inward unit normal
/// `normal`, and touches the carrier of `site`; infinity if there is none. This is the construction
/// of Fig. 4 of Aichholzer et al. for a fixed contact, with the two points of tangency in closed
/// form.
///
/// The denominators are computed from differences (|n - m|^2 / 2 for 1 - n.m), so the disk's
/// residual at `site` is at rounding level even for flat angles.
double tangent_radius(Vec2 foot, Vec2 normal, const Site& site);

/// The radius at which a disk that grows at `foot` in the direction `normal` first touches the
/// closed site, from either side; infinity if it never does.
double touching_radius(Vec2 foot, Vec2 normal, const Site& site);

/// The centre of an arc's circle; a vertex itself.
inline Vec2 focus_of(const Site& site) {
  return site.is_vertex() ? site.point : site.point + (1 / site.curvature) * site.normal();
}

/// Up to two disks, in no particular order.
struct TangentDisks {
  std::array<Disk, 2> disk;
  std::size_t count = 0;
};

/// The disks that touch the carriers of three sites from their left: the ten Apollonius problems
/// for segments, arcs and vertices. If the sites are oriented circles, the difference of two
/// contact equations is linear in (x, y, r). Two linear equations give a line in (x, y, r), which
/// meets the cone of a vertex or an arc in at most two points, or the plane of a segment in one.
/// Excludes disks larger than the circle of a convex arc.
TangentDisks tangent_disks(const Site& a, const Site& b, const Site& c);

/// Largest |distance - radius| of a disk to the carriers of three sites.
double residual(const Disk& disk, const Site& a, const Site& b, const Site& c);

/// Reduces the residual of a disk that nearly touches three carriers below `good`, by two Newton
/// steps. If it stays above `bad`, solves again in 113-bit arithmetic, and counts this. No step
/// moves the disk by more than a thousandth of its radius, because a disk farther away is another
/// solution; no step increases the residual.
void polish(Disk& disk, const Site& a, const Site& b, const Site& c, double good, double bad,
            std::uint64_t& precision_retries);

}  // namespace medial::site
