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
/// The pixels must be sorted by increasing column within increasing row, each once. Of the links
/// between pixels among each other's eight neighbours, two kinds are left out, so that only real
/// holes make cycles:
///  - a diagonal one beside a pixel that is a neighbour of both: the way round is there already;
///  - of four pixels in a square, the link of the lower two. Each square has its own lower link,
///  and
///    what the square above it loses was not needed by the one below: row by row from the top,
///    every square opens towards the row beneath it.
/// So the graph is connected where the pixels are, as a set with eight neighbours each, and has one
/// independent cycle for each bounded part of the rest with four neighbours each.
///
/// A diagonal is also left out where `barrier`, if it is given, holds both pixels beside it: a
/// contour passes between. O(pixels).
void link_pixels(const raster::Grid& grid, std::span<const MedialPixel> pixels,
                 const raster::BitMap* barrier, MedialAxis& axis);

/// Appends the straight edge between two nodes of a sampled axis, beside it two sites that the disk
/// of the first touches, in any order, or none.
void add_link(MedialAxis& axis, std::uint32_t from, std::uint32_t to,
              std::array<std::uint32_t, 2> sites);

}  // namespace medial
