#pragma once

// An axis as polylines of disks: what pack() codes.

#include <cstdint>
#include <vector>

#include "medial/axis.h"

namespace medial::ops {

/// A polyline of disks between two junctions.
struct DiskLine {
  std::uint32_t from = 0, to = 0;  ///< junctions; equal for a closed one
  std::vector<Disk> disks;         ///< both ends included
};

struct DiskGraph {
  std::vector<Disk> junctions;
  std::vector<DiskLine> lines;
};

/// Of the error of disk_lines(): what samples may miss between them.
constexpr double sample_share = 1.0 / 16;

/// The axis without what disks grown by `prune` cover at their base, as polylines: every disk of
/// the axis lies in a disk of the polylines, grown by `prune` at most; and grown by `error` at most
/// even where something was dropped. Conversely every disk of the polylines lies in one of the
/// axis, grown by `error`. Requires error > 0,
/// 0 <= prune <= (1 - sample_share) * error.
DiskGraph disk_lines(const MedialAxis& axis, double prune, double error);

/// Which of the points 0 .. n - 1 to keep, first and last included, so that `excess(i, first,
/// last)` is not positive for any i between neighbours that are kept (Douglas and Peucker).
/// `excess` is by how much point i is too far from the segment.
template <class Excess>
std::vector<std::uint32_t> simplified(std::uint32_t n, const Excess& excess) {
  std::vector<std::uint32_t> kept{0};
  std::vector<std::uint32_t> ends{n - 1};
  while (!ends.empty()) {
    const std::uint32_t first = kept.back(), last = ends.back();
    double worst = 0;
    std::uint32_t at = last;
    for (std::uint32_t i = first + 1; i < last; ++i) {
      const double e = excess(i, first, last);
      if (e > worst) {
        worst = e;
        at = i;
      }
    }
    if (at == last) {
      kept.push_back(last);
      ends.pop_back();
    } else {
      ends.push_back(at);
    }
  }
  return kept;
}

}  // namespace medial::ops
