#include "base/spatial_order.h"

#include <boost/sort/spreadsort/integer_sort.hpp>

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

}  // namespace

std::vector<std::uint32_t> z_order(std::span<const Vec2> points) {
  if (points.empty()) return {};
  Vec2 low = points[0], high = low;
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  const double cells = side > 0 ? 0xFFFFFFFF / side : 0;

  std::vector<Cell> order(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const auto x = static_cast<std::uint32_t>(cells * (points[i].x - low.x));
    const auto y = static_cast<std::uint32_t>(cells * (points[i].y - low.y));
    order[i] = {spread(x) | (spread(y) << 1), i};
  }
  boost::sort::spreadsort::integer_sort(
      order.begin(), order.end(),
      [](const Cell& cell, unsigned offset) { return cell.key >> offset; });
  std::vector<std::uint32_t> result(points.size());
  std::transform(order.begin(), order.end(), result.begin(),
                 [](const Cell& cell) { return cell.point; });
  return result;
}

}  // namespace medial
