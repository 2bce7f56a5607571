#pragma once

#include <span>
#include <vector>

#include "base/arc.h"
#include "medial/geometry.h"

namespace medial {

/// A reflection or a rotation by quarter turns. Does not round.
struct QuarterMap {
  bool swaps = false, negates_x = false, negates_y = false;

  bool mirrors() const { return swaps != (negates_x != negates_y); }
  Vec2 to_image(Vec2 p) const { return negated(swaps ? Vec2{p.y, p.x} : p); }
  Vec2 to_input(Vec2 p) const {
    const Vec2 q = negated(p);
    return swaps ? Vec2{q.y, q.x} : q;
  }

 private:
  Vec2 negated(Vec2 p) const {  // never to -0
    return {negates_x ? 0 - p.x : p.x, negates_y ? 0 - p.y : p.y};
  }
};

/// The maps by which the image has the lowest first point, and the lowest one inside its box, as
/// the box may be a frame around all else: mostly one. All images of the points under such maps
/// have the same images under their own best ones.
std::vector<QuarterMap> best_maps(std::span<const Vec2> points);

/// Of the best maps of an outline's vertices, the one by which the image's edges, sorted, come
/// first, whichever way they run: where there is another such map, the outline is its own image.
QuarterMap best_map(std::span<const BulgeArc> edges);

}  // namespace medial
