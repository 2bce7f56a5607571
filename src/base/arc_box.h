#pragma once

#include <cmath>

#include "base/arc.h"

namespace medial {

/// A box around an arc: no point of at most half a circle is farther from the chord than its
/// height, none of a circle farther than its diameter.
inline Box box_around(const BulgeArc& arc) {
  Box box{arc.start, arc.start};
  box.add(arc.end);
  const double chord = norm(arc.chord()), bulge = std::abs(arc.bulge);
  const double reach = 0.5 * chord * (bulge <= 1 ? bulge : (1 + bulge * bulge) / bulge);
  return {box.low - reach * Vec2{1, 1}, box.high + reach * Vec2{1, 1}};
}

}  // namespace medial
