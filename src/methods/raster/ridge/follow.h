#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/grid.h"
#include "base/sparse_map.h"
#include "methods/raster/ridge/digitize.h"
#include "methods/raster/ridge/nearest.h"

namespace medial::ridge {

/// The entry of the report's medial map for a pixel (A.1.e); medial pixels only. Lengths are local.
struct Found {
  raster::Pixel pixel;
  /// How far from equidistant to its two edges: the lower the better. A pixel more where no point
  /// of the axis was found beside it, but the distances differ little.
  double quality = 0;
  double radius = 0;                                ///< distance to the nearest edge
  std::uint32_t first = no_edge, second = no_edge;  ///< the nearest edge, and the other
  bool is_pinned() const { return quality == -std::numeric_limits<double>::infinity(); }
};

/// All medial pixels found, in the order in which they were found, and by place.
struct MedialMap {
  MedialMap(std::uint32_t columns, std::uint32_t rows)
      : medial(columns, rows), place(columns, rows, 0) {}
  raster::BitMap medial;
  raster::SparseMap<std::uint32_t> place;  ///< in `found`, plus one; 0: not medial
  std::vector<Found> found;

  void add(const Found& pixel) {
    found.push_back(pixel);
    place[pixel.pixel] = static_cast<std::uint32_t>(found.size());
    medial.set(pixel.pixel);
  }
  const Found& at(raster::Pixel p) const { return found[place.at(p) - 1]; }
  /// Keeps a medial pixel from being removed, by giving it the best quality.
  void pin(raster::Pixel p) {
    found[place.at(p) - 1].quality = -std::numeric_limits<double>::infinity();
  }
  /// The places in `found` of all medial pixels, by increasing x within increasing y.
  std::vector<std::uint32_t> in_rows() const;
};

/// The neighbour in a direction, counted as in Section III.D: 0 is to the right, odd ones are
/// diagonal. The pixel must not lie at the margin of the grid, where no pixel of a shape does.
raster::Pixel neighbour(raster::Pixel p, int direction);

/// Whether the way to a diagonal neighbour crosses a contour: both pixels beside it are on one.
bool crosses_contour(const raster::BitMap& boundary, raster::Pixel p, int direction);

/// Follows ridges: decides which pixels are medial, from pixel to neighbouring pixel.
class Follower {
 public:
  Follower(const EdgeOutline& outline, const LocalGrid& local, const raster::BitMap& boundary,
           NearestEdges& search, RidgeRule rule, const std::atomic<bool>* cancel);

  /// Finds one medial pixel of a set by step 7 of A.3: straight up and down from a pixel inside it.
  /// Returns false if there is none; the caller then checks all pixels of the set.
  bool find_first(raster::Pixel seed);
  /// Decides once whether a pixel that is not in the boundary map is medial.
  bool check(raster::Pixel p);
  /// Step 8: finds all medial pixels that are connected with those found but not yet followed.
  void follow();

  const MedialMap& map() const { return map_; }
  MedialMap& map() { return map_; }
  /// The entry that a pixel would have if it were medial, with unbounded quality.
  Found measured(raster::Pixel p);

 private:
  /// The pixel's nearest edge, found once.
  std::uint32_t label(raster::Pixel p, std::uint32_t hint);
  bool by_difference(raster::Pixel p, double tolerance, double away, Found& found);
  bool by_crossing(raster::Pixel p, Found& found);

  const EdgeOutline& outline_;
  const LocalGrid& local_;
  const raster::BitMap& boundary_;
  NearestEdges& search_;
  RidgeRule rule_;
  const std::atomic<bool>* cancel_;
  raster::BitMap checked_;
  raster::SparseMap<std::uint32_t> label_;
  MedialMap map_;
  std::vector<std::uint32_t> waiting_;  ///< places of pixels whose neighbours are to be checked
  std::uint32_t hint_ = no_edge;
};

}  // namespace medial::ridge
