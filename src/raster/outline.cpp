#include <array>
#include <exception>
#include <new>

#include "medial/image.h"

namespace medial {
namespace {

/// Follows the cracks between foreground and background, the foreground on the right as one looks
/// at the image. Each ring has a crack above a pixel; those are marked where a ring took them.
class Tracer {
 public:
  explicit Tracer(const Image& image) : image_(image), taken_(image.width(), image.height()) {}

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
    // East, south, west, north: the step, and which pixel lies ahead on the left and right of it,
    // seen from the point where the step begins.
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
      // The foreground that is ahead on the left is connected, over the corner if need be.
      std::size_t turn = 1;
      if (image_.at(x + left[direction][0], y + left[direction][1])) {
        turn = 3;
      } else if (image_.at(x + right[direction][0], y + right[direction][1])) {
        turn = 0;
      }
      if (turn != 0) ring.points.push_back({static_cast<double>(x), static_cast<double>(y)});
      direction = (direction + turn) % 4;
    } while (x != first_x || y != first_y || direction != 0);
    return ring;
  }

  const Image& image_;
  Image taken_;
};

}  // namespace

Result<std::vector<Ring>> pixel_outline(const Image& image) {
  if (!fits_image(image.width(), image.height()))
    return Error{ErrorCode::too_large, "the diagonal of the image is above 2^16 pixels", {}};
  try {
    return Tracer(image).trace();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::out_of_memory, "memory ran out", {}};
  } catch (const std::exception& exception) {
    return Error{ErrorCode::internal, exception.what(), {}};
  }
}

}  // namespace medial
