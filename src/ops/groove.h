#pragma once

// The parts of an axis that a tool follows, as paths in space, and their order.

#include <cstdint>
#include <vector>

#include "medial/axis.h"
#include "medial/carve.h"

namespace medial::ops {

/// A part of an edge: a chain of disks from one junction to another.
struct Groove {
  /// At least two; every disk lies inside the shape. A radius below 0 stands for a tool above the
  /// surface.
  std::vector<Disk> disks;
  std::uint32_t from = 0, to = 0;
};

struct Grooves {
  std::vector<Groove> parts;
  std::uint32_t junctions = 0;  ///< nodes of the axis, then places where parts begin or end
};

/// The parts of all edges where the radius is in [least, most]. Where an edge is curved, its chain
/// stays within `chord` of it in (x, y, r), and every radius is less by sqrt(2) chord, so that the
/// disks of all points between two of the chain are inside, too.
Grooves grooves_of(const MedialAxis& axis, double least, double most, double chord);

/// A part, and whether it is passed from `from` to `to`.
struct GrooveStep {
  std::uint32_t part = 0;
  bool forward = true;
};

/// Puts all parts into as few trails as there can be, each from junction to junction without
/// passing a part twice, and the trails into an order with short ways in between: always the
/// nearest one. Starts near a place. O(n log n) expected.
std::vector<std::vector<GrooveStep>> trails_of(const Grooves& grooves, Vec2 start);

}  // namespace medial::ops
