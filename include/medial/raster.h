#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <string_view>

#include "medial/contour.h"
#include "medial/image.h"

namespace medial {

struct Topology {
  std::uint64_t components = 0;  ///< of the foreground, by eight neighbours
  std::uint64_t holes = 0;       ///< of the background, by four neighbours, without the outside
  friend bool operator==(const Topology&, const Topology&) = default;
};

/// Counts components and holes. O(runs of pixels in the rows), nearly.
Topology topology(const Image& image);

/// How a fire keeps components, holes and end points (Volkmann and St. Clair 1987, Section II.B.1).
enum class Brushfire : std::uint8_t {
  sequential,    ///< decides pixel after pixel (Rosenfeld and Kak 1982); a pass goes through four
                 ///< subfields in turn
  sides,         ///< from the north, south, west and east in turn (Rosenfeld 1975)
  marking,       ///< marks all border pixels, then deletes them; alternates two kinds of marks, so
                 ///< that lines two pixels wide shrink to one (Guo and Hall 1989, algorithm A1)
  simultaneous,  ///< from all sides at once; of pixels that may not all go, the critical cliques,
                 ///< one stays (Bertrand and Couprie 2008)
};

/// The name on the command line: "sequential", "sides", "marking", "simultaneous".
const char* name_of(Brushfire family);
std::optional<Brushfire> brushfire_from(std::string_view name);

struct BrushfireOptions {
  Brushfire family = Brushfire::simultaneous;
  /// Called after each pass with the share of pixels that are decided, in [0, 1]; must not throw.
  std::function<void(double)> progress = {};
  /// Set to true, it ends the work after the pass with ErrorCode::cancelled.
  const std::atomic<bool>* cancel = nullptr;
};

/// Thins the foreground to lines by a brushfire. The result is part of the image and has its
/// topology(); the family's rule can remove no further pixel. O(pixels): 64 pixels at a time, and
/// only where the fire burns. Errors: too_large, cancelled, out_of_memory.
Result<Image> thin(const Image& image, const BrushfireOptions& options = {});

/// What the distance of a pixel's centre is measured to.
enum class DistanceTo : std::uint8_t {
  pixels,  ///< the centre of the nearest background pixel, as usual for images
  cracks,  ///< the boundary of the foreground pixels' squares: the radius of the largest disk
           ///< inside
};

struct DistanceOptions {
  DistanceTo to = DistanceTo::pixels;
  bool frame = true;  ///< pixels outside of the image are background; always so to cracks
  int threads = 0;    ///< see Options
};

/// The distance of every pixel, row after row.
struct DistanceMap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  /// Squared distances in pixels, exact integers; to cracks four times that. 0 in the background;
  /// `unbounded` without any.
  std::vector<std::uint32_t> squared;
  DistanceTo to = DistanceTo::pixels;

  static constexpr std::uint32_t unbounded = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t squared_at(std::uint32_t x, std::uint32_t y) const {
    return squared[std::size_t{y} * width + x];
  }
  /// The distance in pixels; infinite where there is no background.
  double at(std::uint32_t x, std::uint32_t y) const;
};

/// The exact Euclidean distance transform (Meijster, Roerdink and Hesselink 2000; Felzenszwalb and
/// Huttenlocher 2012). O(pixels). Errors: invalid_option, too_large, out_of_memory.
Result<DistanceMap> distance_transform(const Image& image, const DistanceOptions& options = {});

/// The pixels whose centres lie inside the disks around the pixels `centers`, with the distances to
/// pixels as radii: what an axis of pixels retains of its image. Disks are open, so none reaches a
/// background pixel. Requires equal sizes. O(sum of the radii).
Image union_of_disks(const Image& centers, const DistanceMap& distances);
/// The same for any disks, in coordinates of pixels, as an image of this size.
Image union_of_disks(std::uint32_t width, std::uint32_t height, std::span<const Disk> disks);

/// The exact boundary of the foreground pixels' squares, with y downwards: one ring around each
/// component and each hole, as topology() counts them, in the order of their topmost, then leftmost
/// pixels. Where foreground pixels meet in a corner only, the two background corners are cut off by
/// `neck`, in [0, 1/2) pixels: this connects the interior, and build_shape() finds the image's
/// components and holes. With 0 rings touch there instead. O(pixels / 64 + cracks). Errors:
/// invalid_option, too_large, out_of_memory.
Result<std::vector<Ring>> pixel_outline(const Image& image, double neck = 1.0 / 16);

/// The same boundary as smooth curves: per ring a quadratic B-spline, one parabola per crack, that
/// bends as little as it can within half a pixel of the cracks (both ways). Curves never meet:
/// necks connect pixels that touch in a corner. Errors: those of pixel_outline().
Result<std::vector<Contour>> smooth_outline(const Image& image);

}  // namespace medial
