#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/grid.h"
#include "medial/axis.h"

namespace medial {

/// A pixel that a sampled method found to be medial.
struct MedialPixel {
  raster::Pixel pixel;
  double radius = 0;                                    ///< in units of the input
  std::uint32_t component = 0;                          ///< of the shape
  std::array<std::uint32_t, 2> site{no_site, no_site};  ///< two that its disk touches, or none
};

/// Links medial pixels into the graph of a sampled axis: appends one node for each pixel, in order,
/// and the edges between neighbours to `axis`, and sets its resolution. The sites of an edge are
/// those of its first node, the one on the left first; `axis.sites` must hold them already.
///
/// The pixels must be distinct and sorted by row, then by column. Of the links between
/// 8-neighbours, two kinds are omitted, so that only real holes make cycles:
///  - a diagonal link, if a pixel is a neighbour of both ends, because a detour exists;
///  - of four pixels in a square, the link of the lower two. Each square has its own lower link, so
///    a square does not need the link that the square above it loses.
/// So the graph is connected if the pixels are 8-connected, and has one independent cycle for each
/// bounded 4-connected component of the other pixels.
///
/// A diagonal link is also omitted if `barrier` is given and holds both pixels beside it, because a
/// contour passes between them. O(pixels).
void link_pixels(const raster::Grid& grid, std::span<const MedialPixel> pixels,
                 const raster::BitMap* barrier, MedialAxis& axis);

/// Appends a straight edge between two nodes of a sampled axis. `site`: two sites that the disk of
/// the first node touches, in any order, or none.
void add_link(MedialAxis& axis, std::uint32_t from, std::uint32_t to,
              std::array<std::uint32_t, 2> sites);

}  // namespace medial
