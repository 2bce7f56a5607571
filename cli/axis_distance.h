#pragma once

#include "medial/axis.h"
#include "medial/query.h"

namespace medial::cli {

/// How far an axis is from the exact one, in units of the input, by samples.
struct AxisDistance {
  double largest = 0;    ///< from the axis to the exact one
  double mean = 0;       ///< the same, over its length
  double uncovered = 0;  ///< from the exact axis to the axis
  double away = 0;       ///< `largest` without what is near a leaf of the exact axis
};

/// Samples both axes in steps of `step`. Near a leaf means nearer than `leaf`.
AxisDistance distance_between(const MedialAxis& axis, const MedialAxis& exact, double step,
                              double leaf);

}  // namespace medial::cli
