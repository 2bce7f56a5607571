#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace medial {

/// Whether the diagonal is below 2^16 pixels, as required: then squared distances fit 32 bits.
constexpr bool fits_image(std::uint64_t width, std::uint64_t height) {
  constexpr std::uint64_t most = 65535;
  return width <= most && height <= most && width * width + height * height < most * most;
}

/// A binary image: one bit per pixel, set in the foreground. Rows go from the top down; pixel (x,
/// y) is the square [x, x + 1] x [y, y + 1]. Connectedness is by eight neighbours in the foreground
/// and by four in the background, to which all outside of the image belongs.
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

}  // namespace medial
