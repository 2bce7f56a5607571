#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "medial/geometry.h"

namespace medial {

namespace detail {
/// How many of so many elements come first where they are halved, so that both parts hold whole
/// nodes of a tree: a multiple of the largest power of the fan-out below the count.
inline std::size_t whole_half(std::size_t count, std::size_t fan_out) {
  std::size_t whole = fan_out;
  while (whole * fan_out < count) whole *= fan_out;
  return ((count + whole - 1) / whole / 2) * whole;
}

/// Halves indices by their places, across the longer side of these, and returns how many come
/// first.
template <class Place>
std::size_t halve_by_place(std::span<std::uint32_t> order, const Place& place,
                           std::size_t fan_out) {
  Box box = Box::nothing();
  for (const std::uint32_t i : order) box.add(place(i));
  const bool by_x = box.high.x - box.low.x >= box.high.y - box.low.y;
  const std::size_t middle = whole_half(order.size(), fan_out);
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

/// Two directions, of unit length times how far apart pieces are to be taken along each.
struct Axes {
  Vec2 along, across;
};

/// The direction in which pieces are longest, from a point to another, shortened by how many times
/// as long they are there as across it; and the one across. By their tensor of inertia.
template <class Chord>
Axes axes_of(std::span<const std::uint32_t> pieces, const Chord& chord) {
  constexpr double least = 0x1p-40;
  double xx = 0, xy = 0, yy = 0;
  for (const std::uint32_t i : pieces) {
    const Vec2 c = chord(i);
    xx += c.x * c.x;
    xy += c.x * c.y;
    yy += c.y * c.y;
  }
  const double difference = 0.5 * (xx - yy), half = 0.5 * (xx + yy);
  const double size = std::hypot(difference, xy);
  if (!(size > 0)) return {{1, 0}, {0, 1}};
  Vec2 along = difference > 0 ? Vec2{difference + size, xy} : Vec2{xy, size - difference};
  along = (1 / norm(along)) * along;
  const double longer = half + size, shorter = std::max(half - size, least * longer);
  return {std::sqrt(shorter / longer) * along, left_of(along)};
}

/// Puts pieces that lie in each other's way in an order in which each aligned run of fan_out^k of
/// them lies close together: halved across the direction in which they are short beside how far
/// they are apart. `middle` and `chord` give a piece's. O(n log n).
template <class Middle, class Chord>
void order_overlapping(std::span<std::uint32_t> order, const Middle& middle, const Chord& chord,
                       std::size_t fan_out) {
  struct Key {
    double along, across;
    std::uint32_t piece;
  };
  std::vector<Key> keys;
  keys.reserve(order.size());
  const auto halve = [&](std::span<std::uint32_t> pieces) {
    const Axes axes = axes_of(pieces, chord);
    keys.clear();
    Box box = Box::nothing();
    for (const std::uint32_t i : pieces) {
      const Vec2 place{dot(axes.along, middle(i)), dot(axes.across, middle(i))};
      box.add(place);
      keys.push_back({place.x, place.y, i});
    }
    const std::size_t half = detail::whole_half(pieces.size(), fan_out);
    const auto at = keys.begin() + static_cast<std::ptrdiff_t>(half);
    if (box.high.x - box.low.x >= box.high.y - box.low.y)
      std::nth_element(keys.begin(), at, keys.end(),
                       [](const Key& a, const Key& b) { return a.along < b.along; });
    else
      std::nth_element(keys.begin(), at, keys.end(),
                       [](const Key& a, const Key& b) { return a.across < b.across; });
    for (std::size_t i = 0; i < keys.size(); ++i) pieces[i] = keys[i].piece;
    return half;
  };
  std::vector<std::span<std::uint32_t>> stack{order};
  while (!stack.empty()) {
    const std::span<std::uint32_t> pieces = stack.back();
    stack.pop_back();
    if (pieces.size() <= fan_out) continue;
    const std::size_t half = halve(pieces);
    stack.push_back(pieces.first(half));
    stack.push_back(pieces.subspan(half));
  }
}

/// The indices of points along a Z-curve through their bounding box (Morton 1966), 2^32 cells wide
/// on each side: neighbours in the order lie close together, mostly. Points of one cell keep their
/// order. Several times faster than spatial_order(), and less tight. O(n).
std::vector<std::uint32_t> z_order(std::span<const Vec2> points);

/// The same along a Hilbert curve (Hilbert 1891), which never jumps, and within a cell that holds
/// many points along another one, so that clusters of any size are in order, too.
std::vector<std::uint32_t> hilbert_order(std::span<const Vec2> points);

}  // namespace medial
