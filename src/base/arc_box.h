#pragma once

#include <cmath>

#include "base/arc.h"

namespace medial {

/// A box around an arc. No point of at most a half circle is farther from the chord than the arc's
/// height; no point of a longer arc is farther than the diameter.
inline Box box_around(const BulgeArc& arc) {
  Box box{arc.start, arc.start};
  box.add(arc.end);
  const double chord = norm(arc.chord()), bulge = std::abs(arc.bulge);
  const double reach = 0.5 * chord * (bulge <= 1 ? bulge : (1 + bulge * bulge) / bulge);
  return {box.low - reach * Vec2{1, 1}, box.high + reach * Vec2{1, 1}};
}

}  // namespace medial
