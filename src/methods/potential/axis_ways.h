#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "methods/potential/skeleton.h"

namespace medial::potential {

/// A way along the exact axis, from one point of a skeleton to another or back to itself.
struct AxisWay {
  std::uint32_t from = 0, to = 0;  ///< points of the skeleton
  std::vector<Vec2> places;        ///< including both ends
};

/// Ways along the exact axis that connect the given points of a skeleton, and go around all holes.
/// `axis` is the limit of high orders, a connected graph.
std::vector<AxisWay> ways_between(const Skeleton& axis, const Skeleton& skeleton,
                                  std::span<const std::uint32_t> points);

}  // namespace medial::potential
