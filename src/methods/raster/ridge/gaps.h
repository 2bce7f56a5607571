#pragma once

#include "methods/raster/ridge/digitize.h"
#include "methods/raster/ridge/follow.h"

namespace medial::ridge {

// Gaps between medial pixels: pixels of the interior that medial pixels separate from all
// boundaries. A straight way leads from every point to its nearest boundary point without crossing
// the axis, so a gap is not a hole, and some pixel of its border is not on the axis.

/// Makes narrow gaps medial: those whose pixels all have a medial neighbour.
void fill_gaps(const InteriorSets& sets, const raster::BitMap& boundary, Follower& follower);

/// Opens the remaining gaps: removes as many medial pixels as needed, the worst first. The medial
/// pixels stay connected, because each of these is on a cycle around a gap.
void open_gaps(const InteriorSets& sets, const raster::BitMap& boundary, MedialMap& map);

}  // namespace medial::ridge
