#pragma once

#include <algorithm>
#include <cmath>

#include "medial/vec2.h"

namespace medial::geometry {

/// A site as the kernels see it: a segment point + s * direction, 0 <= s <= length, with the
/// interior on its left; or a vertex, which has direction (0, 0) and length 0. One formula serves
/// both.
struct Site {
  Vec2 point;
  Vec2 direction;  ///< unit length, or (0, 0) for a vertex
  double length = 0;

  bool is_vertex() const { return length == 0; }
  Vec2 normal() const { return left_of(direction); }
  Vec2 end() const { return point + length * direction; }
};

inline Site make_segment(Vec2 start, Vec2 end) {
  const Vec2 d = end - start;
  const double length = norm(d);
  return {start, (1 / length) * d, length};
}

inline Site make_vertex(Vec2 point) { return {point, {0, 0}, 0}; }

/// Whether segment `before` ends where segment `after` begins. An end is a product and a sum: it is
/// off by less than four roundings of a local coordinate.
inline bool meets(const Site& before, const Site& after) {
  constexpr double same_point = 0x1p-50;
  const Vec2 gap = before.end() - after.point;
  return std::abs(gap.x) <= same_point && std::abs(gap.y) <= same_point;
}

/// Parameter of the site's point nearest to c.
inline double foot_parameter(const Site& site, Vec2 c) {
  return std::clamp(dot(site.direction, c - site.point), 0.0, site.length);
}

inline Vec2 foot(const Site& site, Vec2 c) {
  return site.point + foot_parameter(site, c) * site.direction;
}

/// Distance from c to the closed site. Error: about two units in the last place of |c - point|.
inline double squared_distance(const Site& site, Vec2 c) {
  const Vec2 d = c - site.point;
  const double s = std::min(std::max(dot(site.direction, d), 0.0), site.length);
  return squared_norm(d - s * site.direction);
}

/// Distance to the site's carrier: the whole line, positive on its left, or the vertex.
inline double carrier_distance(const Site& site, Vec2 c) {
  return site.is_vertex() ? norm(c - site.point) : cross(site.direction, c - site.point);
}

}  // namespace medial::geometry
