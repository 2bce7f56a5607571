#pragma once

// The parts of an axis that a tool follows, as ordered paths in space.

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

/// The parts of all edges with radii in [least, most]. The chain of a curved edge stays within
/// `chord` of it in (x, y, r), and every radius is reduced by sqrt(2) chord, so that all disks
/// between two disks of the chain are inside the shape, too.
Grooves grooves_of(const MedialAxis& axis, double least, double most, double chord);

/// A groove, and whether it is traversed from `from` to `to`.
struct GrooveStep {
  std::uint32_t part = 0;
  bool forward = true;
};

/// Joins all grooves into the smallest possible number of trails, each from junction to junction,
/// without repeating a groove. Orders the trails by always choosing the nearest one, beginning near
/// `start`. O(n log n) expected.
std::vector<std::vector<GrooveStep>> trails_of(const Grooves& grooves, Vec2 start);

}  // namespace medial::ops
