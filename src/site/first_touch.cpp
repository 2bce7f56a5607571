#include "site/first_touch.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "base/spatial_order.h"
#include "base/threads.h"
#include "base/wide.h"
#include "site/tangent_disk.h"

namespace medial::site {
namespace {

using site::Site;

constexpr double rounding = FirstTouch::distance_rounding;

/// A radius with a larger error counts as unknown. The distance of a disk from a site changes by up
/// to twice as much as the radius, so sites within twice this distance are examined as well.
constexpr double largest_error = 0x1p-40;
constexpr double looked_at = rounding + 2 * largest_error;

/// A bound for the error of single precision (u = 2^-24) in the distance of a disk's centre from a
/// box or a slab, for radii below 4. The centre's coordinates are below 8 and round by 4 u each;
/// the differences to a box round by 8 u: for both axes together 17 u. The squares, their sum and
/// the limit add 3 u of a distance below 4: 12 u. A slab's bounds were computed with the same
/// rounded normal; centre, products, sum and difference add less than 6 u + 16 u + 8 u. The
/// constant is 64 u.
constexpr double single_precision_reach = 0x1p-18;

/// Larger sets get no slab, because it would be about as wide as the box.
constexpr std::size_t largest_slab = 512;

}  // namespace

FirstTouch::FirstTouch(std::span<const Site> sites, std::span<const std::uint32_t> indices,
                       std::span<const std::uint32_t> groups)
    : groups_(groups) {
  std::vector<std::uint32_t> order;
  {
    WorkVector<Vec2> middle(indices.size());
    std::transform(indices.begin(), indices.end(), middle.begin(),
                   [&](std::uint32_t i) { return midpoint(sites[i].point, sites[i].end()); });
    order = z_order(middle);
  }
  entries_.reserve(order.size());
  for (const std::uint32_t i : order) {
    entries_.push_back({sites[indices[i]], indices[i]});
    has_arcs_ = has_arcs_ || entries_.back().site.is_arc();
  }

  std::size_t run = block_size;
  do {
    build_level(run);
    run *= fan;
  } while (levels_.back().size() > 1);
}

/// The level whose lanes bound `run` entries each, above the last one.
void FirstTouch::build_level(std::size_t run) {
  const std::size_t sets = (entries_.size() + run - 1) / run;
  const WorkVector<Bounds>* lower = levels_.empty() ? nullptr : &levels_.back();
  WorkVector<Bounds> level(std::max<std::size_t>(1, (sets + fan - 1) / fan));
  parallel_ranges(sets, 256, [&](std::size_t set, std::size_t last) {
    for (; set < last; ++set) {
      Bounds& bounds = level[set / fan];
      const std::size_t lane = set % fan;
      const std::span<const Entry> entries =
          std::span(entries_).subspan(set * run, std::min(run, entries_.size() - set * run));
      if (lower == nullptr) {
        Extent extent;
        for (const Entry& entry : entries) extent.add(entry.site);
        bounds.boxes.set(lane, extent);
      } else {
        bounds.boxes.set(lane, (*lower)[set].boxes);
      }
      if (run > largest_slab) continue;

      const Site& longest =
          std::max_element(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
            return a.site.length < b.site.length;
          })->site;
      if (longest.is_vertex()) continue;
      Slabs& slabs = bounds.slabs;
      slabs.normal_x[lane] = static_cast<float>(longest.normal().x);
      slabs.normal_y[lane] = static_cast<float>(longest.normal().y);
      const Vec2 normal{slabs.normal_x[lane], slabs.normal_y[lane]};
      double low = dot(normal, longest.point), high = low;
      for (const Entry& entry : entries) {
        const Site& site = entry.site;
        for (const Vec2 p : {site.point, site.end(), site.is_arc() ? site.apex() : site.point}) {
          low = std::min(low, dot(normal, p));
          high = std::max(high, dot(normal, p));
        }
      }
      slabs.low[lane] = rounded_down(low);
      slabs.high[lane] = rounded_up(high);
    }
  });
  levels_.push_back(std::move(level));
}

/// The lanes whose slabs are farther from (x, y) than the reach, as bits.
std::uint32_t FirstTouch::beside(const Slabs& slabs, float x, float y, float reach) {
  const Lanes height = slabs.normal_x * x + slabs.normal_y * y;
  return bits_of(larger(slabs.low - height, height - slabs.high) >= reach);
}

bool FirstTouch::Search::is_within(const Entry& entry, double reach) const {
  return site::squared_distance(entry.site, center) < (radius + reach) * (radius + reach);
}

/// Shrinks the disk if it reaches over the site, and records the sites that it may touch.
void FirstTouch::Search::look_at(const Entry& entry) {
  const double smaller = site::touching_radius(foot, direction, entry.site);
  if (smaller < radius) {
    radius = smaller;
    center = foot + smaller * direction;
    found = &entry;
  }
  if (count == many) {
    const auto end = std::remove_if(near.begin(), near.end(), [&](const Entry* other) {
      return !is_within(*other, looked_at);
    });
    count = static_cast<std::uint32_t>(end - near.begin());
  }
  if (count < many) near[count] = &entry;
  count = std::min(count + 1, many + 1);
}

/// While the disk grows, its distance from the site falls at the rate 1 - cos(angle), where the
/// angle is between its directions of growth and of contact. So the error of the radius is the
/// rounding error of the distance divided by this rate. To second order, this holds if the error is
/// small relative to the radius and to the distance between the centres of the disk and of an arc.
std::optional<FirstTouch::Touch> FirstTouch::Search::touch() const {
  if (found == nullptr) return std::nullopt;
  constexpr double part = 0x1p-6;
  const Site& site = found->site;
  const Vec2 at = site.at(std::clamp(site::carrier_parameter(site, center), 0.0, site.length));
  const double rate = 0.5 * squared_norm(direction - 1 / radius * (center - at));
  const double room = radius * std::min(1.0, std::abs(1 - radius * std::abs(site.curvature)));
  Touch touch{found->index, radius, rounding / rate, many};
  if (count > many || !(touch.error <= std::min(largest_error, part * room))) return touch;
  const double reach = rounding + 2 * touch.error;
  touch.count = 0;
  for (std::uint32_t i = 0; i < count; ++i)
    if (is_within(*near[i], reach) &&
        std::none_of(near.begin(), near.begin() + i,
                     [&](const Entry* other) { return are_two_sides(near[i]->site, other->site); }))
      ++touch.count;
  return touch;
}

/// Shrinks the disk until it does not reach over any site of a block.
void FirstTouch::search_block(std::uint32_t block, Search& search) const {
  const auto look_at = [&](const Entry& entry) {
    if (entry.index >= search.first && entry.index <= search.last) return;
    if (groups_[entry.index] == search.group) search.look_at(entry);
  };
  std::size_t i = block * block_size;
  const std::size_t end = std::min(i + block_size, entries_.size());
  const auto limit = [&] { return (search.radius + looked_at) * (search.radius + looked_at); };
  if (!has_arcs_) {
    for (; i + 1 < end; i += 2) {
      const std::uint32_t reached =
          reached_of_two(entries_[i].site, entries_[i + 1].site, search.center, limit());
      if (reached == 0) continue;
      if ((reached & 1) != 0) look_at(entries_[i]);
      if ((reached & 2) != 0) look_at(entries_[i + 1]);
    }
  }
  for (; i < end; ++i)
    if (site::squared_distance(entries_[i].site, search.center) < limit()) look_at(entries_[i]);
}

MEDIAL_WIDE std::optional<FirstTouch::Touch> FirstTouch::find(Vec2 foot, Vec2 direction,
                                                              double largest, std::uint32_t group,
                                                              std::uint32_t first,
                                                              std::uint32_t last) const {
  Search search{foot, direction, group, first, last, largest, foot + largest * direction};
  const auto foot_x = static_cast<float>(foot.x), foot_y = static_cast<float>(foot.y);
  struct Waiting {
    std::uint32_t level, index;
    float from_foot;
  };
  // Three siblings wait on each of at most 16 levels.
  std::array<Waiting, 3UL * 16 + fan> stack;
  std::size_t size = 0;
  stack[size++] = {static_cast<std::uint32_t>(levels_.size()), 0, 0};

  while (size > 0) {
    const Waiting top = stack[--size];
    if (top.level == 0) {
      search_block(top.index, search);
      continue;
    }
    const Bounds& bounds = levels_[top.level - 1][top.index];
    const auto x = static_cast<float>(search.center.x), y = static_cast<float>(search.center.y);
    const auto reach = static_cast<float>(search.radius + single_precision_reach);
    Lanes from_foot, from_center;
    nearer(bounds.boxes, foot_x, foot_y, 0, from_foot);
    std::uint32_t mask =
        nearer(bounds.boxes, x, y, reach * reach, from_center) & ~beside(bounds.slabs, x, y, reach);
    // The node nearest to the foot goes on top, because it shrinks the disk most.
    const std::size_t bottom = size;
    for (; mask != 0; mask &= mask - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(mask));
      const Waiting waiting{top.level - 1, static_cast<std::uint32_t>(top.index * fan) + lane,
                            from_foot[lane]};
      std::size_t at = size++;
      for (; at > bottom && stack[at - 1].from_foot < waiting.from_foot; --at)
        stack[at] = stack[at - 1];
      stack[at] = waiting;
    }
  }
  return search.touch();
}

void FirstTouch::look_around(const Extent& box, Region& region) const {
  constexpr std::size_t most = 64;
  region.box_ = box;
  region.nodes_.clear();
  const float low_x = rounded_down(box.low.x - single_precision_reach),
              low_y = rounded_down(box.low.y - single_precision_reach),
              high_x = rounded_up(box.high.x + single_precision_reach),
              high_y = rounded_up(box.high.y + single_precision_reach);
  struct Waiting {
    std::uint32_t level, index;
  };
  std::array<Waiting, 3UL * 16 + fan> stack;
  std::size_t size = 0;
  stack[size++] = {static_cast<std::uint32_t>(levels_.size()) - 1, 0};
  while (size > 0) {
    const Waiting top = stack[--size];
    if (top.level == 0) {
      region.nodes_.push_back(top.index);
      if (region.nodes_.size() <= most) continue;
      region.box_ = {};
      return;
    }
    const Boxes& boxes = levels_[top.level][top.index].boxes;
    for (std::uint32_t lane = 0; lane < fan; ++lane)
      if (boxes.low_x[lane] <= high_x && boxes.high_x[lane] >= low_x &&
          boxes.low_y[lane] <= high_y && boxes.high_y[lane] >= low_y)
        stack[size++] = {top.level - 1, top.index * static_cast<std::uint32_t>(fan) + lane};
  }
}

MEDIAL_WIDE std::optional<FirstTouch::Touch> FirstTouch::find(Vec2 foot, Vec2 direction,
                                                              double largest, std::uint32_t group,
                                                              std::uint32_t first,
                                                              std::uint32_t last,
                                                              Region& region) const {
  Search search{foot, direction, group, first, last, largest, foot + largest * direction};
  const auto foot_x = static_cast<float>(foot.x), foot_y = static_cast<float>(foot.y);
  const WorkVector<Bounds>& lowest = levels_.front();
  auto& waiting = region.waiting_;
  waiting.clear();
  const auto lanes_near = [&](const Bounds& bounds, Lanes& squared) {
    const auto x = static_cast<float>(search.center.x), y = static_cast<float>(search.center.y);
    const auto reach = static_cast<float>(search.radius + single_precision_reach);
    return nearer(bounds.boxes, x, y, reach * reach, squared) & ~beside(bounds.slabs, x, y, reach);
  };
  for (const std::uint32_t node : region.nodes_) {
    Lanes from_foot, from_center;
    std::uint32_t mask = lanes_near(lowest[node], from_center);
    if (mask == 0) continue;
    nearer(lowest[node].boxes, foot_x, foot_y, 0, from_foot);
    for (; mask != 0; mask &= mask - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(mask));
      waiting.push_back({node * static_cast<std::uint32_t>(fan) + lane, from_foot[lane]});
    }
  }
  // The blocks nearest to the foot come first, because they shrink the disk most.
  std::sort(waiting.begin(), waiting.end(), [](const Region::Block& a, const Region::Block& b) {
    return a.from_foot < b.from_foot;
  });
  for (const Region::Block& block : waiting) {
    Lanes from_center;
    if ((lanes_near(lowest[block.index / fan], from_center) >> block.index % fan & 1U) != 0)
      search_block(block.index, search);
  }
  return search.touch();
}

}  // namespace medial::site
