#include "support/offset_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "base/arc.h"
#include "base/disjoint_sets.h"
#include "support/generate.h"
#include "verify/boundary_edge.h"
#include "verify/distance_tree.h"

namespace medial::test {

namespace {

using verify_detail::BoundaryEdge;

template <class Each>
void for_edges(const Ring& ring, const Each& each) {
  const std::size_t count = ring.points.size();
  for (std::size_t i = 0; i < count; ++i)
    each(BoundaryEdge{ring.points[i], ring.points[i + 1 == count ? 0 : i + 1],
                      ring.bulges.empty() ? 0 : ring.bulges[i]});
}

double signed_area(const Ring& ring) {
  double sum = 0;
  for_edges(ring, [&](const BoundaryEdge& edge) {
    const Vec2 origin = ring.points[0];
    sum += cross(edge.start - origin, edge.end - origin) / 2;
    if (edge.bulge != 0) sum += area_beside_chord(edge);
  });
  return sum;
}

/// How often an edge winds around a point, counted where it passes the ray to the right.
int winding_of(const BoundaryEdge& edge, Vec2 p) {
  const Vec2 u = edge.start - p, v = edge.end - p;
  const double side = cross(u, v);
  const bool up = u.y <= 0 && v.y > 0, down = u.y > 0 && v.y <= 0;
  // What is on the chord itself counts as right of what goes up, left of what goes down, and above
  // of what is level.
  const bool level = !up && !down && side == 0;
  const bool left = side > 0 || (side == 0 && (down || (level && v.x > u.x)));
  const bool right = side < 0 || (side == 0 && (up || (level && v.x < u.x)));
  int sum = up && left ? 1 : down && right ? -1 : 0;
  if (edge.bulge == 0) return sum;
  // Between the chord and the arc.
  const double beside = verify_detail::distance_to_carrier(p, edge);
  if (edge.bulge > 0 && right && beside > 0) ++sum;
  if (edge.bulge < 0 && left && beside < 0) --sum;
  return sum;
}

/// A point of a ring that is on no line of symmetry.
Vec2 some_point(const Ring& ring) {
  constexpr double share = 0.3819;
  const BoundaryEdge first{ring.points[0], ring.points[1],
                           ring.bulges.empty() ? 0 : ring.bulges[0]};
  return verify_detail::point_at(first, share * verify_detail::length_of(first));
}

/// A text about what is wrong with a region; empty if nothing is.
std::string fault_of(const Offsets& offsets, std::size_t i) {
  const OffsetRegion& region = offsets.regions[i];
  if (region.rings.empty()) return "a region without rings";
  for (std::size_t k = 0; k < region.rings.size(); ++k) {
    const bool outer = k == 0;
    if (region.rings[k].role != (outer ? RingRole::outer : RingRole::hole)) return "a wrong role";
    double around = 0;
    constexpr double half_circle = 1 + 1e-9;
    for (const double bulge : region.rings[k].bulges)
      if (!(std::abs(bulge) <= half_circle)) return "an edge of more than a half circle";
    for_edges(region.rings[k], [&](const BoundaryEdge& edge) {
      around += distance(edge.start, edge.end) * (1 + std::abs(edge.bulge));
    });
    const double enclosed = signed_area(region.rings[k]);
    if ((outer ? enclosed : -enclosed) < -4 * offsets.tolerance * around)
      return "a wrong orientation";
  }
  if (region.parent == no_region) {
    for (std::size_t k = 0; k < i; ++k)
      if (offsets.regions[k].clearance < region.clearance) {
        const Vec2 p = some_point(region.rings[0]);
        if (winding(offsets.regions[k].rings, p) != 0) return "a region without its parent";
      }
    return "";
  }
  if (region.parent >= i) return "a parent that comes later";
  const OffsetRegion& parent = offsets.regions[region.parent];
  if (!(parent.clearance < region.clearance)) return "a parent of no smaller clearance";
  for (std::size_t k = region.parent; k < i; ++k) {
    const double between = offsets.regions[k].clearance;
    if (between > parent.clearance && between < region.clearance)
      return "a parent that is not of the next clearance";
  }
  const Vec2 p = some_point(region.rings[0]);
  if (region.clearance - parent.clearance > 1e3 * offsets.tolerance &&
      winding(parent.rings, p) != 1)
    return "a parent that does not hold its child";
  return "";
}

std::vector<Box> boxes_of(const OffsetRegion& region) {
  std::vector<Box> boxes;
  for (const Ring& ring : region.rings) {
    Box& box = boxes.emplace_back(Box{ring.points[0], ring.points[0]});
    for (const Vec2 p : ring.points) box.add(p);
  }
  return boxes;
}

/// Whether these may be the rings of one region at two clearances: as many, and each of one around
/// the middle of one of the other. (Where a bay becomes a hole just as another hole is filled,
/// numbers tell nothing.)
bool may_be_same(const OffsetRegion& a, const OffsetRegion& b) {
  if (a.rings.size() != b.rings.size()) return false;
  const auto holds_middle = [](const Box& box, const Box& other) {
    const Vec2 p = midpoint(other.low, other.high);
    return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y;
  };
  const std::vector<Box> others = boxes_of(b);
  return std::ranges::all_of(boxes_of(a), [&](const Box& box) {
    return std::ranges::any_of(others, [&](const Box& other) {
      return holds_middle(box, other) && holds_middle(other, box);
    });
  });
}

/// The clearances at which a curve and its neighbours up to `slack` away are looked at.
std::array<double, 5> around_level(double level, double slack) {
  return {level - slack, level - slack / 2, level, level + slack / 2, level + slack};
}

/// Whether each region at the first of some clearances holds one at each of the others, which may
/// be the same.
bool is_steady_in(const Offsets& offsets, std::span<const double> levels) {
  const auto& regions = offsets.regions;
  const auto at = [&](double level) {
    const auto first = std::ranges::lower_bound(regions, level, {}, &OffsetRegion::clearance);
    const auto last = std::ranges::upper_bound(regions, level, {}, &OffsetRegion::clearance);
    return std::pair(first - regions.begin(), last - regions.begin());
  };
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const auto [below, below_end] = at(levels[k - 1]);
    const auto [above, above_end] = at(levels[k]);
    std::vector<bool> held(static_cast<std::size_t>(below_end - below), false);
    if (below_end - below != above_end - above) return false;
    for (auto i = above; i < above_end; ++i) {
      auto parent = static_cast<std::size_t>(i);
      while (parent != no_region && regions[parent].clearance > levels[k - 1])
        parent = regions[parent].parent;
      if (parent == no_region) return false;
      const auto place = parent - static_cast<std::size_t>(below);
      if (held[place] || !may_be_same(regions[static_cast<std::size_t>(i)], regions[parent]))
        return false;
      held[place] = true;
    }
  }
  return true;
}

/// A grid over a shape grown by `reach`, with a rim of pixels outside on all sides.
struct PixelGrid {
  Vec2 low;
  double step = 0;
  std::size_t columns = 0, rows = 0;

  PixelGrid(const Box& box, double reach, std::size_t pixels) {
    const Vec2 size = box.high - box.low + 2 * Vec2{reach, reach};
    step = std::max(size.x, size.y) / static_cast<double>(pixels);
    low = box.low - Vec2{reach + step, reach + step};
    columns = static_cast<std::size_t>(std::ceil(size.x / step)) + 3;
    rows = static_cast<std::size_t>(std::ceil(size.y / step)) + 3;
  }
  Vec2 at(std::size_t x, std::size_t y) const {
    return low + step * Vec2{static_cast<double>(x), static_cast<double>(y)};
  }
  /// The first place among `count` that is not below a coordinate less `room`.
  std::size_t from(double coordinate, double origin, double room, std::size_t count) const {
    const double place = std::ceil((coordinate - room - origin) / step);
    return place > 0 ? std::min(static_cast<std::size_t>(place), count) : 0;
  }
};

/// How often rings wind around the pixels of a grid, row by row.
class WindingRows {
 public:
  WindingRows(const std::vector<Ring>& rings, const PixelGrid& grid)
      : grid_(grid), in_row_(grid.rows) {
    for (const Ring& ring : rings) {
      for_edges(ring, [&](const BoundaryEdge& edge) {
        const auto [low, high] = std::minmax(edge.start.y, edge.end.y);
        const double room = room_of(edge) + grid.step;
        const std::size_t end = grid.from(high, grid.low.y, -room, grid.rows);
        for (std::size_t y = grid.from(low, grid.low.y, room, grid.rows); y < end; ++y)
          in_row_[y].push_back(edge);
      });
    }
  }
  std::vector<int> row(std::size_t y) const {
    std::vector<int> around(grid_.columns, 0), change(grid_.columns + 1, 0);
    const double level = grid_.at(0, y).y;
    for (const BoundaryEdge& edge : in_row_[y]) {
      // Behind an edge it does not count, before it always as much.
      double low = std::min(edge.start.x, edge.end.x), high = std::max(edge.start.x, edge.end.x);
      if (edge.bulge == 0) {
        const double share = (level - edge.start.y) / (edge.end.y - edge.start.y);
        if (!(share >= -1 && share <= 2)) continue;
        const double cut = edge.start.x + share * (edge.end.x - edge.start.x);
        low = high = std::clamp(cut, low, high);
      }
      const double room = room_of(edge) + 2 * grid_.step;
      const std::size_t begin = grid_.from(low, grid_.low.x, room, grid_.columns);
      const std::size_t end = grid_.from(high, grid_.low.x, -room, grid_.columns);
      for (std::size_t x = begin; x < end; ++x) around[x] += winding_of(edge, grid_.at(x, y));
      if (begin > 0) {
        const int before = winding_of(edge, grid_.at(begin - 1, y));
        change[0] += before;
        change[begin] -= before;
      }
    }
    int sum = 0;
    for (std::size_t x = 0; x < grid_.columns; ++x) around[x] += sum += change[x];
    return around;
  }

 private:
  static double room_of(const BoundaryEdge& edge) {
    return std::abs(edge.bulge) * distance(edge.start, edge.end);
  }
  const PixelGrid& grid_;
  std::vector<std::vector<BoundaryEdge>> in_row_;
};

/// Pixels side by side that are all inside, or all outside.
struct RowRun {
  std::size_t begin = 0, end = 0;
  bool in = false;
  bool far = false;  ///< whether one of them is further than one and a half pixels from the curve
  std::uint32_t set = 0;
};

}  // namespace

Measures measures_of(const Offsets& offsets, double scale) {
  struct One {
    double clearance, area, length;
    std::size_t rings;
  };
  std::vector<One> all;
  for (const OffsetRegion& r : offsets.regions)
    all.push_back({r.clearance, area(r) / (scale * scale), length(r) / scale, r.rings.size()});
  std::sort(all.begin(), all.end(), [](const One& a, const One& b) {
    return a.clearance != b.clearance ? a.clearance < b.clearance : a.area < b.area;
  });
  Measures out;
  for (const One& one : all) {
    out.rings.push_back(one.rings);
    out.areas.push_back(one.area);
    out.lengths.push_back(one.length);
  }
  return out;
}

int winding(const std::vector<Ring>& rings, Vec2 p) {
  int sum = 0;
  for (const Ring& ring : rings)
    for_edges(ring, [&](const BoundaryEdge& edge) { sum += winding_of(edge, p); });
  return sum;
}

OffsetCheck check_offsets(const Shape& shape, const Offsets& offsets, int inside, int probes) {
  OffsetCheck check;
  const verify_detail::DistanceTree tree(shape);
  std::map<double, std::vector<Ring>> levels;
  for (std::size_t i = 0; i < offsets.regions.size(); ++i) {
    const OffsetRegion& region = offsets.regions[i];
    if (const std::string fault = fault_of(offsets, i); !fault.empty()) check.fault = fault;
    auto& level = levels[region.clearance];
    level.insert(level.end(), region.rings.begin(), region.rings.end());
    const double expected = std::abs(region.clearance);
    for (const Ring& ring : region.rings) {
      for_edges(ring, [&](const BoundaryEdge& edge) {
        const double length = verify_detail::length_of(edge);
        for (int k = 0; k <= inside; ++k) {
          const Vec2 p = verify_detail::point_at(edge, length * k / (inside + 1));
          const double error = std::abs(tree.distance(p, expected) - expected);
          ++check.points;
          if (error >= check.largest_error) check.largest_error = error, check.worst = p;
        }
      });
    }
  }
  const std::vector<Ring> own = rings_of(shape);
  const Box box = bounding_box(shape);
  const double size = diagonal(box);
  Random random(offsets.regions.size());
  for (const auto& [clearance, rings] : levels) {
    const double reach = std::max(-clearance, 0.0);
    for (int i = 0; i < probes; ++i) {
      const Vec2 p{random.between(box.low.x - reach, box.high.x + reach),
                   random.between(box.low.y - reach, box.high.y + reach)};
      const double away = tree.distance(p, size);
      const double of_p = winding(own, p) != 0 ? away : -away;
      if (std::abs(of_p - clearance) < 1e-9 * (size + reach)) continue;
      if (winding(rings, p) != (of_p > clearance ? 1 : 0)) {
        check.fault = "a point on the wrong side";
        check.worst = p;
      }
    }
  }
  return check;
}

std::vector<bool> are_steady(const Shape& shape, std::span<const double> clearances,
                             std::span<const double> slacks) {
  std::vector<double> levels;
  for (std::size_t i = 0; i < clearances.size(); ++i)
    if (std::abs(clearances[i]) > slacks[i])
      for (const double level : around_level(clearances[i], slacks[i])) levels.push_back(level);
  const auto offsets = offset_curves(shape, levels);
  std::vector<bool> steady;
  for (std::size_t i = 0; i < clearances.size(); ++i)
    steady.push_back(offsets && std::abs(clearances[i]) > slacks[i] &&
                     is_steady_in(*offsets, around_level(clearances[i], slacks[i])));
  return steady;
}

PixelCount count_by_pixels(const Shape& shape, double clearance, std::size_t pixels) {
  const verify_detail::DistanceTree tree(shape);
  const PixelGrid grid(bounding_box(shape), std::max(-clearance, 0.0), pixels);
  const WindingRows windings(rings_of(shape), grid);
  DisjointSets sets;
  std::vector<std::uint32_t> far_in, far_out;
  std::vector<RowRun> before, runs;
  double expected = grid.step;
  for (std::size_t y = 0; y < grid.rows; ++y) {
    const std::vector<int> around = windings.row(y);
    std::swap(before, runs);
    runs.clear();
    for (std::size_t x = 0; x < grid.columns;) {
      expected = tree.distance(grid.at(x, y), expected + grid.step);
      const double beyond = (around[x] != 0 ? expected : -expected) - clearance;
      const bool in = beyond > 0, far = std::abs(beyond) > 1.5 * grid.step;
      // As far from the curve the next pixels are on the same side of it, and nearly as far.
      const double sure = std::floor(std::abs(beyond) / grid.step) - 2;
      const std::size_t end =
          sure < 1 ? x + 1 : std::min(x + 1 + static_cast<std::size_t>(sure), grid.columns);
      if (runs.empty() || runs.back().in != in) runs.push_back({x, x, in, false, sets.add()});
      runs.back().end = end;
      runs.back().far |= far;
      x = end;
    }
    // Inside by eight neighbours, outside by four: each region has one boundary more than holes.
    for (std::size_t i = 0, k = 0; i < runs.size(); ++i) {
      while (k < before.size() && before[k].end < runs[i].begin) ++k;
      for (std::size_t j = k; j < before.size() && before[j].begin <= runs[i].end; ++j) {
        const bool corner = before[j].end == runs[i].begin || before[j].begin == runs[i].end;
        if (before[j].in == runs[i].in && (runs[i].in || !corner))
          sets.join(before[j].set, runs[i].set);
      }
    }
    for (const RowRun& run : runs)
      if (run.far) (run.in ? far_in : far_out).push_back(run.set);
  }
  // The part that pixels cut off at the tip of a cusp is close to the curve.
  const auto count_sets = [&](std::vector<std::uint32_t>& far) {
    for (std::uint32_t& set : far) set = sets.find(set);
    std::ranges::sort(far);
    return static_cast<std::size_t>(std::unique(far.begin(), far.end()) - far.begin());
  };
  PixelCount count;
  count.regions = count_sets(far_in);
  count.rings = count.regions + count_sets(far_out) - 1;
  return count;
}

}  // namespace medial::test
