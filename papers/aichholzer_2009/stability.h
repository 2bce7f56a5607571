#pragma once

#include <cstddef>

#include "medial/axis.h"

namespace medial::papers {

/// How far an axis is from that of a boundary that differs by at most epsilon (Section 2.4).
struct Stability {
  std::size_t points = 0;  ///< of the first axis, of those measured
  double largest = 0;      ///< distance to the other axis
  double worst_share = 0;  ///< largest distance as a share of 4 epsilon / (1 - cos(xi / 2))
};

/// At three points inside of each edge of `exact` whose disk has rays to the boundary that enclose
/// an angle xi of 60 degrees at least: nearer to leaves the bound says little, or does not hold.
Stability stability(const MedialAxis& exact, const MedialAxis& axis, double epsilon);

}  // namespace medial::papers
