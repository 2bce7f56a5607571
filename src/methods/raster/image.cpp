#include <bit>

#include "medial/raster.h"

namespace medial {

bool fits_image(std::uint64_t width, std::uint64_t height) {
  constexpr std::uint64_t most = 65535;
  return width <= most && height <= most && width * width + height * height < most * most;
}

std::uint64_t Image::count() const {
  std::uint64_t pixels = 0;
  for (const std::uint64_t word : words_) pixels += static_cast<unsigned>(std::popcount(word));
  return pixels;
}

}  // namespace medial
