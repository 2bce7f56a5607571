#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "methods/raster/ridge/follow.h"
#include "methods/raster/ridge/necks.h"

namespace medial::ridge {

/// The axis in the necks: a point in each gate, and the links.
struct Passages {
  struct Point {
    Vec2 center;  ///< local
    double radius = 0;
    std::uint32_t first = no_edge, second = no_edge;  ///< the edges on both sides
  };
  /// A point, or a medial pixel.
  struct End {
    std::uint32_t point = none;
    raster::Pixel pixel;
    static constexpr std::uint32_t none = ~std::uint32_t{0};
  };
  std::vector<Point> points;
  std::vector<std::array<End, 2>> links;
};

/// Places a point of the axis in each gate, and links all gates and interior pixels that meet. Of
/// the interior pixels at a meeting, one becomes medial and stays: one that is already medial if
/// possible; otherwise with a way of medial pixels to the next one. Call after all medial pixels
/// are found and before thinning.
Passages pass_necks(const Necks& necks, const EdgeOutline& outline, const LocalGrid& local,
                    const InteriorSets& sets, NearestEdges& search, Follower& follower);

}  // namespace medial::ridge
