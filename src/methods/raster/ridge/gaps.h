#pragma once

#include "methods/raster/ridge/digitize.h"
#include "methods/raster/ridge/follow.h"

namespace medial::ridge {

// Gaps between medial pixels: pixels of the interior that medial ones separate from all boundaries.
// From every point a straight way leads to its nearest boundary point without crossing the axis, so
// a gap is no hole, and its border has a pixel that is none of the axis.

/// Makes narrow gaps medial: those whose pixels all have a medial one beside them.
void fill_gaps(const InteriorSets& sets, const raster::BitMap& boundary, Follower& follower);

/// Opens the gaps that are left: as many pixels as needed are no longer medial, the worst first.
/// The medial pixels stay connected, because each one lies on a cycle around a gap.
void open_gaps(const InteriorSets& sets, const raster::BitMap& boundary, MedialMap& map);

}  // namespace medial::ridge
