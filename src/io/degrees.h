#pragma once

#include <algorithm>
#include <cmath>

#include "medial/document.h"

namespace medial::io {

template <class Action>
void for_each_point(const Document<Feature>& document, Action action) {
  for (const Feature& feature : document.items) {
    for (const Ring& ring : feature.rings)
      for (const Vec2 point : ring.points) action(point);
    for (const Contour& contour : feature.contours)
      for (const Vec2 point : contour.points) action(point);
    for (const Chain& chain : feature.chains)
      for (const Vec2 point : chain.points) action(point);
  }
}

/// The largest latitude; rounding may have moved the pole a little further.
constexpr double pole = 90, beyond_pole = 1e-9;

/// The largest coordinates, whatever their signs.
inline Vec2 reach_of(const Document<Feature>& document) {
  Vec2 reach;
  for_each_point(document, [&reach](Vec2 point) {
    reach = {std::max(reach.x, std::abs(point.x)), std::max(reach.y, std::abs(point.y))};
  });
  return reach;
}

/// Whether coordinates of this reach may be longitudes and latitudes, in a unit of so many degrees.
inline bool can_be_angles(Vec2 reach, double unit) {
  return unit * reach.x <= 360 && unit * reach.y <= pole + beyond_pole;
}

}  // namespace medial::io
