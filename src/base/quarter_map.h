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

/// The maps, usually one, whose image has the lexicographically lowest point and, on a tie, the
/// lowest point inside the box (the box may be a frame around all other points). The result does
/// not depend on how the points are turned or mirrored: all their images have the same best images.
std::vector<QuarterMap> best_maps(std::span<const Vec2> points);

/// Of the best maps of an outline's vertices, the map whose image has the lowest sorted list of
/// edges, ignoring their directions. If several maps tie, the outline is symmetric.
QuarterMap best_map(std::span<const BulgeArc> edges);

}  // namespace medial
