#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/box_tree.h"
#include "base/numbers.h"
#include "base/spatial_order.h"
#include "medial/axis.h"

namespace medial::ops {

/// The disks at the nodes of an axis, in one tree per connected part, for searches of the scale
/// axis.
class DiskTree {
 public:
  /// `part` of each node, counted from 0. O(n log n).
  DiskTree(const std::vector<Node>& nodes, std::span<const std::uint32_t> part) {
    std::size_t parts = 0;
    for (const std::uint32_t p : part) parts = std::max<std::size_t>(parts, p + 1);
    std::vector<std::vector<std::uint32_t>> members(parts);
    for (std::uint32_t i = 0; i < nodes.size(); ++i) members[part[i]].push_back(i);
    std::vector<Vec2> places;
    for (const std::vector<std::uint32_t>& own : members) {
      places.clear();
      for (const std::uint32_t i : own) places.push_back(nodes[i].disk.center);
      Part& tree = parts_.emplace_back();
      for (const std::uint32_t k : spatial_order(places, fan_out))
        tree.disks.push_back(nodes[own[k]].disk);
      tree.levels = bound_levels(tree.disks.size(), fan_out, [&](std::size_t k) {
        const Disk& disk = tree.disks[k];
        return Bound{{disk.center, disk.center}, disk.radius};
      });
    }
  }

  /// The factor s at which another disk of the part, grown by s, contains `disk` grown by s: the
  /// minimum of |p - q| / (r(q) - r(p)) over the disks with larger radii; infinite if there is
  /// none. Sets `other` to that disk, if there is one. On input, `other` is any disk of the part
  /// that is likely to be close to it.
  double vanishes_at(const Disk& disk, std::uint32_t part, Disk& other) const {
    return least(disk, part, other, factor(disk, other));
  }
  /// Whether vanishes_at(disk, part, likely) is below `limit`. Faster than computing the value.
  bool vanishes_below(double limit, const Disk& disk, std::uint32_t part, Disk likely) const {
    return factor(disk, likely) < limit || least(disk, part, likely, limit) < limit;
  }

 private:
  static constexpr std::size_t fan_out = 8;

  /// The smallest factor below `best`, and sets `other` to its disk; or else `best`.
  double least(const Disk& disk, std::uint32_t part, Disk& other, double best) const {
    const Part& tree = parts_[part];
    Search search{tree, disk, best, other};
    search.run(tree.levels.size() - 1, 0);
    return search.best;
  }

  /// A box around centres, and the largest radius in it.
  struct Bound {
    Box box;
    double radius = 0;

    void add(const Bound& other) {
      box.add(other.box);
      radius = std::max(radius, other.radius);
    }
  };
  struct Part {
    std::vector<Disk> disks;
    std::vector<std::vector<Bound>> levels;  ///< the last one has one bound
  };

  /// A lower bound for the squared factor of the disks in the bound; infinite if at least `limit`.
  static double least_squared(const Bound& bound, const Disk& disk, double limit) {
    const double more = bound.radius - disk.radius;
    if (!(more > 0)) return infinity;
    const Vec2 p = disk.center;
    const auto& [low, high] = bound.box;
    const double dx = std::max(std::max(low.x - p.x, p.x - high.x), 0.0);
    const double dy = std::max(std::max(low.y - p.y, p.y - high.y), 0.0);
    const double far = dx * dx + dy * dy, square = more * more;
    // Most are much too far away; no division is needed to reject them.
    return far < limit * square ? far / square : infinity;
  }
  static double factor(const Disk& disk, const Disk& other) {
    const double more = other.radius - disk.radius;
    return more > 0 ? distance(other.center, disk.center) / more : infinity;
  }
  struct Search {
    const Part& tree;
    const Disk& disk;
    double best;
    Disk& other;

    void run(std::size_t level, std::size_t i) {
      const std::size_t first = i * fan_out;
      if (level == 0) {
        for (std::size_t k = first; k < std::min(first + fan_out, tree.disks.size()); ++k) {
          const Disk& next = tree.disks[k];
          const double more = next.radius - disk.radius;
          if (!(more > 0 && squared_norm(next.center - disk.center) < best * best * more * more))
            continue;
          const double here = factor(disk, next);
          if (!(here < best)) continue;
          best = here;
          other = next;
        }
        return;
      }
      // The most promising first.
      std::array<std::pair<double, std::size_t>, fan_out> children;
      std::size_t count = 0;
      const std::vector<Bound>& below = tree.levels[level - 1];
      for (std::size_t k = first; k < std::min(first + fan_out, below.size()); ++k) {
        const double bound = least_squared(below[k], disk, best * best);
        if (!(bound < best * best)) continue;
        std::size_t place = count++;
        for (; place > 0 && children[place - 1].first > bound; --place)
          children[place] = children[place - 1];
        children[place] = {bound, k};
      }
      for (std::size_t k = 0; k < count && children[k].first < best * best; ++k)
        run(level - 1, children[k].second);
    }
  };

  std::vector<Part> parts_;
};

}  // namespace medial::ops
