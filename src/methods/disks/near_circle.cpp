#include "methods/disks/near_circle.h"

#include <algorithm>
#include <cmath>

namespace medial::disks {

bool is_own_circle(const site::Site& site, const Disk& disk, double slack) {
  constexpr double alike = 0x1p-33;
  const auto is_on_disk = [&](Vec2 p) {
    return std::abs(distance(p, disk.center) - disk.radius) <= slack;
  };
  return site.curvature > 0 &&
         std::abs(site.curvature * disk.radius - 1) <= std::min(slack * site.curvature, alike) &&
         is_on_disk(site.point) && is_on_disk(site.end());
}

}  // namespace medial::disks
