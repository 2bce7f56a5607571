#include "io/output_crs.h"

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

}  // namespace medial::io
