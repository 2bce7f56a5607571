#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "medial/contour.h"
#include "medial/disk.h"
#include "medial/error.h"
#include "medial/image.h"
#include "medial/shape.h"

namespace medial {

/// How many parts and holes an image has.
struct Topology {
  std::uint64_t components = 0;  ///< of the foreground, by eight neighbours
  std::uint64_t holes = 0;       ///< of the background, by four neighbours, without the outside
  friend bool operator==(const Topology&, const Topology&) = default;
};

/// Counts both. O(runs of pixels in the rows), nearly.
Topology topology(const Image& image);

/// What the distance of a pixel is measured to, always from the pixel's centre.
enum class DistanceTo : std::uint8_t {
  pixels,  ///< the centre of the nearest background pixel: what images' distances usually are
  cracks,  ///< the boundary between foreground and background pixels: the radius of the largest
           ///< disk inside the pixels' squares
};

struct DistanceOptions {
  DistanceTo to = DistanceTo::pixels;
  /// Whether pixels outside of the image are background; otherwise they are nothing. Distances to
  /// cracks always have it so.
  bool frame = true;
  /// Threads to use, at most 1024; 0: all of the machine.
  int threads = 0;
};

/// The distance of every pixel, row after row.
struct DistanceMap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  /// Squared, exactly, in pixels: an integer, or to cracks four times the square. 0 in the
  /// background; `unbounded` where there is no background at all.
  std::vector<std::uint32_t> squared;
  DistanceTo to = DistanceTo::pixels;

  static constexpr std::uint32_t unbounded = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t squared_at(std::uint32_t x, std::uint32_t y) const {
    return squared[std::size_t{y} * width + x];
  }
  /// The distance itself, in pixels; infinite where there is no background.
  double at(std::uint32_t x, std::uint32_t y) const;
};

/// The exact Euclidean distance transform. O(pixels), whatever the image shows: columns by two
/// scans, then rows by the lower envelope of one parabola a column (Meijster, Roerdink and
/// Hesselink 2000; Felzenszwalb and Huttenlocher 2012), all in integers. Errors: invalid_option,
/// too_large, out_of_memory.
Result<DistanceMap> distance_transform(const Image& image, const DistanceOptions& options = {});

/// The pixels whose centres lie inside the disks around the pixels `centers`, of the distances to
/// pixels as radii: what an axis of pixels retains of its image. All disks are open, so none
/// reaches a background pixel. Requires that both have one size. O(sum of the radii).
Image union_of_disks(const Image& centers, const DistanceMap& distances);
/// The pixels of an image of this size whose centres lie in any of the disks, in coordinates of
/// pixels.
Image union_of_disks(std::uint32_t width, std::uint32_t height, std::span<const Disk> disks);

/// The boundary of the foreground pixels' squares, exactly: its corners, with y downwards. One ring
/// goes around each component and one around each hole, as topology() counts them, in the order of
/// their topmost and there leftmost pixels. Where foreground pixels meet in a corner only, the two
/// corners of background there are cut off by `neck`, in [0, 1/2) pixels: so the interior is
/// connected, and build_shape() finds the image's own components and holes. With 0 nothing is cut,
/// rings touch there, and the interior is not connected. O(pixels / 64 + cracks). Errors:
/// invalid_option, too_large, out_of_memory.
Result<std::vector<Ring>> pixel_outline(const Image& image, double neck = 1.0 / 16);

/// The same boundary as smooth closed curves: one contour for each ring, a quadratic B-spline with
/// one parabola for each crack, that bends as little as it can within half a pixel of the cracks
/// (both ways). Curves of an image never meet: where pixels touch in a corner, the foreground
/// becomes connected through a neck. Errors: those of pixel_outline().
Result<std::vector<Contour>> smooth_outline(const Image& image);

}  // namespace medial
