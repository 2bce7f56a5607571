#include <algorithm>
#include <bit>
#include <numeric>

#include "medial/pack.h"
#include "ops/code_bytes.h"

namespace medial {
namespace {

constexpr std::uint64_t squares_version = 1;
constexpr std::uint32_t word_bits = 64;

struct Square {
  std::uint32_t x = 0, y = 0, size = 0;  ///< its upper left pixel, its side
};

/// The bits of columns [from, to) in the word that begins at column `base`.
std::uint64_t mask(std::uint32_t base, std::uint32_t from, std::uint32_t to) {
  const std::uint32_t low = std::max(base, from) - base,
                      high = std::min(base + word_bits, to) - base;
  const std::uint64_t below_high =
      high == word_bits ? ~std::uint64_t{0} : (std::uint64_t{1} << high) - 1;
  return below_high & ~((std::uint64_t{1} << low) - 1);
}

/// Calls visit(word of the row, mask) over columns [from, to) until it returns true.
template <class Visit>
bool over_row(std::uint32_t from, std::uint32_t to, const Visit& visit) {
  for (std::uint32_t base = from / word_bits * word_bits; base < to; base += word_bits)
    if (visit(base / word_bits, mask(base, from, to))) return true;
  return false;
}

/// Pixels that are covered, row by row with the number of those in each word (Fenwick 1994).
class Covered {
 public:
  Covered(std::uint32_t width, std::uint32_t height)
      : image_(width, height),
        words_((width + word_bits - 1) / word_bits),
        counts_(std::size_t{words_} * height, 0) {}

  /// Covers columns [x0, x1) of rows [y0, y1).
  void fill(std::uint32_t x0, std::uint32_t y0, std::uint32_t x1, std::uint32_t y1) {
    for (std::uint32_t y = y0; y < y1; ++y) {
      const auto row = image_.row(y);
      over_row(x0, x1, [&](std::uint32_t word, std::uint64_t bits) {
        const auto more = static_cast<std::uint32_t>(std::popcount(bits & ~row[word]));
        row[word] |= bits;
        for (std::uint32_t i = word + 1; more > 0 && i <= words_; i += i & (~i + 1))
          counts_[std::size_t{y} * words_ + i - 1] += more;
        return false;
      });
    }
  }
  /// Whether at least `least` pixels of a square are not covered. O(size log(width)), less where
  /// some of its rows decide.
  bool leaves(const Square& s, std::uint64_t least) const {
    std::uint64_t open = 0, below = std::uint64_t{s.size} * s.size;
    for (std::uint32_t y = s.y; y < s.y + s.size && open < least && open + below >= least; ++y) {
      open += open_in(y, s.x, s.x + s.size);
      below -= s.size;
    }
    return open >= least;
  }

 private:
  /// Of the row's first words.
  std::uint64_t covered_before(std::uint32_t y, std::uint32_t word) const {
    std::uint64_t count = 0;
    for (std::uint32_t i = word; i > 0; i &= i - 1)
      count += counts_[std::size_t{y} * words_ + i - 1];
    return count;
  }
  std::uint64_t open_in(std::uint32_t y, std::uint32_t from, std::uint32_t to) const {
    const auto row = image_.row(y);
    const auto count = [&row](std::uint32_t first, std::uint32_t last) {
      std::uint64_t open = 0;
      over_row(first, last, [&](std::uint32_t word, std::uint64_t bits) {
        open += static_cast<unsigned>(std::popcount(bits & ~row[word]));
        return false;
      });
      return open;
    };
    constexpr std::uint32_t few = 16;  // words, which are counted as fast
    const std::uint32_t first = (from + word_bits - 1) / word_bits, last = to / word_bits;
    if (last < first + few) return count(from, to);
    const std::uint64_t between = std::uint64_t{last - first} * word_bits;
    return count(from, first * word_bits) + count(last * word_bits, to) + between -
           (covered_before(y, last) - covered_before(y, first));
  }

  Image image_;
  std::uint32_t words_;
  std::vector<std::uint32_t> counts_;
};

/// All squares of foreground pixels that no larger one contains.
std::vector<Square> maximal_squares(const Image& image) {
  const std::uint32_t width = image.width(), height = image.height();
  std::vector<Square> squares;
  // size[y][x]: the largest square with its lower right pixel there. Two rows at a time; a square
  // is contained in a larger one if it is in one that is a pixel larger, to one of three sides.
  std::vector<std::uint32_t> above(width + 1, 0), here(width + 1, 0);
  for (std::uint32_t y = 0; y <= height; ++y) {
    here[0] = 0;
    for (std::uint32_t x = 0; x < width; ++x)
      here[x + 1] =
          y < height && image.at(x, y) ? 1 + std::min({above[x], above[x + 1], here[x]}) : 0;
    for (std::uint32_t x = 0; y > 0 && x < width; ++x) {
      const std::uint32_t size = above[x + 1];
      if (size == 0) continue;
      const std::uint32_t right = x + 1 < width ? above[x + 2] : 0;
      const std::uint32_t aslant = x + 1 < width ? here[x + 2] : 0;
      if (right > size || here[x + 1] > size || aslant > size) continue;
      squares.push_back({x + 1 - size, y - size, size});
    }
    std::swap(above, here);
  }
  return squares;
}

/// The pixels of squares in the order of their rows: row by row, with how many squares begin less
/// how many end at each column. O(pixels + squares log(squares)), however much they overlap.
Image union_of(const std::vector<Square>& squares, std::uint32_t width, std::uint32_t height) {
  std::vector<std::uint32_t> by_end(squares.size());
  std::iota(by_end.begin(), by_end.end(), 0U);
  const auto end_of = [&](std::uint32_t i) { return squares[i].y + squares[i].size; };
  std::sort(by_end.begin(), by_end.end(),
            [&](std::uint32_t a, std::uint32_t b) { return end_of(a) < end_of(b); });
  Image image(width, height);
  std::vector<std::int32_t> change(std::size_t{width} + 1, 0);
  std::size_t begun = 0, ended = 0;
  for (std::uint32_t y = 0; y < height && ended < squares.size(); ++y) {
    for (; begun < squares.size() && squares[begun].y == y; ++begun) {
      ++change[squares[begun].x];
      --change[squares[begun].x + squares[begun].size];
    }
    for (; ended < begun && end_of(by_end[ended]) == y; ++ended) {
      const Square& s = squares[by_end[ended]];
      --change[s.x];
      ++change[s.x + s.size];
    }
    if (begun == ended) continue;
    const auto row = image.row(y);
    std::int32_t covering = 0;
    for (std::uint32_t x = 0; x < width; ++x) {
      covering += change[x];
      if (covering > 0) row[x / word_bits] |= std::uint64_t{1} << (x % word_bits);
    }
  }
  return image;
}

}  // namespace

ShapeCode encode_squares(const Image& image, std::uint32_t error, SquareReport* report) {
  std::vector<Square> squares = maximal_squares(image);
  std::stable_sort(squares.begin(), squares.end(),
                   [](const Square& a, const Square& b) { return a.size > b.size; });
  // What is covered, or near enough to what is.
  Covered done(image.width(), image.height());
  // First those squares that mostly cover what none does yet, then whatever is left to cover.
  std::vector<Square> chosen;
  for (const std::uint64_t divisor : {2U, 4U, 8U, 16U, 0U}) {
    std::vector<Square> rest;
    for (const Square& s : squares) {
      const std::uint64_t area = std::uint64_t{s.size} * s.size;
      if (!done.leaves(s, divisor == 0 ? 1 : (area + divisor - 1) / divisor)) {
        rest.push_back(s);
        continue;
      }
      chosen.push_back(s);
      const auto low = [error](std::uint32_t v) { return v > error ? v - error : 0; };
      done.fill(low(s.x), low(s.y), std::min(image.width(), s.x + s.size + error),
                std::min(image.height(), s.y + s.size + error));
    }
    squares = std::move(rest);
  }
  std::sort(chosen.begin(), chosen.end(),
            [](const Square& a, const Square& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });

  ShapeCode code;
  for (const std::uint64_t number :
       {squares_version, std::uint64_t{image.width()}, std::uint64_t{image.height()},
        static_cast<std::uint64_t>(chosen.size())})
    ops::put_number(code[0], number);
  Square last;
  for (const Square& s : chosen) {
    ops::put_number(code[1], s.y - last.y);
    ops::put_signed(code[2], static_cast<std::int64_t>(s.x) - last.x);
    ops::put_number(code[3], s.size - 1);
    last = s;
  }
  if (report != nullptr) {
    const Image covered = union_of(chosen, image.width(), image.height());
    *report = {chosen.size(), image.count() - covered.count()};
  }
  return code;
}

Result<Image> decode_squares(const ShapeCode& code) {
  const auto malformed = [](const char* text) { return Error{ErrorCode::malformed, text, {}}; };
  ops::ByteReader header(code[0]), ys(code[1]), xs(code[2]), sizes(code[3]);
  const auto version = header.number(), width = header.number(), height = header.number(),
             count = header.number();
  if (!version || !width || !height || !count) return malformed("the code ends early");
  if (*version != squares_version)
    return Error{ErrorCode::unsupported, "the code is of another version", {}};
  if (!fits_image(*width, *height))
    return Error{ErrorCode::too_large, "the image is too large", {}};
  if (*count > sizes.left()) return malformed("the code has fewer squares than it says");
  std::vector<Square> squares;
  std::uint64_t y = 0;
  std::int64_t x = 0;
  for (std::uint64_t i = 0; i < *count; ++i) {
    const auto down = ys.number(), less = sizes.number();
    const auto step = xs.signed_number();
    const auto most = static_cast<std::int64_t>(*width);
    if (!down || !less || !step || *down > *height || *less >= *width || *less >= *height ||
        *step > most || *step < -most)
      return malformed("the code makes no squares");
    y += *down;
    x += *step;
    const std::uint64_t size = *less + 1;
    if (x < 0 || static_cast<std::uint64_t>(x) + size > *width || y + size > *height)
      return malformed("a square lies outside of the image");
    squares.push_back({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                       static_cast<std::uint32_t>(size)});
  }
  if (header.left() + xs.left() + ys.left() + sizes.left() > 0)
    return malformed("the code does not end with its last square");
  return union_of(squares, static_cast<std::uint32_t>(*width), static_cast<std::uint32_t>(*height));
}

}  // namespace medial
