#include "site/boundary_tree.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/spatial_order.h"
#include "base/threads.h"
#include "base/wide.h"

namespace medial::site {
namespace {

using site::Site;

/// A bound for the error of single precision (u = 2^-24) in the distance from a box, for local
/// coordinates below 2 and distances below 4. Along each axis, the query's centre rounds by 2 u,
/// and the difference, below 4, by 4 u; boxes are rounded outward, which is safe. Both axes
/// together: 6 sqrt(2) u < 8.5 u. The squares and their sum round by 2 u of the squared distance,
/// which is u of the distance: 4 u; the limit's square rounds by half of that. The sum is
/// below 14.5 u; the constant is 16 u.
constexpr double single_precision_slack = 0x1p-20;

/// Nodes of 8 to 512 sites have boxes along chords; there are few larger nodes.
constexpr std::size_t chord_levels = 4;
/// From this level on, boxes of many sites in a small place pay off for long-range searches,
/// whatever their height.
constexpr std::uint32_t level_of_many = 2;
static_assert(many_sites == std::size_t{8} << (2 * level_of_many));
/// A level stores chord boxes if at least one of this many nodes has one. Boxes of 8 sites take
/// more memory than all others.
constexpr std::size_t rare_of(std::uint32_t level) { return level == 0 ? 2 : 16; }

/// Sites are ordered in the plane if the boxes together have more than this many times the area of
/// the box around them.
constexpr double least_overlap_in_plane = 8;
/// This many levels up, a lane covers 64 boxes.
constexpr std::size_t levels_above = 3;

double area(const Boxes& boxes, std::size_t lane) {
  const double width = boxes.high_x[lane] - boxes.low_x[lane],
               height = boxes.high_y[lane] - boxes.low_y[lane];
  return width > 0 && height > 0 ? width * height : 0;  // also for the empty box
}

struct Waiting {
  std::uint32_t index;
  std::uint32_t level;  ///< 0: a block
  float squared;
};

}  // namespace

BoundaryTree::BoundaryTree(std::span<const Site> sites, Chords chords, std::size_t longest_range)
    : sites_(sites), longest_range_(longest_range) {
  std::atomic<bool> has_arcs = false;
  parallel_ranges(sites.size(), std::size_t{1} << 14, [&](std::size_t begin, std::size_t end) {
    const auto some = sites.subspan(begin, end - begin);
    if (std::any_of(some.begin(), some.end(), [](const Site& site) { return site.is_arc(); }))
      has_arcs = true;
  });
  has_arcs_ = has_arcs;
  if (sites.size() <= short_range) return;
  build_boxes();
  if (chords == Chords::none) return;
  const std::uint32_t lowest = chords == Chords::all ? 0 : 1;
  build_chord_boxes(lowest);
  if (boxes_overlap(lowest)) build_boxes_along(lowest);
}

/// The boxes of all levels, from the blocks up.
void BoundaryTree::build_boxes() {
  const auto nodes_over = [](std::size_t count) { return (count + fan - 1) / fan; };
  constexpr std::size_t grain = 1024;
  levels_.clear();
  levels_.emplace_back(nodes_over((sites_.size() + block_size - 1) / block_size));
  parallel_ranges(levels_[0].size(), grain, [&](std::size_t node, std::size_t last) {
    for (; node < last; ++node) {
      for (std::size_t lane = 0; lane < fan; ++lane) {
        Extent extent;
        const Positions at = positions(0, node, lane);
        for (std::size_t k = at.begin; k < at.begin + at.count; ++k) {
          const Site& site = sites_[in_plane_.empty() ? k : in_plane_[k]];
          if (is_inside(site)) extent.add(site);
        }
        levels_[0][node].set(lane, extent);
      }
    }
  });
  while (levels_.back().size() > 1) {
    const WorkVector<Boxes>& lower = levels_.back();
    WorkVector<Boxes> upper(nodes_over(lower.size()));
    parallel_ranges(lower.size(), grain, [&](std::size_t child, std::size_t last) {
      for (; child < last; ++child) upper[child / fan].set(child % fan, lower[child]);
    });
    levels_.push_back(std::move(upper));
  }
}

/// Whether boxes overlap in a large part of the boundary, on any level that searches visit.
bool BoundaryTree::boxes_overlap(std::uint32_t lowest) const {
  for (std::size_t level = lowest;
       level + levels_above < levels_.size() && span_of(level + levels_above) <= longest_range_;
       ++level)
    if (boxes_overlap_on(level)) return true;
  return false;
}

bool BoundaryTree::boxes_overlap_on(std::size_t level) const {
  constexpr std::size_t good_part = 16;
  constexpr std::size_t in_lane = std::size_t{1} << (2 * levels_above - 2);  // nodes
  const std::size_t above = level + levels_above;
  std::atomic<std::size_t> overlapping = 0;
  const std::size_t lanes = (levels_[level].size() + in_lane - 1) / in_lane;
  parallel_ranges(lanes, 16, [&](std::size_t lane, std::size_t last) {
    for (; lane < last; ++lane) {
      const std::size_t end = std::min((lane + 1) * in_lane, levels_[level].size());
      double sum = 0;
      for (std::size_t node = lane * in_lane; node < end; ++node) sum += areas_of(level, node);
      if (sum > least_overlap_in_plane * area(levels_[above][lane / fan], lane % fan))
        ++overlapping;
    }
  });
  return overlapping * good_part * span_of(above) > sites_.size();
}

/// The sum of the areas of a node's four lanes, each with the smaller one of its boxes.
double BoundaryTree::areas_of(std::size_t level, std::size_t node) const {
  const bool has_chords = level < chords_.size() && !chords_[level].boxes.empty();
  double sum = 0;
  for (std::size_t lane = 0; lane < fan; ++lane) {
    const double own = area(levels_[level][node], lane);
    sum += has_chords ? std::min(own, chords_[level].boxes[node].area(lane)) : own;
  }
  return sum;
}

/// If boxes along chords overlap, uses boxes along the sites of a node, which may not overlap, as
/// around needles. If these overlap, too, orders sites in the plane.
void BoundaryTree::build_boxes_along(std::uint32_t lowest) {
  chords_.clear();
  in_plane_.resize(sites_.size());
  std::iota(in_plane_.begin(), in_plane_.end(), 0U);
  set_boxes_along(lowest);
  if (!boxes_overlap(lowest)) return free_memory(in_plane_);
  chords_.clear();
  order_overlapping(
      in_plane_,
      [&](std::uint32_t i) {
        return is_inside(sites_[i]) ? midpoint(sites_[i].point, sites_[i].end()) : Vec2{};
      },
      [&](std::uint32_t i) { return chord_of(sites_[i]); }, 2);
  build_boxes();
  set_boxes_along(lowest);
}

void BoundaryTree::set_boxes_along(std::uint32_t lowest) {
  chords_.resize(levels_.size());
  for (std::uint32_t level = lowest; level < levels_.size(); ++level) {
    WorkVector<ChordBoxes>& boxes = chords_[level].boxes;
    boxes.resize(levels_[level].size());
    parallel_ranges(boxes.size(), 256, [&](std::size_t node, std::size_t last) {
      for (; node < last; ++node) {
        for (std::size_t lane = 0; lane < fan; ++lane) {
          const Positions at = positions(level, node, lane);
          const auto some = std::span(in_plane_).subspan(at.begin, at.count);
          boxes[node].set(lane, box_along(sites_, some));
        }
      }
    });
  }
}

void BoundaryTree::build_chord_boxes(std::uint32_t lowest) {
  chords_.resize(std::min<std::size_t>(chord_levels, levels_.size()));
  for (std::uint32_t level = lowest; level < chords_.size(); ++level) {
    const std::size_t nodes = levels_[level].size();
    const auto is_rare = [&](std::size_t lanes) {
      return lanes * rare_of(level) * span_of(level) < sites_.size();
    };
    WorkVector<ChordBoxes>& boxes = chords_[level].boxes;
    // If few nodes of a sample have a box, the level stores none.
    constexpr std::size_t sampled = 16;
    if (nodes > sampled * sampled) {
      std::atomic<std::size_t> lanes = 0;
      parallel_ranges((nodes + sampled - 1) / sampled, 64, [&](std::size_t i, std::size_t last) {
        Fitting fitting;
        ChordBoxes some;
        for (; i < last; ++i) set_chord_boxes(level, sampled * i, some, fitting);
        lanes += fitting.lanes;
      });
      if (is_rare(sampled * lanes)) continue;
    }
    boxes.resize(nodes);
    std::atomic<std::size_t> lanes = 0, flat = 0;
    parallel_ranges(nodes, 256, [&](std::size_t node, std::size_t last) {
      Fitting fitting;
      for (; node < last; ++node) set_chord_boxes(level, node, boxes[node], fitting);
      lanes += fitting.lanes;
      flat += fitting.flat;
    });
    if (is_rare(lanes))
      free_memory(boxes);
    else if (is_rare(flat))
      chords_[level].least_reach = little_room;
  }
}

void BoundaryTree::set_chord_boxes(std::size_t level, std::size_t node, ChordBoxes& boxes,
                                   Fitting& fitting) const {
  for (std::size_t lane = 0; lane < fan; ++lane) {
    const Positions at = positions(level, node, lane);
    const std::optional<ChordBox> box = chord_box(sites_.subspan(at.begin, at.count));
    if (box) {
      ++fitting.lanes;
      if (box->is_flat) ++fitting.flat;
    }
    boxes.set(lane, box);
  }
}

namespace {

/// Of the four children from `child` on, those in [first, last], as bits. Branchless, because the
/// branches would be unpredictable.
inline std::uint32_t children_within(std::uint32_t child, std::uint32_t first, std::uint32_t last) {
  const auto skipped = [](std::uint32_t from, std::uint32_t to) {
    return std::max(static_cast<std::int32_t>(to - from), 0);
  };
  return (0xFu << skipped(child, first)) & (0xFu >> skipped(last, child + 3));
}

using Stack = std::array<Waiting, 4 * 16 + 4>;

/// Returns the nearest of the children in `mask` (at least one), and pushes the others, the
/// farthest at the bottom.
[[gnu::always_inline]] inline Waiting take_nearest(std::uint32_t mask, std::uint32_t child,
                                                   std::uint32_t level, const Lanes& squared,
                                                   Stack& stack, std::size_t& size) {
  auto lane = static_cast<std::uint32_t>(std::countr_zero(mask));
  Waiting top{child + lane, level, squared[lane]};
  const std::size_t bottom = size;
  for (mask &= mask - 1; mask != 0; mask &= mask - 1) {
    lane = static_cast<std::uint32_t>(std::countr_zero(mask));
    Waiting later{child + lane, level, squared[lane]};
    if (later.squared < top.squared) std::swap(later, top);
    std::size_t at = size++;
    for (; at > bottom && stack[at - 1].squared < later.squared; --at) stack[at] = stack[at - 1];
    stack[at] = later;
  }
  return top;
}

/// Returns the first of the children in `mask` (at least one), and pushes the others, the last at
/// the bottom.
[[gnu::always_inline]] inline Waiting take_first(std::uint32_t mask, std::uint32_t child,
                                                 std::uint32_t level, const Lanes& squared,
                                                 Stack& stack, std::size_t& size) {
  for (;;) {
    const auto lane = static_cast<std::uint32_t>(std::bit_width(mask) - 1);
    const Waiting last{child + lane, level, squared[lane]};
    mask ^= 1u << lane;
    if (mask == 0) return last;
    stack[size++] = last;
  }
}

}  // namespace

template <class Visit>
[[gnu::always_inline]] inline void BoundaryTree::visit_block(std::uint32_t index,
                                                             std::uint32_t first,
                                                             std::uint32_t last,
                                                             Visit&& visit) const {
  if (in_plane_.empty())
    return visit(std::max(first, index * block_size),
                 std::min(last, index * block_size + block_size - 1));
  const Positions at = positions(0, index / fan, index % fan);
  for (const std::uint32_t i : std::span(in_plane_).subspan(at.begin, at.count))
    if (i >= first && i <= last) visit(i, i);
}

[[gnu::always_inline]] inline bool BoundaryTree::is_beyond(std::uint32_t level, std::uint32_t index,
                                                           Vec2 c, double reach) const {
  if (reach < little_room || level < level_of_many || level >= chords_.size() ||
      chords_[level].boxes.empty())
    return false;
  return (chords_[level].boxes[index / fan].beyond(c, reach) >> index % fan & 1U) != 0;
}

template <BoundaryTree::Order order, class Visit>
[[gnu::always_inline]] inline void BoundaryTree::visit_blocks(Vec2 c, double& reach,
                                                              std::uint32_t first,
                                                              std::uint32_t last,
                                                              Visit&& visit) const {
  if (last - first < short_range) {
    visit(first, last);
    return;
  }
  const auto x = static_cast<float>(c.x), y = static_cast<float>(c.y);
  const auto squared_reach = [&] {
    const double r = reach + single_precision_slack;
    return static_cast<float>(r * r);
  };
  float limit = squared_reach();

  // In boundary order, the ends of a range are next to a disk's two feet, where most nearby sites
  // are, so these blocks are visited first. Then comes the lowest node over the rest; in the
  // plane's order, the root.
  std::uint32_t first_block = in_plane_.empty() ? first / block_size : 0;
  std::uint32_t last_block = (in_plane_.empty() ? last : last_of_all()) / block_size;
  if (order == Order::nearest_first && in_plane_.empty()) {
    visit(first, first_block++ * block_size + block_size - 1);
    visit(last_block-- * block_size, last);
    limit = squared_reach();
  }
  const auto common = static_cast<std::uint32_t>(std::bit_width(first_block ^ last_block) + 1) / 2;
  const auto chord_count = static_cast<std::uint32_t>(chords_.size());

  Stack stack;
  std::size_t size = 0;
  Waiting top{first_block >> (2 * common), common, 0};
  for (;;) {
    if (top.level == 0) {
      visit_block(top.index, first, last, visit);
      limit = squared_reach();
    } else {
      const std::uint32_t below = top.level - 1;
      const Boxes& boxes = levels_[below][top.index];
      const std::uint32_t child = top.index * fan;
      std::uint32_t mask =
          children_within(child, first_block >> (2 * below), last_block >> (2 * below));
      Lanes squared;
      mask &= nearer(boxes, x, y, limit, squared);
      if (below < chord_count && mask != 0 && chords_[below].pay(reach))
        mask &= ~chords_[below].boxes[top.index].beyond(c, reach);
      if (mask != 0) {
        if constexpr (order == Order::nearest_first)
          top = take_nearest(mask, child, below, squared, stack, size);
        else
          top = take_first(mask, child, below, squared, stack, size);
        continue;
      }
    }
    do {
      if (size == 0) return;
      top = stack[--size];
    } while (!(top.squared < limit) || is_beyond(top.level, top.index, c, reach));
  }
}

namespace {

/// Whether a site is certainly not nearer to c than `reach`, in spite of rounding. A site is not
/// longer than the parameter of its end.
inline bool is_out_of_reach(const Site& site, Vec2 c, double reach) {
  constexpr double a_little_more = 1 + 0x1p-40;
  const double far = a_little_more * (reach + site.length);
  return squared_norm(c - site.point) > far * far;
}

}  // namespace

template <class Squared, class LookAt>
[[gnu::always_inline]] inline void BoundaryTree::look_at_each(Vec2 c, std::uint32_t first,
                                                              std::uint32_t last,
                                                              const Squared& squared,
                                                              const LookAt& look_at) const {
  if (!has_arcs_)
    for (const Site* site = sites_.data() + first; first < last; first += 2, site += 2) {
      const std::uint32_t reached = reached_of_two(site[0], site[1], c, squared());
      if (reached == 0) continue;
      if ((reached & 1) != 0) look_at(first, true);
      if ((reached & 2) != 0) look_at(first + 1, true);
    }
  for (; first <= last; ++first) look_at(first, false);
}

MEDIAL_WIDE BoundaryTree::Hit BoundaryTree::nearest(Vec2 c, double reach, std::uint32_t first,
                                                    std::uint32_t last) const {
  Hit hit;
  if (first > last || sites_.empty() || !(reach > 0)) return hit;
  hit.squared_distance = reach * reach;
  const auto look_at = [&](std::uint32_t i, bool) {
    const Site& site = sites_[i];
    if (has_arcs_ && is_out_of_reach(site, c, reach)) return;
    const double squared = site::squared_distance(site, c);
    if (squared < hit.squared_distance || (hit && squared == hit.squared_distance && i < hit.site))
      hit = {i, squared};
  };
  visit_blocks<Order::nearest_first>(
      c, reach, first, last, [&](std::uint32_t from, std::uint32_t to) {
        const double before = hit.squared_distance;
        look_at_each(
            c, from, to, [&] { return hit.squared_distance; }, look_at);
        if (hit.squared_distance < before) reach = std::sqrt(hit.squared_distance);
      });
  return hit;
}

BoundaryTree::Hit BoundaryTree::nearest_facing(Vec2 c, double reach, std::uint32_t first,
                                               std::uint32_t last) const {
  Hit front, back;
  if (first > last || !(reach > 0)) return front;
  // The difference that rounding may cause between two distances to one place.
  constexpr double rounding = 0x1p-48;
  front.squared_distance = back.squared_distance = reach * reach;
  double limit = reach * reach;
  const auto faces = [&](const Site& site) {
    if (site.is_vertex()) return true;
    const double s = site::carrier_parameter(site, c);
    return site::carrier_distance(site, c) > 0 && s >= 0 && s <= site.length;
  };
  const auto look_at = [&](std::uint32_t i, bool) {
    const double squared = site::squared_distance(sites_[i], c);
    if (!(squared < limit)) return;
    Hit& hit = faces(sites_[i]) ? front : back;
    if (squared < hit.squared_distance) hit = {i, squared};
    const double near = std::sqrt(back.squared_distance) + rounding;
    limit = std::min({front.squared_distance, near * near, limit});
  };
  visit_blocks<Order::nearest_first>(c, reach, first, last,
                                     [&](std::uint32_t from, std::uint32_t to) {
                                       const double before = limit;
                                       look_at_each(
                                           c, from, to, [&] { return limit; }, look_at);
                                       if (limit < before) reach = std::sqrt(limit);
                                     });
  if (!back) return front;
  if (!front) return back;
  return std::sqrt(front.squared_distance) <= std::sqrt(back.squared_distance) + rounding ? front
                                                                                          : back;
}

MEDIAL_WIDE void BoundaryTree::within(Vec2 c, double reach, std::uint32_t first, std::uint32_t last,
                                      std::vector<std::uint32_t>& found) const {
  found.clear();
  if (first > last || !(reach > 0)) return;
  const double squared = std::nextafter(reach * reach, 0);  // the largest that is nearer
  visit_blocks<Order::in_turn>(c, reach, first, last, [&](std::uint32_t from, std::uint32_t to) {
    look_at_each(
        c, from, to, [&] { return squared; },
        [&](std::uint32_t i, bool is_reached) {
          if (is_reached || site::squared_distance(sites_[i], c) <= squared) found.push_back(i);
        });
  });
  if (!in_plane_.empty()) std::sort(found.begin(), found.end());
}

bool BoundaryTree::few_within(Vec2 c, double reach, std::size_t most,
                              std::vector<std::uint32_t>& found) const {
  found.clear();
  if (sites_.empty() || !(reach > 0)) return true;
  const double squared = reach * reach;
  visit_blocks<Order::nearest_first>(c, reach, 0, last_of_all(),
                                     [&](std::uint32_t from, std::uint32_t to) {
                                       for (; from <= to; ++from)
                                         if (site::squared_distance(sites_[from], c) < squared)
                                           found.push_back(from);
                                       if (found.size() > most)
                                         reach = -single_precision_slack;  // ends the search
                                     });
  return found.size() <= most;
}

}  // namespace medial::site
