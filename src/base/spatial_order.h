#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/threads.h"
#include "medial/geometry.h"

namespace medial {

namespace detail {
/// The size of the first half of `count` elements, such that both halves fill whole nodes of a
/// tree: a multiple of the largest power of the fan-out below the count.
inline std::size_t whole_half(std::size_t count, std::size_t fan_out) {
  std::size_t whole = fan_out;
  while (whole * fan_out < count) whole *= fan_out;
  return ((count + whole - 1) / whole / 2) * whole;
}

/// Splits indices into halves across the longer side of their places. Returns the size of the first
/// half.
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

/// An order of points in which each aligned run of fan_out^k points is spatially compact, for k =
/// 1, 2, ...: the leaves of an implicit tree. O(n log n).
inline std::vector<std::uint32_t> spatial_order(std::span<const Vec2> points, std::size_t fan_out) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  detail::order_by_place(order, points, fan_out);
  return order;
}

/// Two perpendicular directions whose lengths weight distances. Pieces are split along the
/// direction in which they are farthest apart.
struct Axes {
  Vec2 along, across;
};

/// The main direction of the pieces' chords, with the length sqrt(spread across / spread along),
/// and the perpendicular direction, of unit length.
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
  const double c = difference / size, s = xy / size;  // cosine and sine of twice the angle
  Vec2 along = c > 0 ? Vec2{c + 1, s} : Vec2{s, 1 - c};
  along = (1 / norm(along)) * along;
  const double longer = half + size, shorter = std::max(half - size, least * longer);
  return {std::sqrt(shorter / longer) * along, left_of(along)};
}

namespace detail {
/// Orders pieces by repeated stable halving. `middle` and `chord` give those of a piece.
template <class Middle, class Chord>
class Halver {
 public:
  Halver(const Middle& middle, const Chord& chord, std::size_t fan_out)
      : middle_(middle), chord_(chord), fan_out_(fan_out) {}

  void order(std::span<std::uint32_t> pieces) {
    constexpr std::size_t grain = std::size_t{1} << 14;
    while (pieces.size() > fan_out_) {
      const std::size_t half = halve(pieces);
      const std::span<std::uint32_t> first = pieces.first(half), second = pieces.subspan(half);
      if (pieces.size() > grain) {
        Halver other(middle_, chord_, fan_out_);
        return in_parallel([&] { order(first); }, [&] { other.order(second); });
      }
      order(first);
      pieces = second;
    }
  }

 private:
  struct Key {
    double place, beside;
    std::uint32_t at;  ///< index of the piece; makes all keys different, so any sort is stable
    friend bool operator<(const Key& a, const Key& b) {
      return std::tie(a.place, a.beside, a.at) < std::tie(b.place, b.beside, b.at);
    }
  };

  std::size_t halve(std::span<std::uint32_t> pieces) {
    const Axes axes = axes_of(pieces, chord_);
    keys_.clear();
    Box box = Box::nothing();
    for (std::uint32_t at = 0; at < pieces.size(); ++at) {
      const Vec2 middle = middle_(pieces[at]);
      const Vec2 place{dot(axes.along, middle), dot(axes.across, middle)};
      box.add(place);
      keys_.push_back({place.x, place.y, at});
    }
    if (box.high.x - box.low.x < box.high.y - box.low.y)
      for (Key& key : keys_) std::swap(key.place, key.beside);
    const std::size_t half = whole_half(pieces.size(), fan_out_);
    const auto middle = keys_.begin() + static_cast<std::ptrdiff_t>(half);
    std::nth_element(keys_.begin(), middle, keys_.end());
    is_first_.assign(pieces.size(), 0);
    for (auto key = keys_.begin(); key != middle; ++key) is_first_[key->at] = 1;
    second_.clear();
    std::size_t kept = 0;
    for (std::size_t at = 0; at < pieces.size(); ++at) {
      if (is_first_[at] != 0)
        pieces[kept++] = pieces[at];
      else
        second_.push_back(pieces[at]);
    }
    std::copy(second_.begin(), second_.end(), pieces.begin() + static_cast<std::ptrdiff_t>(half));
    return half;
  }

  const Middle& middle_;
  const Chord& chord_;
  const std::size_t fan_out_;
  std::vector<Key> keys_;
  std::vector<std::uint8_t> is_first_;
  std::vector<std::uint32_t> second_;
};
}  // namespace detail

/// Orders overlapping pieces such that each aligned run of fan_out^k pieces is spatially compact.
/// Halves them across their main direction, unless they are farther apart along it than they are
/// long. `middle` and `chord` give those of a piece. O(n log n).
template <class Middle, class Chord>
void order_overlapping(std::span<std::uint32_t> order, const Middle& middle, const Chord& chord,
                       std::size_t fan_out) {
  detail::Halver<Middle, Chord>(middle, chord, fan_out).order(order);
}

/// The indices of points along a Z-order curve (Morton 1966) through their bounding box, with 2^32
/// cells per side. Points of one cell keep their order. Several times faster than spatial_order(),
/// and less compact. O(n).
std::vector<std::uint32_t> z_order(std::span<const Vec2> points);

/// The same along a Hilbert curve (Hilbert 1891), which never jumps. A cell with many points has a
/// curve of its own, so clusters of any size are ordered, too.
std::vector<std::uint32_t> hilbert_order(std::span<const Vec2> points);

}  // namespace medial
