#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "medial/geometry.h"

namespace medial {

namespace detail {
/// Halves indices by their places, across the longer side of these, and returns how many come
/// first. Both parts hold whole nodes of the tree: the left one a multiple of the largest power of
/// the fan-out below the count.
template <class Place>
std::size_t halve_by_place(std::span<std::uint32_t> order, const Place& place,
                           std::size_t fan_out) {
  Box box = Box::nothing();
  for (const std::uint32_t i : order) box.add(place(i));
  const bool by_x = box.high.x - box.low.x >= box.high.y - box.low.y;
  std::size_t whole = fan_out;
  while (whole * fan_out < order.size()) whole *= fan_out;
  const std::size_t middle = ((order.size() + whole - 1) / whole / 2) * whole;
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(middle), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return by_x ? place(a).x < place(b).x : place(a).y < place(b).y;
                   });
  return middle;
}

inline void order_by_place(std::span<std::uint32_t> order, std::span<const Vec2> points,
                           std::size_t fan_out) {
  while (order.size() > fan_out) {
    const std::size_t middle = halve_by_place(
        order, [&](std::uint32_t i) { return points[i]; }, fan_out);
    order_by_place(order.first(middle), points, fan_out);
    order = order.subspan(middle);
  }
}
}  // namespace detail

/// The indices of points in an order in which each aligned run of fan_out^k of them lies close
/// together, k = 1, 2, ...: the leaves of a tree without pointers. O(n log n).
inline std::vector<std::uint32_t> spatial_order(std::span<const Vec2> points, std::size_t fan_out) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  detail::order_by_place(order, points, fan_out);
  return order;
}

/// The indices of points along a Z-curve through their bounding box (Morton 1966), 2^32 cells wide
/// on each side: neighbours in the order lie close together, mostly. Points of one cell keep their
/// order. Several times faster than spatial_order(), and less tight. O(n).
std::vector<std::uint32_t> z_order(std::span<const Vec2> points);

/// The same along a Hilbert curve (Hilbert 1891), which never jumps, and within a cell that holds
/// many points along another one, so that clusters of any size are in order, too.
std::vector<std::uint32_t> hilbert_order(std::span<const Vec2> points);

}  // namespace medial
