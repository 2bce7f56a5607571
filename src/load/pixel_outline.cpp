#include <array>
#include <bit>

#include "base/in_flight.h"
#include "medial/raster.h"

namespace medial {
namespace {

/// Follows the cracks between foreground and background, with the foreground on the right as seen
/// in the image. Each ring has a crack above a pixel; visited cracks of this kind are marked.
class Tracer {
 public:
  Tracer(const Image& image, double neck)
      : image_(image), neck_(neck), taken_(image.width(), image.height()) {}

  std::vector<Ring> trace() {
    std::vector<Ring> rings;
    std::vector<std::uint64_t> nothing(image_.height() == 0 ? 0 : image_.row(0).size(), 0);
    std::span<const std::uint64_t> above = nothing;
    for (std::uint32_t y = 0; y < image_.height(); ++y) {
      const std::span<const std::uint64_t> row = image_.row(y);
      for (std::size_t w = 0; w < row.size(); ++w) {
        while (const std::uint64_t left = row[w] & ~above[w] & ~taken_.row(y)[w]) {
          const auto x = static_cast<std::int64_t>(w * 64) + std::countr_zero(left);
          rings.push_back(ring_from(x, y));
        }
      }
      above = row;
    }
    return rings;
  }

 private:
  /// The ring through the crack above pixel (x, y), from that crack's left end.
  Ring ring_from(std::int64_t x, std::int64_t y) {
    // East, south, west, north: the step, and the pixels ahead on its left and right, relative to
    // the point where the step begins.
    static constexpr std::array<std::array<int, 2>, 4> step = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    static constexpr std::array<std::array<int, 2>, 4> left = {
        {{0, -1}, {0, 0}, {-1, 0}, {-1, -1}}};
    static constexpr std::array<std::array<int, 2>, 4> right = {
        {{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
    const std::int64_t first_x = x, first_y = y;
    Ring ring;
    std::size_t direction = 0;
    do {
      if (direction == 0) taken_.set(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
      x += step[direction][0];
      y += step[direction][1];
      // Foreground ahead on the left is connected, if necessary across the corner.
      const bool on_left = image_.at(x + left[direction][0], y + left[direction][1]);
      const bool on_right = image_.at(x + right[direction][0], y + right[direction][1]);
      const std::size_t next = (direction + (on_left ? 3 : on_right ? 0 : 1)) % 4;
      const Vec2 corner{static_cast<double>(x), static_cast<double>(y)};
      if (on_left && !on_right && neck_ > 0) {
        ring.points.push_back(corner - neck_ * vector(step[direction]));
        ring.points.push_back(corner + neck_ * vector(step[next]));
      } else if (next != direction) {
        ring.points.push_back(corner);
      }
      direction = next;
    } while (x != first_x || y != first_y || direction != 0);
    return ring;
  }

  static Vec2 vector(const std::array<int, 2>& step) {
    return {static_cast<double>(step[0]), static_cast<double>(step[1])};
  }

  const Image& image_;
  double neck_;
  Image taken_;
};

}  // namespace

Result<std::vector<Ring>> pixel_outline(const Image& image, double neck) {
  if (!(neck >= 0 && neck < 0.5))
    return Error{ErrorCode::invalid_option, "the neck must be in [0, 1/2) pixels", {}};
  if (!fits_image(image.width(), image.height()))
    return Error{ErrorCode::too_large, "the diagonal of the image is above 2^16 pixels", {}};
  return guarded([&]() -> Result<std::vector<Ring>> { return Tracer(image, neck).trace(); });
}

}  // namespace medial
