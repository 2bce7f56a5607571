#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shape/monotone_arc.h"
#include "shape/noding.h"

namespace medial {

/// Where the circles or lines of two pieces meet, or come nearest if it is nearly so. At most two.
struct Meetings {
  std::array<Vec2, 2> points;
  std::size_t size = 0;
};
Meetings meetings(const MonotoneArc& a, const MonotoneArc& b);

/// The point of an arc next to p, if p is on its circle or line up to a small error, or rounding of
/// local coordinates, and up to that on the same side of the chord. (It may lie beyond the ends of
/// a segment.)
std::optional<Vec2> on_arc(const MonotoneArc& arc, Vec2 p);

/// Where edges meet, each in its inside or one of them in an end: what noding splits them at. Their
/// common ends are none of these places.
struct Crossings {
  std::vector<TouchedPoint> contacts;
  std::uint64_t count = 0;  ///< of those in the inside of both
};
Crossings crossings_of(const Noding& noding, const NodedRings& noded);

}  // namespace medial
