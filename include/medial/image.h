#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "medial/axis.h"
#include "medial/contour.h"
#include "medial/error.h"
#include "medial/shape.h"

namespace medial {

/// Whether images of this size can be worked on: their diagonal is below 2^16 pixels, so that a
/// squared distance fits into 32 bits.
constexpr bool fits_image(std::uint64_t width, std::uint64_t height) {
  constexpr std::uint64_t most = 65535;
  return width <= most && height <= most && width * width + height * height < most * most;
}

/// A binary image: a bit a pixel, set in the foreground, the object. Rows go from the top down;
/// pixel (x, y) is the square [x, x + 1] x [y, y + 1]. Connectedness is by eight neighbours in the
/// foreground and by four in the background, to which all outside of the image belongs.
class Image {
 public:
  Image() = default;
  Image(std::uint32_t width, std::uint32_t height)
      : width_(width),
        height_(height),
        stride_((std::size_t{width} + 63) / 64),
        words_(stride_ * height, 0) {}

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }

  /// Whether a pixel is foreground; false outside of the image.
  bool at(std::int64_t x, std::int64_t y) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
    const auto column = static_cast<std::size_t>(x);
    return (row(static_cast<std::uint32_t>(y))[column / 64] >> (column % 64)) & 1;
  }
  void set(std::uint32_t x, std::uint32_t y, bool value = true) {
    std::uint64_t& word = row(y)[x / 64];
    const std::uint64_t bit = std::uint64_t{1} << (x % 64);
    word = value ? word | bit : word & ~bit;
  }

  /// A row as words: pixel x is bit x % 64 of word x / 64. Bits beyond the width must stay 0.
  std::span<std::uint64_t> row(std::uint32_t y) {
    return std::span(words_).subspan(y * stride_, stride_);
  }
  std::span<const std::uint64_t> row(std::uint32_t y) const {
    return std::span(words_).subspan(y * stride_, stride_);
  }
  /// All rows, one after another.
  std::span<const std::uint64_t> words() const { return words_; }

  /// The number of foreground pixels.
  std::uint64_t count() const {
    std::uint64_t pixels = 0;
    for (const std::uint64_t word : words_) pixels += static_cast<unsigned>(std::popcount(word));
    return pixels;
  }

  friend bool operator==(const Image&, const Image&) = default;

 private:
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::size_t stride_ = 0;
  std::vector<std::uint64_t> words_;
};

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
