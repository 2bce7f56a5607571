#pragma once

#include <cstdint>

#include "methods/raster/ridge/follow.h"

namespace medial::ridge {

/// Whether a medial pixel can be removed without disconnecting its medial neighbours or joining the
/// regions next to them: the report's simple pixels (Section III.D). Pixels with one neighbour, or
/// with two adjacent ones, stay: they end a branch.
bool is_simple(const raster::BitMap& medial, const raster::BitMap& boundary, raster::Pixel p);

/// The neighbours of a pixel that count for is_simple(), one bit per direction: medial ones that
/// are not across a contour, and diagonal ones between two of them.
std::uint8_t closed_neighbours(const raster::BitMap& medial, const raster::BitMap& boundary,
                               raster::Pixel p);

/// The report's thinning (step 9 of A.3): row by row, as often as this changes anything, removes
/// simple pixels whose quality is worse than that of all their medial neighbours; of equal pixels,
/// the later one counts as worse.
void thin_by_report(const raster::BitMap& boundary, MedialMap& map);

/// Removes simple pixels, the worst first, as often as this changes anything, as long as every
/// pixel that the axis passes (its quality at most `step`, a pixel's side) stays or has a neighbour
/// that stays. Lines of one pixel remain; if branches are too close to each other for the grid, as
/// many pixels as necessary.
void thin_to_lines(const raster::BitMap& boundary, double step, MedialMap& map);

}  // namespace medial::ridge
