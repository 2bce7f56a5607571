#pragma once

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

/// Whether all coordinates may be longitudes and latitudes.
inline bool can_be_degrees(const Document<Feature>& document) {
  bool possible = true;
  for_each_point(document, [&possible](Vec2 point) {
    if (!(std::abs(point.x) <= 360 && std::abs(point.y) <= pole + beyond_pole)) possible = false;
  });
  return possible;
}

}  // namespace medial::io
