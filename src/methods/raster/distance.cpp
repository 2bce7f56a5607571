
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/compat.h"
#include "base/in_flight.h"
#include "base/runs.h"
#include "base/threads.h"
#include "medial/raster.h"

namespace medial {
namespace {

/// The distance of a pixel to the nearest background pixel of its column, in whole pixels.
using ColumnDistance = std::uint16_t;
constexpr ColumnDistance no_background = std::numeric_limits<ColumnDistance>::max();

/// Eight pixels of a row as eight masks.
using MaskTable = std::array<std::array<ColumnDistance, 8>, 256>;
constexpr MaskTable make_masks() {
  MaskTable table{};
  for (std::size_t bits = 0; bits < 256; ++bits)
    for (std::size_t i = 0; i < 8; ++i) table[bits][i] = (bits >> i) & 1 ? 0xffff : 0;
  return table;
}
constexpr MaskTable masks = make_masks();

/// The width of a strip of columns, starting at a multiple of 64, that stays in the fastest cache.
constexpr std::size_t strip_words = 16;

/// Both scans of the columns of words [first, last): down, counting from the background above, and
/// up again, taking the smaller count. `distances` has rows of whole words.
void scan_columns(const Image& image, std::size_t first, std::size_t last, bool border,
                  ColumnDistance* distances) {
  const std::size_t stride = image.row(0).size() * 64;
  const std::size_t width = (last - first) * 64;
  std::array<ColumnDistance, strip_words * 64> before;
  before.fill(border ? 0 : no_background);
  const ColumnDistance* above = before.data();
  for (std::uint32_t y = 0; y < image.height(); ++y) {
    ColumnDistance* const here = distances + y * stride + first * 64;
    const std::span<const std::uint64_t> row = image.row(static_cast<std::uint32_t>(y));
    for (std::size_t word = first; word < last; ++word) {
      for (std::size_t byte = 0; byte < 8; ++byte) {
        const auto& mask = masks[(row[word] >> (8 * byte)) & 255];
        const std::size_t at = (word - first) * 64 + byte * 8;
        for (std::size_t i = 0; i < 8; ++i) {
          // Counting stops at the largest value, so that no_background does not change.
          const ColumnDistance one = above[at + i] != no_background;
          here[at + i] = static_cast<ColumnDistance>((above[at + i] + one) & mask[i]);
        }
      }
    }
    above = here;
  }
  const ColumnDistance* below = before.data();
  for (std::uint32_t y = image.height(); y-- > 0;) {
    ColumnDistance* const here = distances + y * stride + first * 64;
    for (std::size_t i = 0; i < width; ++i) {
      const ColumnDistance one = below[i] != no_background;
      here[i] = std::min(here[i], static_cast<ColumnDistance>(below[i] + one));
    }
    below = here;
  }
}

/// A parabola over the row: the squared distance to a point at `at`, `height` away from the row.
struct Parabola {
  std::int64_t at = 0;
  std::int64_t height = 0;  ///< squared
};

/// The lower envelope of parabolas that are added from left to right, and its values.
class Envelope {
 public:
  explicit Envelope(std::size_t capacity) : parabolas_(capacity) {}

  void clear() { size_ = 0; }
  bool empty() const { return size_ == 0; }

  /// Adds a parabola to the right of all others, and drops those that are nowhere lowest any more.
  void add(Parabola next) {
    while (size_ >= 2 && is_hidden(parabolas_[size_ - 2], parabolas_[size_ - 1], next)) --size_;
    parabolas_[size_++] = next;
  }

  /// Restarts with a sweep of value_at() to the right.
  void rewind() { lowest_ = 0; }
  /// The envelope at x; x must not decrease from call to call.
  std::int64_t value_at(std::int64_t x) {
    std::int64_t value = evaluate(parabolas_[lowest_], x);
    while (lowest_ + 1 < size_) {
      const std::int64_t next = evaluate(parabolas_[lowest_ + 1], x);
      if (next > value) break;
      value = next;
      ++lowest_;
    }
    return value;
  }

 private:
  static std::int64_t evaluate(const Parabola& p, std::int64_t x) {
    return (x - p.at) * (x - p.at) + p.height;
  }
  /// Whether b, between a and c, is nowhere below both: the crossing of a and b, at
  /// (b.height - a.height + b.at^2 - a.at^2) / 2 (b.at - a.at), is not left of that of b and c.
  static bool is_hidden(const Parabola& a, const Parabola& b, const Parabola& c) {
    const std::int64_t ab = b.height - a.height + (b.at - a.at) * (b.at + a.at);
    const std::int64_t bc = c.height - b.height + (c.at - b.at) * (c.at + b.at);
    return ab * (c.at - b.at) >= bc * (b.at - a.at);
  }

  std::vector<Parabola> parabolas_;
  std::size_t size_ = 0;
  std::size_t lowest_ = 0;
};

std::int64_t square(std::int64_t value) { return value * value; }

/// Distances to pixels in the run [begin, end) of foreground pixels of a row. Pixels beyond the
/// background pixels at both ends of the run are further away than those.
void measure_pixels(const ColumnDistance* column, std::int64_t begin, std::int64_t end,
                    std::int64_t width, bool border, Envelope& envelope, std::uint32_t* out) {
  envelope.clear();
  if (begin > 0 || border) envelope.add({begin - 1, 0});
  for (std::int64_t x = begin; x < end; ++x)
    if (column[x] != no_background) envelope.add({x, square(column[x])});
  if (end < width || border) envelope.add({end, 0});
  if (envelope.empty()) {
    std::fill(out + begin, out + end, DistanceMap::unbounded);
    return;
  }
  envelope.rewind();
  for (std::int64_t x = begin; x < end; ++x)
    out[x] = static_cast<std::uint32_t>(envelope.value_at(x));
}

/// Distances to cracks in a run, in halves of a pixel. The nearest point of a background square of
/// another column lies on that column's nearer side; the sides are at odd places, centres at even
/// ones. Of the two columns beside a side the higher background counts.
void measure_cracks(const ColumnDistance* column, std::int64_t begin, std::int64_t end,
                    Envelope& envelope, std::uint32_t* out) {
  const auto height = [column](std::int64_t x) { return square(2 * column[x] - 1); };
  envelope.clear();
  envelope.add({2 * begin - 1, 0});
  for (std::int64_t x = begin; x + 1 < end; ++x)
    envelope.add({2 * x + 1, std::min(height(x), height(x + 1))});
  envelope.add({2 * end - 1, 0});
  envelope.rewind();
  for (std::int64_t x = begin; x < end; ++x)
    out[x] = static_cast<std::uint32_t>(std::min(envelope.value_at(2 * x), height(x)));
}

DistanceMap transform(const Image& image, const DistanceOptions& options) {
  DistanceMap map;
  map.width = image.width();
  map.height = image.height();
  map.to = options.to;
  map.squared.resize(std::size_t{map.width} * map.height);
  if (map.squared.empty()) return map;
  const bool border = options.outside_is_background || options.to == DistanceTo::cracks;

  const std::size_t words = image.row(0).size();
  const auto columns = uninitialized<ColumnDistance[]>(words * 64 * map.height);
  const std::size_t strips = (words + strip_words - 1) / strip_words;
  parallel_for(strips, [&](std::size_t strip) {
    scan_columns(image, strip * strip_words, std::min(words, (strip + 1) * strip_words), border,
                 columns.get());
  });
  const std::int64_t width = map.width;
  parallel_ranges(map.height, 16, [&](std::size_t y, std::size_t last) {
    Envelope envelope(map.width + std::size_t{2});
    for (; y != last; ++y) {
      const ColumnDistance* const column = columns.get() + y * words * 64;
      std::uint32_t* const out = map.squared.data() + y * map.width;
      for_each_run(image.row(static_cast<std::uint32_t>(y)), width,
                   [&](std::int64_t begin, std::int64_t end) {
                     if (options.to == DistanceTo::cracks) {
                       measure_cracks(column, begin, end, envelope, out);
                     } else {
                       measure_pixels(column, begin, end, width, border, envelope, out);
                     }
                   });
    }
  });
  return map;
}

}  // namespace

double DistanceMap::at(std::uint32_t x, std::uint32_t y) const {
  const std::uint32_t value = squared_at(x, y);
  if (value == unbounded) return std::numeric_limits<double>::infinity();
  return std::sqrt(static_cast<double>(value)) * (to == DistanceTo::cracks ? 0.5 : 1);
}

Result<DistanceMap> distance_transform(const Image& image, const DistanceOptions& options) {
  if (options.threads < 0 || options.threads > most_threads)
    return Error{ErrorCode::invalid_option, "the number of threads must be in [0, 1024]", {}};
  if (!fits_image(image.width(), image.height()))
    return Error{ErrorCode::too_large, "the diagonal of the image is above 2^16 pixels", {}};
  return guarded([&]() -> Result<DistanceMap> {
    return on_threads(options.threads, [&] { return transform(image, options); });
  });
}

}  // namespace medial
