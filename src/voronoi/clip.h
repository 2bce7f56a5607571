#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "medial/axis.h"
#include "medial/shape.h"

namespace medial::voronoi {

/// An edge as a rational quadratic curve with end weights 1. Its parameter is t / (1 - t) for the
/// usual t from 0 to 1. If the weight of the control point is large, most of the curve is at
/// parameters next to the ends, and t would be inaccurate at one of them.
struct ConicEdge {
  static constexpr double last = std::numeric_limits<double>::infinity();
  Disk from, control, to;
  double weight = 1;

  Disk at(double s) const;
  /// The exact part between two parameters, as a curve of the same kind.
  ConicEdge part(double begin, double end) const;
};

/// The part of an edge from one parameter to another.
struct ClippedPart {
  double from = 0, to = ConicEdge::last;
};

/// The parts of an edge strictly inside a box, in order: none, all of it, or several.
void clip(const ConicEdge& edge, const Box& box, std::vector<ClippedPart>& parts);

/// Whether a point lies strictly inside a box.
inline bool is_inside(const Box& box, Vec2 p) {
  return p.x > box.low.x && p.x < box.high.x && p.y > box.low.y && p.y < box.high.y;
}

/// A place on the border of a box, counter-clockwise from its low corner: the side (0 below, 1
/// right, 2 above, 3 left) plus the fraction along it.
double place_on_border(const Box& box, Vec2 p);

/// Moves a point exactly onto the nearest place of the border.
Vec2 onto_border(const Box& box, Vec2 p);

/// Corner k of a box, counter-clockwise from the low one.
inline Vec2 corner_of(const Box& box, std::size_t k) {
  return {k == 1 || k == 2 ? box.high.x : box.low.x, k >= 2 ? box.high.y : box.low.y};
}

}  // namespace medial::voronoi
