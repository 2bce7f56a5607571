#include "index/first_touch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/spatial_order.h"
#include "geometry/tangent_disk.h"

namespace medial::index {
namespace {

using geometry::Site;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What rounding (u = 2^-53) may add to a distance from a box or a slab, for local coordinates
/// below 2 and distances below 4: for a box 8 u along an axis (a difference below 4, and the end of
/// a site) and 8 u for the squares, for a slab 32 u as in BoundaryTree. Boxes this much further
/// away are looked into as well.
constexpr double rounding = 0x1p-48;

/// Sets of more sites get no slab: it would be about as wide as the box.
constexpr std::size_t largest_slab = 512;

}  // namespace

FirstTouch::FirstTouch(std::span<const Site> sites, std::span<const std::uint32_t> groups) {
  std::vector<std::uint32_t> order;
  {
    std::vector<Vec2> middle(sites.size());
    std::transform(sites.begin(), sites.end(), middle.begin(),
                   [](const Site& site) { return midpoint(site.point, site.end()); });
    order = z_order(middle);
  }
  entries_.reserve(sites.size());
  for (const std::uint32_t i : order) entries_.push_back({sites[i], i, groups[i]});

  std::size_t run = block_size;
  do {
    build_level(run);
    run *= fan;
  } while (levels_.back().size() > 1);
}

/// Nothing is near to an empty set.
FirstTouch::Bounds::Bounds() {
  low_x.fill(infinity);
  low_y.fill(infinity);
  high_x.fill(-infinity);
  high_y.fill(-infinity);
}

/// The level whose lanes bound `run` entries each, above the last one.
void FirstTouch::build_level(std::size_t run) {
  const std::size_t sets = (entries_.size() + run - 1) / run;
  const std::vector<Bounds>* lower = levels_.empty() ? nullptr : &levels_.back();
  std::vector<Bounds> level(std::max<std::size_t>(1, (sets + fan - 1) / fan));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sets, 256), [&](const auto& range) {
    for (std::size_t set = range.begin(); set < range.end(); ++set) {
      Bounds& bounds = level[set / fan];
      const std::size_t lane = set % fan;
      const auto add = [&](Vec2 low, Vec2 high) {
        bounds.low_x[lane] = std::min(bounds.low_x[lane], low.x);
        bounds.low_y[lane] = std::min(bounds.low_y[lane], low.y);
        bounds.high_x[lane] = std::max(bounds.high_x[lane], high.x);
        bounds.high_y[lane] = std::max(bounds.high_y[lane], high.y);
      };
      const std::size_t begin = set * run, end = std::min(begin + run, entries_.size());
      if (lower == nullptr) {
        for (std::size_t i = begin; i < end; ++i) {
          const Vec2 a = entries_[i].site.point, b = entries_[i].site.end();
          add({std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)});
          if (entries_[i].site.is_arc()) add(entries_[i].site.apex(), entries_[i].site.apex());
        }
      } else {
        const Bounds& b = (*lower)[set];
        for (std::size_t i = 0; i < fan; ++i)
          add({b.low_x[i], b.low_y[i]}, {b.high_x[i], b.high_y[i]});
      }
      if (run > largest_slab) continue;

      const auto longest = std::max_element(
          entries_.begin() + static_cast<std::ptrdiff_t>(begin),
          entries_.begin() + static_cast<std::ptrdiff_t>(end),
          [](const Entry& a, const Entry& b) { return a.site.length < b.site.length; });
      const Vec2 normal = longest->site.normal();
      if (longest->site.is_vertex()) continue;
      double low = infinity, high = -infinity;
      for (std::size_t i = begin; i < end; ++i) {
        const Site& site = entries_[i].site;
        for (const Vec2 p : {site.point, site.end(), site.is_arc() ? site.apex() : site.point}) {
          low = std::min(low, dot(normal, p));
          high = std::max(high, dot(normal, p));
        }
      }
      bounds.normal_x[lane] = normal.x;
      bounds.normal_y[lane] = normal.y;
      bounds.low[lane] = low;
      bounds.high[lane] = high;
    }
  });
  levels_.push_back(std::move(level));
}

std::optional<FirstTouch::Touch> FirstTouch::find(Vec2 foot, Vec2 direction, double largest,
                                                  std::uint32_t group, std::uint32_t first,
                                                  std::uint32_t last) const {
  std::optional<Touch> found;
  double radius = largest;
  Vec2 center = foot + radius * direction;
  struct Waiting {
    std::uint32_t level, index;
  };
  // Three brothers wait on each of at most 16 levels.
  std::array<Waiting, 3 * 16 + fan> stack;
  std::size_t size = 0;
  stack[size++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0};
  while (size > 0) {
    const Waiting top = stack[--size];
    const Bounds& bounds = levels_[top.level][top.index];
    const double reach = radius + rounding;
    // Branchless, so that a compiler can treat the four side by side.
    std::array<double, fan> from_foot, from_center, beside;
    for (std::size_t i = 0; i < fan; ++i) {
      const auto larger = [](double a, double b) { return a > b ? a : b; };
      const auto squared_distance = [&](Vec2 p) {
        const double x = larger(larger(bounds.low_x[i] - p.x, p.x - bounds.high_x[i]), 0);
        const double y = larger(larger(bounds.low_y[i] - p.y, p.y - bounds.high_y[i]), 0);
        return x * x + y * y;
      };
      const double along = bounds.normal_x[i] * center.x + bounds.normal_y[i] * center.y;
      from_foot[i] = squared_distance(foot);
      from_center[i] = squared_distance(center);
      beside[i] = larger(bounds.low[i] - along, along - bounds.high[i]);
    }
    // The one nearest to the foot goes on top: there the disk shrinks most.
    const std::size_t bottom = size;
    std::array<double, fan> waiting;
    for (std::uint32_t i = 0; i < fan; ++i) {
      if (from_center[i] >= reach * reach || beside[i] >= reach) continue;
      std::size_t at = size++;
      for (; at > bottom && waiting[at - 1 - bottom] < from_foot[i]; --at) {
        stack[at] = stack[at - 1];
        waiting[at - bottom] = waiting[at - 1 - bottom];
      }
      stack[at] = {top.level, static_cast<std::uint32_t>(top.index * fan) + i};
      waiting[at - bottom] = from_foot[i];
    }
    if (top.level > 0) {
      for (std::size_t i = bottom; i < size; ++i) --stack[i].level;
      continue;
    }
    for (; size > bottom; --size) {
      const std::size_t begin = stack[size - 1].index * block_size;
      for (std::size_t i = begin; i < std::min(begin + block_size, entries_.size()); ++i) {
        const Entry& entry = entries_[i];
        if (entry.group != group || (entry.index >= first && entry.index <= last)) continue;
        const double inside = radius + rounding;
        if (geometry::squared_distance(entry.site, center) >= inside * inside) continue;
        const double smaller = geometry::touching_radius(foot, direction, entry.site);
        if (!(smaller < radius)) continue;
        radius = smaller;
        center = foot + radius * direction;
        found = {entry.index, radius};
      }
    }
  }
  return found;
}

}  // namespace medial::index
