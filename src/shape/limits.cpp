#include "shape/limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/compat.h"
#include "base/tolerance.h"

namespace medial {

namespace {

std::optional<Error> beyond_limits(std::span<const Vec2> points, double largest,
                                   std::span<const VertexSource> sources) {
  // Sizes are in the same order as their bits, and 0 less one bit is above all.
  std::uint64_t most = bit_cast<std::uint64_t>(largest), least = ~std::uint64_t{0};
  for (const Vec2 p : points)
    for (const double c : {p.x, p.y}) {
      const auto bits = bit_cast<std::uint64_t>(std::abs(c));
      most = std::max(most, bits);
      least = std::min(least, bits - 1);
    }
  largest = bit_cast<double>(most);
  const double smallest = smallest_coordinate * std::max(1.0, largest);
  if (largest <= largest_coordinate && least >= bit_cast<std::uint64_t>(smallest))
    return std::nullopt;
  const auto within = [smallest](double c) {
    return c == 0 || (std::abs(c) >= smallest && std::abs(c) <= largest_coordinate);
  };
  const auto bad =
      ranges::find_if_not(points, [&within](Vec2 p) { return within(p.x) && within(p.y); });
  if (bad == points.end()) return std::nullopt;
  // Others may be too small because one is too large: that one is named.
  const auto too_large = ranges::find_if_not(points, [](Vec2 p) {
    return std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate;
  });
  const auto i =
      static_cast<std::size_t>((too_large == points.end() ? bad : too_large) - points.begin());
  const Vec2 p = points[i];
  Error error{ErrorCode::unsupported,
              "a coordinate is larger than 1e100, or smaller than 1e-100 (or than that share of "
              "the largest) without being 0",
              {}};
  error.place.point = p;
  constexpr std::uint32_t of_enclosure = 0xFFFFFFFF;
  if (i < sources.size() && sources[i].ring != of_enclosure) {
    error.place.ring = sources[i].ring;
    error.place.vertex = sources[i].vertex;
  }
  return error;
}

}  // namespace

std::optional<Error> beyond_limits(const Shape& shape) {
  return beyond_limits(shape.points, 0, shape.sources);
}

std::optional<Error> beyond_limits(const PlanarGraph& planar_graph, const Box& box) {
  const std::array<Vec2, 2> corners{box.low, box.high};
  // A point of the input says more than the box that lies around it.
  if (auto error = beyond_limits(planar_graph.points, largest_coordinate_in(box),
                                 planar_graph.point_sources))
    return error;
  return beyond_limits(corners, 0, {});
}

}  // namespace medial
