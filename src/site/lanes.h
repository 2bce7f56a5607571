#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/numbers.h"
#include "base/pair.h"
#include "medial/geometry.h"
#include "site/site.h"

// SIMD kernels of both trees: tests of four boxes or two sites at a time.

namespace medial::site {

constexpr float endless = std::numeric_limits<float>::infinity();
constexpr Lanes all_endless{endless, endless, endless, endless};
inline float least_of(Lanes v) { return std::min({v[0], v[1], v[2], v[3]}); }

/// A box under construction.
struct Extent : Box {
  Extent() : Box(nothing()) {}
  using Box::add;
  void add(const Site& site) {
    add(site.point);
    add(site.end());
    if (site.is_arc()) add(site.apex());
  }
};

/// The nearest float that is not above (rounded_down) or not below (rounded_up) v.
inline float rounded_down(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) <= v ? f : std::nextafter(f, -endless);
}
inline float rounded_up(double v) { return -rounded_down(-v); }

/// The boxes of a node's four children. Nothing is near an empty box.
struct alignas(64) Boxes {
  Lanes low_x = all_endless, low_y = all_endless, high_x = -all_endless, high_y = -all_endless;

  void set(std::size_t lane, const Extent& extent) {
    low_x[lane] = rounded_down(extent.low.x);
    low_y[lane] = rounded_down(extent.low.y);
    high_x[lane] = rounded_up(extent.high.x);
    high_y[lane] = rounded_up(extent.high.y);
  }
  /// Sets a lane to the box around all four boxes of another node.
  void set(std::size_t lane, const Boxes& all) {
    low_x[lane] = least_of(all.low_x);
    low_y[lane] = least_of(all.low_y);
    high_x[lane] = -least_of(-all.high_x);
    high_y[lane] = -least_of(-all.high_y);
  }
};

/// Sets squared[i] to the squared distance of (x, y) from box i. Returns the lanes where it is
/// below `limit`, as bits.
inline std::uint32_t nearer(const Boxes& boxes, float x, float y, float limit, Lanes& squared) {
  const Lanes dx = larger(larger(boxes.low_x - x, x - boxes.high_x), Lanes{});
  const Lanes dy = larger(larger(boxes.low_y - y, y - boxes.high_y), Lanes{});
  squared = dx * dx + dy * dy;
  return bits_of(squared < limit);
}

/// Which of two segments or vertices are no farther from c than the root of `squared`, as bits.
/// Consistent with squared_distance().
inline std::uint32_t reached_of_two(const Site& a, const Site& b, Vec2 c, double squared) {
  const Pair x = c.x - Pair{a.point.x, b.point.x}, y = c.y - Pair{a.point.y, b.point.y};
  const Pair along_x{a.direction.x, b.direction.x}, along_y{a.direction.y, b.direction.y};
  const Pair foot = along_x * x + along_y * y;
  const Pair s = smaller(larger(foot, Pair{}), Pair{a.length, b.length});
  const Pair dx = x - s * along_x, dy = y - s * along_y;
  return bits_of(dx * dx + dy * dy <= squared);
}

/// carrier_distance() of two points from an arc, and squared_distance().
struct TwoDistances {
  Pair carrier, squared;
};
inline TwoDistances distances_from_arc(const Site& arc, Pair x, Pair y) {
  const Vec2 normal = arc.normal(), end = arc.end();
  const Pair dx = x - arc.point.x, dy = y - arc.point.y, ex = x - end.x, ey = y - end.y;
  const Pair toward_x = normal.x - arc.curvature * dx, toward_y = normal.y - arc.curvature * dy;
  const Pair size = root_of(toward_x * toward_x + toward_y * toward_y);
  const Pair from_start = dx * dx + dy * dy, from_end = ex * ex + ey * ey;
  const Pair height = (normal.x * dx + normal.y * dy) - 0.5 * arc.curvature * from_start;
  const Pair distance = 2 * height / (1 + size);
  const Pair along = arc.direction.x * dx + arc.direction.y * dy;
  const Pair forward = normal.x * toward_x + normal.y * toward_y;
  const auto faces = (along >= 0) & (forward >= 0) & (2 * along <= arc.length * (size + forward));
  return {distance, faces ? distance * distance : smaller(from_start, from_end)};
}

/// The same for any carrier.
inline Pair carrier_distances(const Site& site, Pair x, Pair y) {
  if (site.is_arc()) return distances_from_arc(site, x, y).carrier;
  const Pair dx = x - site.point.x, dy = y - site.point.y;
  return site.is_vertex() ? root_of(dx * dx + dy * dy)
                          : site.direction.x * dy - site.direction.y * dx;
}

}  // namespace medial::site
