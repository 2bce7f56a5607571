#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "medial/contour.h"

namespace medial::io {

/// Curves joined to loops.
struct JoinedCurves {
  std::vector<Contour> loops;
  std::vector<Contour> cells;  ///< where there is no loop: what curves enclose together
  std::uint64_t in_cells = 0;  ///< curves around them
  std::uint64_t open = 0;      ///< curves that are part of no loop
  double smallest_gap = 0;     ///< of the ends of what stays open, if anything does
  double tolerance = 0;        ///< how far apart ends were joined, in units of the input
};

/// Joins open curves end to end to closed contours: ends that lie within `tolerance` of each other
/// (through others, if there are others between) are one place. A curve with an end at a place of
/// its own is part of no loop. Where more than two curves meet, neighbours by direction are joined,
/// so that loops do not cross there. Ends that are joined become the same point. Where that makes
/// no loop, as in a net, whose every curve ends at two others, the cells of the net are found.
///
/// `gap` is the tolerance in units of the input; nothing: 1e-6 of the diagonal of the bounding box
/// of the control points; infinity: the same, and then whatever is open is closed by a segment.
/// O(n log n).
JoinedCurves join_curves(std::vector<Contour> curves, std::optional<double> gap);

}  // namespace medial::io
