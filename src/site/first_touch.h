#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/memory.h"
#include "site/lanes.h"
#include "site/site.h"

namespace medial::site {

/// Finds the site that a disk reaches first which touches a given point and grows away from it.
///
/// A box tree over the sites in spatial order. In boundary order, the boxes of nested loops would
/// all overlap, and every search would visit each of them. The smaller disks of such a family lie
/// inside the larger ones, so one descent suffices: a site beyond a disk stays beyond it while the
/// disk shrinks. O(n) to build, O(log n) expected per search.
class FirstTouch {
 public:
  /// A tree of the sites with the given indices; site i belongs to group groups[i]. Sites must lie
  /// in the local frame. `groups` must outlive the tree.
  FirstTouch(std::span<const site::Site> sites, std::span<const std::uint32_t> indices,
             std::span<const std::uint32_t> groups);

  struct Touch {
    std::uint32_t site = 0;
    double radius = 0;
    double error = 0;         ///< bound on the error of the radius
    std::uint32_t count = 1;  ///< edges that the exact disk may touch; both sides of one count once
  };
  /// A bound for the rounding error of the distance of a disk's centre from a site, for local
  /// coordinates below 2 and distances below 4, and of the end of a site.
  static constexpr double distance_rounding = 0x1p-48;
  static constexpr std::uint32_t many = 8;  ///< the count if double cannot decide
  /// The first site that the disk of radius r around foot + r direction reaches, from either side,
  /// while r grows from 0 to `largest`, if any. Considers the sites of the group except first..last
  /// (inclusive). Of sites reached at the same radius, returns any. The foot must lie in the local
  /// frame, and `largest` must be below 4.
  std::optional<Touch> find(Vec2 foot, Vec2 direction, double largest, std::uint32_t group,
                            std::uint32_t first, std::uint32_t last) const;

  /// The lowest nodes of the tree whose boxes meet a region, which many searches in it then share.
  /// Empty if the region has very many such nodes.
  class Region {
   public:
    /// Whether the region contains a disk, so that its search may begin here.
    bool holds(Vec2 center, double radius) const {
      return center.x - radius >= box_.low.x && center.y - radius >= box_.low.y &&
             center.x + radius <= box_.high.x && center.y + radius <= box_.high.y;
    }

   private:
    friend FirstTouch;
    struct Block {
      std::uint32_t index;
      float from_foot;
    };
    Extent box_;  ///< empty if there are too many nodes
    std::vector<std::uint32_t> nodes_;
    std::vector<Block> waiting_;  ///< of the current search
  };
  void look_around(const Extent& box, Region& region) const;
  /// find() for a disk that the region holds.
  std::optional<Touch> find(Vec2 foot, Vec2 direction, double largest, std::uint32_t group,
                            std::uint32_t first, std::uint32_t last, Region& region) const;

  /// Calls visit(site) for all sites of the group within `reach` of a point of the local frame.
  template <class Visit>
  void near(Vec2 point, double reach, std::uint32_t group, Visit&& visit) const;

 private:
  static constexpr std::size_t fan = 4;
  static constexpr std::size_t block_size = 8;

  struct Entry {
    site::Site site;
    std::uint32_t index;
  };
  /// The slabs low <= normal . p <= high of four sets of sites, along each set's longest segment,
  /// in single precision. They bound slanted segments more tightly than boxes. A slab without a
  /// normal is the whole plane.
  struct alignas(64) Slabs {
    Lanes normal_x{}, normal_y{}, low = -all_endless, high = all_endless;
  };
  struct Bounds {
    Boxes boxes;
    Slabs slabs;
  };

  /// The state of a search: the current disk, the site that it touches, and the sites near it.
  struct Search {
    Vec2 foot, direction;
    std::uint32_t group, first, last;
    double radius;
    Vec2 center;
    const Entry* found = nullptr;
    std::array<const Entry*, many> near = {};
    std::uint32_t count = 0;  ///< of the sites in `near`; above its size, there were too many

    void look_at(const Entry& entry);
    std::optional<Touch> touch() const;
    bool is_within(const Entry& entry, double reach) const;
  };

  void build_level(std::size_t run);
  void search_block(std::uint32_t block, Search& search) const;

  static std::uint32_t beside(const Slabs& slabs, float x, float y, float reach);

  std::span<const std::uint32_t> groups_;
  bool has_arcs_ = false;
  WorkVector<Entry> entries_;               ///< in spatial order
  std::vector<WorkVector<Bounds>> levels_;  ///< levels_[0] bounds blocks of entries
};

template <class Visit>
void FirstTouch::near(Vec2 point, double reach, std::uint32_t group, Visit&& visit) const {
  constexpr double rounding = 0x1p-20;  // of single precision
  const auto x = static_cast<float>(point.x), y = static_cast<float>(point.y);
  const auto limit = static_cast<float>((reach + rounding) * (reach + rounding));
  struct Waiting {
    std::uint32_t level, index;
  };
  std::vector<Waiting> stack{{static_cast<std::uint32_t>(levels_.size()), 0}};
  while (!stack.empty()) {
    const Waiting top = stack.back();
    stack.pop_back();
    if (top.level == 0) {
      const std::size_t begin = top.index * block_size;
      for (std::size_t i = begin; i < std::min(begin + block_size, entries_.size()); ++i)
        if (groups_[entries_[i].index] == group &&
            site::squared_distance(entries_[i].site, point) <= reach * reach)
          visit(entries_[i].index);
      continue;
    }
    Lanes squared;
    const std::uint32_t mask =
        nearer(levels_[top.level - 1][top.index].boxes, x, y, limit, squared);
    for (std::uint32_t lane = 0; lane < fan; ++lane)
      if ((mask >> lane & 1) != 0)
        stack.push_back({top.level - 1, top.index * static_cast<std::uint32_t>(fan) + lane});
  }
}

}  // namespace medial::site
