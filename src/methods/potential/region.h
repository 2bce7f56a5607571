#pragma once

#include <cstdint>
#include <vector>

#include "medial/axis.h"
#include "methods/potential/charges.h"
#include "methods/problem.h"

namespace medial::potential {

/// A smooth arc of locally largest curvature.
struct Bend {
  Disk circle;
  double turn = 0;  ///< of the boundary where it is at least half as curved, in radians
};

/// One component of a shape in the local frame: its boundary as charged pieces, loop after loop,
/// the outer loop first.
struct Region {
  struct PieceLoop {
    std::uint32_t begin = 0, end = 0;  ///< pieces
    Vec2 inside;                       ///< for a hole: a point in it or on its boundary
  };
  std::vector<Charge> pieces;
  std::vector<PieceLoop> loops;
  std::vector<std::uint32_t> corners;  ///< pieces that begin at a convex corner, ascending
  std::vector<std::uint32_t> reflex;   ///< pieces that begin at a reflex corner
  std::vector<Bend> bends;
  double chord = 0;  ///< the largest distance of chords from their arcs
  double bend = 0;   ///< half of the largest turn between chords of one arc
  double size = 0;   ///< the larger side of its bounding box
  /// The number of edges of the pieces.
  std::size_t edges() const;
  std::size_t holes() const { return loops.size() - 1; }
  /// The piece before or after another around its loop.
  std::uint32_t before(std::uint32_t piece) const;
};

/// Whether p lies inside of the region. O(n).
bool encloses(const Region& region, Vec2 p);

/// The components of a shape. Arcs become chords within `chord` of them; a charge's site is the
/// index of its edge in the shape.
std::vector<Region> regions_of(const Problem& problem, double chord);

}  // namespace medial::potential
