#include "methods/raster/disks.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace medial {
namespace {

/// Sets the pixels first..last of a row in the image.
void set_inside(Image& image, std::int64_t row, std::int64_t first, std::int64_t last) {
  if (first > last) return;
  const std::span<std::uint64_t> words = image.row(static_cast<std::uint32_t>(row));
  const auto from = static_cast<std::size_t>(first / 64), to = static_cast<std::size_t>(last / 64);
  for (std::size_t w = from; w <= to; ++w) {
    std::uint64_t bits = ~std::uint64_t{0};
    if (w == from) bits &= ~std::uint64_t{0} << (first % 64);
    if (w == to) bits &= ~std::uint64_t{0} >> (63 - last % 64);
    words[w] |= bits;
  }
}

/// An image of runs, which mostly lie in or next to one that is there.
class Runs {
 public:
  Runs(std::uint32_t width, std::uint32_t height)
      : image_(width, height), longest_(height, {0, -1}) {}

  /// Sets the pixels first..last of a row, as far as they lie in the image.
  void set(std::int64_t row, std::int64_t first, std::int64_t last) {
    if (row < 0 || row >= image_.height()) return;
    first = std::max<std::int64_t>(first, 0);
    last = std::min<std::int64_t>(last, image_.width() - 1);
    if (first > last) return;
    auto& [low, high] = longest_[static_cast<std::size_t>(row)];
    if (first > high + 1 || last < low - 1) {
      set_inside(image_, row, first, last);
      if (last - first > high - low) low = first, high = last;
      return;
    }
    set_inside(image_, row, first, low - 1);
    set_inside(image_, row, high + 1, last);
    low = std::min(low, first);
    high = std::max(high, last);
  }
  Image take() { return std::move(image_); }

 private:
  Image image_;
  std::vector<std::pair<std::int64_t, std::int64_t>> longest_;  ///< of the runs of each row
};

/// The largest integer whose square is at most `square`.
std::int64_t root(std::int64_t square) {
  auto r = static_cast<std::int64_t>(std::sqrt(static_cast<double>(square)));
  while (r * r > square) --r;
  while ((r + 1) * (r + 1) <= square) ++r;
  return r;
}

}  // namespace

Image union_of_disks(const Image& centers, const DistanceMap& distances) {
  Runs covered(centers.width(), centers.height());
  for (std::uint32_t y = 0; y < centers.height(); ++y) {
    for (std::uint32_t x = 0; x < centers.width(); ++x) {
      if (!centers.at(x, y) || distances.squared_at(x, y) == 0) continue;
      const std::int64_t largest = std::int64_t{distances.squared_at(x, y)} - 1;
      for (std::int64_t dy = 0; dy * dy <= largest; ++dy) {
        const std::int64_t half = root(largest - dy * dy);
        covered.set(y + dy, x - half, x + half);
        covered.set(y - dy, x - half, x + half);
      }
    }
  }
  return covered.take();
}

Image union_of_disks(std::uint32_t width, std::uint32_t height, std::span<const Disk> disks) {
  Runs covered(width, height);
  for (const Disk& disk : disks) {
    // In coordinates in which the centres of pixels are whole numbers.
    const double x = disk.center.x - 0.5, y = disk.center.y - 0.5;
    const double first = std::max(std::ceil(y - disk.radius), 0.0);
    const double last = std::min(std::floor(y + disk.radius), height - 1.0);
    for (double row = first; row <= last; ++row) {
      const double half =
          std::sqrt(std::max(0.0, disk.radius * disk.radius - (row - y) * (row - y)));
      // Clamped before they become whole numbers: a radius may be any double.
      covered.set(static_cast<std::int64_t>(row),
                  static_cast<std::int64_t>(std::max(std::ceil(x - half), 0.0)),
                  static_cast<std::int64_t>(std::min(std::floor(x + half), width - 1.0)));
    }
  }
  return covered.take();
}

}  // namespace medial
