#pragma once

// The extended grassfire transform (Liu, Chambers, Letscher and Ju 2011) on the branches of an
// axis, for their significance.

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "medial/axis.h"

namespace medial::ops {

/// The properties of a branch that the fire depends on.
struct Fuse {
  std::array<std::uint32_t, 2> node{};
  double length = 0;
};

constexpr double not_burnt = std::numeric_limits<double>::infinity();

/// The times at which each branch starts to burn at its two ends. At a node of one branch, the fire
/// starts at the time of the radius there. It moves along branches at speed 1. At a node of several
/// branches, it waits until all but one have burnt, and continues into that one. Infinite at ends
/// where no fire starts: where it arrives, and on cycles and between them. O(n).
std::vector<std::array<double, 2>> burn(const MedialAxis& axis, std::span<const Fuse> fuses);

}  // namespace medial::ops
