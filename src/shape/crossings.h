#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shape/monotone_arc.h"
#include "shape/noding.h"

namespace medial {

/// The points, at most two, where the circles or lines of two pieces meet or almost meet.
struct Meetings {
  std::array<Vec2, 2> points;
  std::size_t size = 0;
};
Meetings meetings(const MonotoneArc& a, const MonotoneArc& b);

/// The point of an arc nearest to p, if p lies on its circle or line and on the same side of the
/// chord, up to a small error or the rounding of local coordinates. (It may lie beyond the ends of
/// a segment.)
std::optional<Vec2> on_arc(const MonotoneArc& arc, Vec2 p);

/// The places at which noding splits edges: where edges meet, both in their interiors, or one of
/// them at an end. Common ends do not count.
struct Crossings {
  std::vector<TouchedPoint> contacts;
  std::uint64_t count = 0;  ///< of places in the interiors of both
};
Crossings crossings_of(const Noding& noding, const NodedRings& noded);

}  // namespace medial
