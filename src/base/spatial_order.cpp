#include "base/spatial_order.h"

#include <array>

namespace medial {
namespace {

/// The bits of `value` at the even places of the result.
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

/// Distributes by the highest bits of the keys, so many that points spread evenly are alone there,
/// and compares what has them in common.
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

}  // namespace medial
