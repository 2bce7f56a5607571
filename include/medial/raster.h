#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <string_view>

#include "medial/contour.h"

namespace medial {

/// Whether the diagonal is below 2^16 pixels, so that squared distances fit 32 bits.
bool fits_image(std::uint64_t width, std::uint64_t height);

/// A binary image: one bit per pixel, set in the foreground. Rows go from the top down; pixel (x,
/// y) is the square [x, x + 1] x [y, y + 1]. Connectedness is by eight neighbours in the foreground
/// and by four in the background, to which all outside the image belongs.
class Image {
 public:
  Image() = default;
  Image(std::uint32_t width, std::uint32_t height) : width_(width), height_(height) {}

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  /// Whether a pixel is foreground; false outside the image.
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

  /// A row, or all rows, as words: pixel x is bit x % 64 of word x / 64. Bits past the width are 0.
  std::span<std::uint64_t> row(std::uint32_t y) {
    return std::span(words_).subspan(y * stride_, stride_);
  }
  std::span<const std::uint64_t> row(std::uint32_t y) const {
    return std::span(words_).subspan(y * stride_, stride_);
  }
  std::span<const std::uint64_t> words() const { return words_; }

  std::uint64_t count() const;  ///< the number of foreground pixels
  friend bool operator==(const Image&, const Image&) = default;

 private:
  std::uint32_t width_ = 0, height_ = 0;
  std::size_t stride_ = (std::size_t{width_} + 63) / 64;
  std::vector<std::uint64_t> words_ = std::vector<std::uint64_t>(stride_ * height_);
};

/// The upper left corner of pixel (c, r): (t[0] + c t[1] + r t[2], t[3] + c t[4] + r t[5]).
using PixelPlacement = std::array<double, 6>;
constexpr PixelPlacement unplaced = {0, 1, 0, 0, 0, 1};

struct PlacedImage {
  Image image;
  PixelPlacement placement = unplaced;
  bool placed() const { return placement != unplaced; }
};

struct Topology {
  std::uint64_t components = 0, holes = 0;  ///< of foreground, by 8 neighbours; background, by 4
  friend bool operator==(const Topology&, const Topology&) = default;
};

/// Counts components, and holes without the outside. O(runs of pixels in rows), nearly.
Topology topology(const Image& image);

/// How a brushfire keeps components, holes and ends (Volkmann and St. Clair 1987, Section II.B.1).
enum class Brushfire : std::uint8_t {
  sequential,    ///< pixel by pixel, from four subfields in turn (Rosenfeld and Kak 1982)
  sides,         ///< from the north, south, west and east in turn (Rosenfeld 1975)
  marking,       ///< marks border pixels, then deletes them, by two rules in turn (Guo and Hall
                 ///< 1989, algorithm A1): lines two pixels wide shrink to one
  simultaneous,  ///< from all sides at once; keeps one pixel of each critical clique, whose pixels
                 ///< may not all go (Bertrand and Couprie 2008)
};

/// The name on the command line: "sequential", "sides", "marking", "simultaneous".
const char* name_of(Brushfire family);
std::optional<Brushfire> brushfire_from(std::string_view name);

struct BrushfireOptions {
  Brushfire family = Brushfire::simultaneous;
  std::function<void(double)> progress = {};  ///< gets the share of decided pixels after a pass
  const std::atomic<bool>* cancel = nullptr;  ///< see Options; checked after a pass
};

/// Thins the foreground to lines by a brushfire. The result is a subset of the image with the same
/// topology(), from which the family's rule can remove no pixel. O(pixels): 64 pixels at a time,
/// and only where the fire burns. Errors: too_large, cancelled, out_of_memory.
Result<Image> thin(const Image& image, const BrushfireOptions& options = {});

/// What the distance of a pixel's centre is measured to.
enum class DistanceTo : std::uint8_t {
  pixels,  ///< the centre of the nearest background pixel, as usual for images
  cracks,  ///< the boundary of the foreground pixels' squares
};

struct DistanceOptions {
  DistanceTo to = DistanceTo::pixels;
  bool outside_is_background = true;  ///< outside the image; always true for cracks
  int threads = 0;                    ///< see Options
};

/// The distance of every pixel, row by row.
struct DistanceMap {
  std::uint32_t width = 0, height = 0;
  /// Squared distances in pixels, exact integers; to cracks, times 4. Background pixels have 0;
  /// all pixels have `unbounded` if there is no background.
  std::vector<std::uint32_t> squared;
  DistanceTo to = DistanceTo::pixels;

  static constexpr std::uint32_t unbounded = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t squared_at(std::uint32_t x, std::uint32_t y) const {
    return squared[std::size_t{y} * width + x];
  }
  /// The distance in pixels; infinite if there is no background.
  double at(std::uint32_t x, std::uint32_t y) const;
};

/// The exact Euclidean distance from the centre of each foreground pixel to the background, as
/// DistanceOptions::to measures it (Meijster, Roerdink and Hesselink 2000; Felzenszwalb and
/// Huttenlocher 2012). O(pixels). Errors: invalid_option, too_large, out_of_memory.
Result<DistanceMap> distance_transform(const Image& image, const DistanceOptions& options = {});

/// The exact boundary of the foreground pixels' squares, y downwards: one ring around each
/// component and each hole of topology(), ordered by topmost, then leftmost pixel. Where foreground
/// pixels meet in a corner only, `neck`, in [0, 1/2) pixels, cuts off the two background corners;
/// this connects the interior as topology() counts it. With 0, rings touch there. O(pixels / 64 +
/// cracks). Errors: invalid_option, too_large, out_of_memory.
Result<std::vector<Ring>> pixel_outline(const Image& image, double neck = 1.0 / 16);

/// The same boundary as smooth curves: per ring the quadratic B-spline, one parabola per crack, of
/// least bending within half a pixel of the cracks (Hausdorff distance). Curves never meet: necks
/// connect pixels that touch in a corner. Errors: those of pixel_outline().
Result<std::vector<Contour>> smooth_outline(const Image& image);

}  // namespace medial
