#pragma once

#include <cstdint>

#include "methods/raster/ridge/follow.h"

namespace medial::ridge {

/// Whether a medial pixel can go without disconnecting its medial neighbours or joining what lies
/// beside them: the report's simple pixels (Section III.D). Pixels with one neighbour, or with two
/// side by side, stay: they end a branch.
bool is_simple(const raster::BitMap& medial, const raster::BitMap& boundary, raster::Pixel p);

/// The neighbours of a pixel that count for is_simple(), a bit for each direction: the medial ones,
/// those across a contour not; and diagonal ones between two of them.
std::uint8_t closed_neighbours(const raster::BitMap& medial, const raster::BitMap& boundary,
                               raster::Pixel p);

/// The report's thinning (step 9 of A.3): row by row, as often as it changes anything, simple
/// pixels go whose quality is worse than that of all their medial neighbours; of equal ones, the
/// later pixel counts as the worse.
void thin_by_report(const raster::BitMap& boundary, MedialMap& map);

/// All simple pixels go, the worst first, as often as it changes anything, as long as every pixel
/// that the axis passes (its quality at most `step`, a pixel's side) stays or has a neighbour that
/// stays: lines of one pixel remain, and of branches too close to each other for the grid,
/// as many as it takes.
void thin_to_lines(const raster::BitMap& boundary, double step, MedialMap& map);

}  // namespace medial::ridge
