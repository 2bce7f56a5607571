#pragma once

// The extended grassfire transform (Liu, Chambers, Letscher and Ju 2011) on the branches of an
// axis: what significance is made of.

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "medial/axis.h"

namespace medial::ops {

/// A branch as the fire sees it.
struct Fuse {
  std::array<std::uint32_t, 2> node{};
  double length = 0;
};

constexpr double not_burnt = std::numeric_limits<double>::infinity();

/// When each branch starts to burn at its two ends. At a node of one branch the fire starts at the
/// time of the radius there; it goes along branches at speed 1; at a node of several it waits until
/// all but one have burnt, and goes on into that one. Infinite at ends that it does not start
/// from: where it arrives, and on cycles and between them. O(n).
std::vector<std::array<double, 2>> burn(const MedialAxis& axis, std::span<const Fuse> fuses);

}  // namespace medial::ops
