#pragma once

// The peers: each builds its diagram of the same rings once. They stand in translation units of
// their own, because each wants its own headers and warnings.

#include <cstddef>
#include <span>
#include <string>

#include "medial/shape.h"

namespace medial::bench {

/// What a peer did.
struct PeerRun {
  double seconds = 0;        ///< of processor time, construction only
  std::size_t vertices = 0;  ///< of its diagram
  std::size_t left_out = 0;  ///< segments without length once the coordinates were scaled
};

/// Boost.Polygon's segment Voronoi diagram. It knows int32 coordinates only: the rings are scaled
/// so that their bounding box spans 2^31, which moves points by up to 2^-32 of it; what this makes
/// degenerate is left out and counted.
PeerRun run_boost(std::span<const Ring> rings);

/// The same without any stretching, where the coordinates are integers, or decimals of six places
/// that 1e6 makes integers of. Nothing moves, ties stay ties, and the smaller numbers need exact
/// arithmetic less often: Boost is 10 to 40 percent faster so, and this is its fairer figure.
/// Negative seconds where the coordinates are neither.
PeerRun run_boost_unstretched(std::span<const Ring> rings);
std::string boost_version();

/// CGAL's segment Delaunay graph: filtered traits without intersections, spatially sorted
/// insertion.
PeerRun run_cgal(std::span<const Ring> rings);
std::string cgal_version();

}  // namespace medial::bench
