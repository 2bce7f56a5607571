#include "io/output_crs.h"

#include <algorithm>

namespace medial::io {

Status OutputCrs::transform(std::vector<Disk>& disks) const {
  if (!change) return success();
  std::vector<Vec2> points;
  points.reserve(disks.size());
  for (const Disk& disk : disks) points.push_back(disk.center);
  if (Status done = change(points); !done) return done;
  for (std::size_t i = 0; i < disks.size(); ++i) disks[i].center = points[i];
  return success();
}

void turn_back(std::span<std::vector<Vec2>> parts) {
  if (parts.empty() || parts[0].empty()) return;
  const auto [west, east] = std::ranges::minmax(parts[0], {}, &Vec2::x);
  constexpr double most = 180, rounding = 3e-8;  // 3 mm, more than projecting there and back takes
  const double turn = west.x > most - rounding && east.x > most + rounding     ? -360
                      : east.x < -most + rounding && west.x < -most - rounding ? 360
                                                                               : 0;
  for (std::vector<Vec2>& part : parts)
    for (Vec2& p : part) p.x += turn;
}

}  // namespace medial::io
