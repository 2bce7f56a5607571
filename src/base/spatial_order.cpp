#include "base/spatial_order.h"

#include <array>
#include <utility>

#include "base/memory.h"

namespace medial {
namespace {

/// Moves the bits of `value` to the even places of the result.
std::uint64_t spread(std::uint32_t value) {
  std::uint64_t bits = value;
  bits = (bits | (bits << 16)) & 0x0000FFFF0000FFFF;
  bits = (bits | (bits << 8)) & 0x00FF00FF00FF00FF;
  bits = (bits | (bits << 4)) & 0x0F0F0F0F0F0F0F0F;
  bits = (bits | (bits << 2)) & 0x3333333333333333;
  return (bits | (bits << 1)) & 0x5555555555555555;
}

struct Cell {
  std::uint64_t key;
  std::uint32_t point;
  friend bool operator<(const Cell& a, const Cell& b) {
    return a.key != b.key ? a.key < b.key : a.point < b.point;
  }
};

/// Distributes cells by so many of the highest bits of their keys that evenly spread points would
/// be alone, and sorts cells with equal bits by comparison.
void sort(std::vector<Cell>& cells) {
  constexpr unsigned digit = 11, key_bits = 64;
  unsigned digits = 1;
  while ((cells.size() >> (digits * digit)) > 0) ++digits;
  if (cells.size() < (1U << digit)) {
    std::sort(cells.begin(), cells.end());
    return;
  }
  std::vector<Cell> other(cells.size());
  const unsigned lowest = key_bits - digits * digit;
  for (unsigned shift = lowest; shift < key_bits; shift += digit) {
    constexpr std::uint64_t mask = (1U << digit) - 1;
    std::array<std::uint32_t, (1U << digit) + 1> begin{};
    for (const Cell& cell : cells) ++begin[((cell.key >> shift) & mask) + 1];
    for (std::size_t i = 0; i + 1 < begin.size(); ++i) begin[i + 1] += begin[i];
    for (const Cell& cell : cells) other[begin[(cell.key >> shift) & mask]++] = cell;
    cells.swap(other);
  }
  for (auto run = cells.begin(); run != cells.end();) {
    auto end = run + 1;
    while (end != cells.end() && (end->key >> lowest) == (run->key >> lowest)) ++end;
    if (end - run > 1) std::sort(run, end);
    run = end;
  }
}

/// Three levels of a Hilbert curve at once: from a state times 64 and the cell's place along a
/// Z-curve to the next state times 64 and the place along the Hilbert curve. States: bit 0, x and y
/// swapped; bit 1, both mirrored.
struct HilbertSteps {
  std::array<std::uint8_t, 256> step{};
  constexpr HilbertSteps() {
    for (unsigned from = 0; from < step.size(); ++from) {
      unsigned state = from >> 6U, place = 0;
      for (unsigned shift = 6; shift > 0;) {
        shift -= 2;
        unsigned x = (from >> shift) & 1U, y = (from >> (shift + 1)) & 1U;
        if ((state & 1U) != 0) std::swap(x, y);
        if ((state & 2U) != 0) x = 1 - x, y = 1 - y;
        const unsigned quarter = x == 0 ? y : 3 - y;
        if (quarter == 0) state ^= 1U;
        if (quarter == 3) state ^= 3U;
        place = 4 * place + quarter;
      }
      step[from] = static_cast<std::uint8_t>((state << 6U) | place);
    }
  }
};

/// The place along a Hilbert curve of a cell of 4096 x 4096.
std::uint32_t hilbert_place(std::uint32_t x, std::uint32_t y) {
  static constexpr HilbertSteps steps;
  const std::uint64_t cell = spread(x) | (spread(y) << 1);
  std::uint32_t place = 0, state = 0;
  for (unsigned shift = 24; shift > 0;) {
    shift -= 6;
    const std::uint32_t step = steps.step[state | ((cell >> shift) & 63U)];
    place = (place << 6U) | (step & 63U);
    state = step & ~63U;
  }
  return place;
}

/// Sorts by bits 32 to 55.
void sort_by_place(std::vector<std::uint64_t>& keys) {
  constexpr std::size_t few = 512;
  if (keys.size() < few) return std::sort(keys.begin(), keys.end());
  std::vector<std::uint64_t> other;
  reserve_large(other, keys.size());
  other.resize(keys.size());
  for (unsigned shift = 32; shift < 56; shift += 8) {
    const auto digit_of = [shift](std::uint64_t key) { return (key >> shift) & 0xFF; };
    std::array<std::uint32_t, 257> begin{};
    for (const std::uint64_t key : keys) ++begin[digit_of(key) + 1];
    for (std::size_t i = 0; i < 256; ++i) begin[i + 1] += begin[i];
    for (const std::uint64_t key : keys) other[begin[digit_of(key)]++] = key;
    keys.swap(other);
  }
}

/// Sorts points along a Hilbert curve through their box; if a cell has more than a few points,
/// sorts these along a curve through their own box.
void sort_along_curve(std::span<const Vec2> points, std::span<std::uint32_t> order) {
  Box box = Box::nothing();
  for (const std::uint32_t i : order) box.add(points[i]);
  const double side = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  constexpr double smallest = 0x1p-1000, largest = 0x1p1000;
  if (!(side > smallest && side < largest)) return;
  const double cells = 4095 / side;
  std::vector<std::uint64_t> keys;
  reserve_large(keys, order.size());
  for (const std::uint32_t i : order) {
    const auto x = static_cast<std::uint32_t>(cells * (points[i].x - box.low.x));
    const auto y = static_cast<std::uint32_t>(cells * (points[i].y - box.low.y));
    keys.push_back((std::uint64_t{hilbert_place(x, y)} << 32U) | i);
  }
  sort_by_place(keys);
  constexpr std::size_t few = 4;
  for (std::size_t begin = 0, end; begin < keys.size(); begin = end) {
    for (end = begin; end < keys.size() && (keys[end] ^ keys[begin]) >> 32U == 0; ++end)
      order[end] = static_cast<std::uint32_t>(keys[end]);
    if (end - begin > few) sort_along_curve(points, order.subspan(begin, end - begin));
  }
}

}  // namespace

std::vector<std::uint32_t> z_order(std::span<const Vec2> points) {
  if (points.empty()) return {};
  Box box = Box::nothing();
  for (const Vec2 p : points) box.add(p);
  const auto [low, high] = box;
  const double side = std::max(high.x - low.x, high.y - low.y);
  const double cells = side > 0 ? 0xFFFFFFFF / side : 0;

  std::vector<Cell> order(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const auto x = static_cast<std::uint32_t>(cells * (points[i].x - low.x));
    const auto y = static_cast<std::uint32_t>(cells * (points[i].y - low.y));
    order[i] = {spread(x) | (spread(y) << 1), i};
  }
  sort(order);
  std::vector<std::uint32_t> result(points.size());
  std::transform(order.begin(), order.end(), result.begin(),
                 [](const Cell& cell) { return cell.point; });
  return result;
}

std::vector<std::uint32_t> hilbert_order(std::span<const Vec2> points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  sort_along_curve(points, order);
  return order;
}

}  // namespace medial
