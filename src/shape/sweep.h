#pragma once

#include <cstdint>
#include <vector>

#include "medial/error.h"
#include "shape/clean.h"

namespace medial {

/// A vertex in the interior of an edge.
struct Split {
  std::uint32_t edge = 0;
  std::uint32_t vertex = 0;
  std::uint32_t place = 0;  ///< the touching place
};

/// A vertex at a place where more than two edges meet.
struct Touch {
  std::uint32_t place = 0;
  std::uint32_t vertex = 0;
};

/// A vertex with no edge to its left, and the piece directly below it (no_index: none).
struct LeftEnd {
  std::uint32_t vertex = 0;
  std::uint32_t below = 0;
};

/// The result of the sweep. The splits cut the edges into pieces. Piece e < number of edges is the
/// leftmost piece of edge e; piece (number of edges) + s begins at split s.
struct Sweep {
  std::vector<bool> interior_above;  ///< of each piece
  std::vector<Split> splits;         ///< in the order of the sweep
  std::vector<Touch> touches;        ///< by increasing place; without the split edges
  std::vector<LeftEnd> left_ends;    ///< in the order of the sweep
  std::uint32_t place_count = 0;     ///< of touching places
};

/// The vertices in sweep order; vertices at one point are ordered by index. No coordinate may be
/// -0.
std::vector<std::uint32_t> order_of_events(const std::vector<Vec2>& points);

/// Sweeps the plane from left to right (Shamos and Hoey) and determines on which side of each piece
/// the interior lies, by the even-odd rule. Exact. O(n log n) for n vertices in any position: if no
/// edges cross, only vertices split edges, and a vertex splits at most one. Errors: crossing (the
/// interiors of two edges cross), overlap (two edges share more than a point).
Result<Sweep> sweep(const CleanRings& cleaned);

}  // namespace medial
