#include "support/offset_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

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

std::vector<Ring> rings_of(const Shape& shape) {
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    Ring& ring = rings.emplace_back();
    ring.points.assign(loop.begin(), loop.end());
    for (std::size_t k = 0; k < loop.size(); ++k)
      ring.bulges.push_back(shape.bulge(shape.loop_begin[i] + k));
  }
  return rings;
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

/// What is wrong with a region, if anything.
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

/// Whether these may be the rings of one region at two clearances: as many, and each of one around
/// the middle of one of the other. (Where a bay becomes a hole just as another hole is filled,
/// numbers tell nothing.)
bool may_be_same(const OffsetRegion& a, const OffsetRegion& b) {
  if (a.rings.size() != b.rings.size()) return false;
  const auto box_of = [](const Ring& ring) {
    Box box{ring.points[0], ring.points[0]};
    for (const Vec2 p : ring.points) {
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
    return box;
  };
  const auto holds_middle = [](const Box& box, const Box& other) {
    const Vec2 p = midpoint(other.low, other.high);
    return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y;
  };
  return std::ranges::all_of(a.rings, [&](const Ring& ring) {
    return std::ranges::any_of(b.rings, [&, box = box_of(ring)](const Ring& other) {
      return holds_middle(box, box_of(other)) && holds_middle(box_of(other), box);
    });
  });
}

}  // namespace

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

bool is_steady(const Shape& shape, double clearance, double slack) {
  if (std::abs(clearance) <= slack) return false;
  const std::vector<double> levels{clearance - slack, clearance - slack / 2, clearance,
                                   clearance + slack / 2, clearance + slack};
  const auto offsets = offset_curves(shape, levels);
  if (!offsets) return false;
  std::vector<int> children(offsets->regions.size(), 0);
  for (const OffsetRegion& region : offsets->regions) {
    if (region.parent == no_region) continue;
    ++children[region.parent];
    if (!may_be_same(region, offsets->regions[region.parent])) return false;
  }
  for (std::size_t i = 0; i < children.size(); ++i)
    if (offsets->regions[i].clearance < levels.back() && children[i] != 1) return false;
  return true;
}

PixelCount count_by_pixels(const Shape& shape, double clearance, std::size_t pixels) {
  const verify_detail::DistanceTree tree(shape);
  const std::vector<Ring> own = rings_of(shape);
  const Box box = bounding_box(shape);
  const double reach = std::max(-clearance, 0.0);
  const Vec2 low = box.low - Vec2{reach, reach}, size = box.high - box.low + 2 * Vec2{reach, reach};
  const double step = std::max(size.x, size.y) / static_cast<double>(pixels);
  // A rim of pixels outside on all sides.
  const auto columns = static_cast<std::size_t>(std::ceil(size.x / step)) + 3;
  const auto rows = static_cast<std::size_t>(std::ceil(size.y / step)) + 3;
  std::vector<bool> in(columns * rows);
  std::vector<double> beyond(columns * rows);  // how far from the curve, about
  for (std::size_t y = 0; y < rows; ++y) {
    const double level = low.y + (static_cast<double>(y) - 1) * step;
    // Only edges that a horizontal line meets wind around its points.
    std::vector<Ring> near;
    for (const Ring& ring : own) {
      for_edges(ring, [&](const BoundaryEdge& edge) {
        const double room = std::abs(edge.bulge) * distance(edge.start, edge.end);
        if (std::min(edge.start.y, edge.end.y) - room <= level &&
            std::max(edge.start.y, edge.end.y) + room >= level)
          near.push_back({{edge.start, edge.end}, RingRole::any, {edge.bulge}});
      });
    }
    double expected = step;
    for (std::size_t x = 0; x < columns; ++x) {
      const Vec2 p{low.x + (static_cast<double>(x) - 1) * step, level};
      expected = tree.distance(p, expected + step);
      int around = 0;
      for (const Ring& edge : near)
        around += winding_of({edge.points[0], edge.points[1], edge.bulges[0]}, p);
      const double of_p = around != 0 ? expected : -expected;
      in[y * columns + x] = of_p > clearance;
      beyond[y * columns + x] = std::abs(of_p - clearance);
    }
  }
  // Inside by eight neighbours, outside by four: each region has one boundary more than holes.
  DisjointSets sets(columns * rows);
  const auto join = [&](std::size_t a, std::size_t b) {
    if (in[a] == in[b]) sets.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  };
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) {
      const std::size_t here = y * columns + x;
      if (x + 1 < columns) join(here, here + 1);
      if (y + 1 < rows) join(here, here + columns);
      if (y + 1 < rows && x + 1 < columns && in[here]) join(here, here + columns + 1);
      if (y + 1 < rows && x > 0 && in[here]) join(here, here + columns - 1);
    }
  }
  // What pixels break off at the tip of a cusp is nowhere far from the curve.
  std::vector<bool> counts(in.size(), false);
  for (std::uint32_t i = 0; i < in.size(); ++i)
    if (beyond[i] > 1.5 * step) counts[sets.find(i)] = true;
  PixelCount count;
  std::size_t outside = 0;
  for (std::size_t i = 0; i < in.size(); ++i)
    if (counts[i]) ++(in[i] ? count.regions : outside);
  count.rings = count.regions + outside - 1;
  return count;
}

}  // namespace medial::test
