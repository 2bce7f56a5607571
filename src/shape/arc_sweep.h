#pragma once

#include <cstdint>

#include "medial/error.h"
#include "shape/clean.h"
#include "shape/noding.h"
#include "shape/sweep.h"

namespace medial {

struct SweptArcs {
  NodedRings noded;
  Sweep sweep;              ///< without splits: where a vertex touched an edge there are two now
  double tolerance = 0;     ///< in units of the input
  bool is_changed = false;  ///< edges were divided or vanished, or vertices moved
  std::uint64_t split_edges = 0;
  std::uint64_t crossings = 0;
  std::uint64_t repeated_edges = 0;  ///< of chains
};

/// sweep() for outlines with arcs. Because no vertex lies exactly on an arc, contacts are decided
/// within a tolerance (see tolerance_for): vertices within it are merged, an edge passes through a
/// vertex within it, and two edges that come within it, without crossing by more, touch in one
/// point. O((n + c) log n) for each of a few rounds and c contacts; one round if nothing touches.
/// Errors: crossing, overlap, no_area (a ring within the tolerance).
///
/// With `node_crossings`, first splits edges where they cross, which takes O(n log n + p) for p
/// pairs of edges above each other, in each of a few rounds; keeps one of several coincident edges
/// of chains. A `reach` above the tolerance replaces it.
Result<SweptArcs> sweep_arcs(const CleanRings& cleaned, bool node_crossings = false,
                             double reach = 0);

}  // namespace medial
