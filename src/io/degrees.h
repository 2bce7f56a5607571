#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

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

/// The points of documents with the lowest and the highest coordinates.
struct Extremes {
  std::optional<std::array<Vec2, 4>> points;

  void add(Vec2 p) {
    if (!points) points = {p, p, p, p};
    auto& [west, east, south, north] = *points;
    if (p.x < west.x) west = p;
    if (p.x > east.x) east = p;
    if (p.y < south.y) south = p;
    if (p.y > north.y) north = p;
  }
  void add(const Document<Feature>& document) {
    for_each_point(document, [this](Vec2 point) { add(point); });
  }
  /// The largest coordinates, whatever their signs.
  Vec2 reach() const {
    if (!points) return {};
    const auto& [west, east, south, north] = *points;
    return {std::max(std::abs(west.x), std::abs(east.x)),
            std::max(std::abs(south.y), std::abs(north.y))};
  }
};

inline Extremes extremes_of(const Document<Feature>& document) {
  Extremes extremes;
  extremes.add(document);
  return extremes;
}

/// Whether coordinates of this reach may be longitudes and latitudes, in a unit of so many degrees.
inline bool can_be_angles(Vec2 reach, double unit) {
  return unit * reach.x <= 360 && unit * reach.y <= pole + beyond_pole;
}

}  // namespace medial::io
