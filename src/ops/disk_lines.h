#pragma once

// An axis as polylines of disks, for pack().

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "medial/axis.h"

namespace medial::ops {

/// A polyline of disks between two junctions.
struct DiskLine {
  std::uint32_t from = 0, to = 0;  ///< junctions; equal for a closed line
  std::vector<Disk> disks;         ///< both ends included
};

struct DiskGraph {
  std::vector<Disk> junctions;
  std::vector<DiskLine> lines;
};

/// The share of the error of disk_lines() for sampling.
constexpr double sample_share = 1.0 / 16;

/// The axis as polylines, without branches that the disk at their base covers if grown by `prune`.
/// Every disk of the axis, including dropped ones, lies in a disk of the polylines grown by at most
/// `error`, and every disk of the polylines lies in a disk of the axis grown by `error`. Requires
/// error > 0, 0 <= prune <= (1 - sample_share) * error.
DiskGraph disk_lines(const MedialAxis& axis, double prune, double error);

/// Divides a line at its farthest point until all points are close enough (Douglas and Peucker).
/// After many divisions, as for a growing zigzag, walks along the rest instead.
template <class Excess>
class Simplifier {
 public:
  explicit Simplifier(const Excess& excess) : excess_(excess) {}
  std::vector<std::uint32_t> run(std::uint32_t n) {
    kept_ = {0};
    divide(0, n - 1, 0);
    return std::move(kept_);
  }

 private:
  /// Appends the kept points between two points, and the last one.
  void divide(std::uint32_t first, std::uint32_t last, std::uint32_t divisions) {
    constexpr std::uint32_t most = 128;
    const std::uint32_t at = farthest(first, last);
    if (at == last) return kept_.push_back(last);
    if (divisions == most) return walk(first, last);
    divide(first, at, divisions + 1);
    divide(at, last, divisions + 1);
  }
  /// The same with segments found by doubling and halving. A segment of m points takes O(m log m).
  void walk(std::uint32_t first, std::uint32_t last) {
    const auto reaches = [&](std::uint32_t to) { return farthest(first, to) == to; };
    while (first < last) {
      std::uint32_t good = 1, bad = 2;
      while (bad <= last - first && reaches(first + bad)) {
        good = bad;
        bad *= 2;
      }
      bad = std::min(bad, last - first + 1);
      while (bad - good > 1) {
        const std::uint32_t middle = good + (bad - good) / 2;
        (reaches(first + middle) ? good : bad) = middle;
      }
      first += good;
      kept_.push_back(first);
    }
  }
  /// The point between two others that is farthest from their segment, if it is too far; else
  /// `last`.
  std::uint32_t farthest(std::uint32_t first, std::uint32_t last) const {
    double worst = 0;
    std::uint32_t at = last;
    for (std::uint32_t i = first + 1; i < last; ++i) {
      const double e = excess_(i, first, last);
      if (!(e > worst)) continue;
      worst = e;
      at = i;
    }
    return at;
  }

  const Excess& excess_;
  std::vector<std::uint32_t> kept_;
};

/// The points of 0 .. n - 1 to keep, including the first and the last, such that `excess(i, first,
/// last)` is not positive for any i between kept neighbours. excess() is the distance by which
/// point i is too far from the segment. O(n log n).
template <class Excess>
std::vector<std::uint32_t> simplified(std::uint32_t n, const Excess& excess) {
  return Simplifier<Excess>(excess).run(n);
}

}  // namespace medial::ops
