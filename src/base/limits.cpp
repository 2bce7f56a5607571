#include "base/limits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace medial {

std::optional<Error> beyond_limits(const Shape& shape) {
  double largest = 0;
  for (const Vec2 p : shape.points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  const double smallest = smallest_coordinate * std::max(1.0, largest);
  const auto within = [smallest](double c) {
    return c == 0 || (std::abs(c) >= smallest && std::abs(c) <= largest_coordinate);
  };
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    const Vec2 p = shape.points[i];
    if (within(p.x) && within(p.y)) continue;
    Error error{ErrorCode::unsupported,
                "a coordinate is larger than 1e100, or smaller than 1e-100 (or than that share of "
                "the largest) without being 0",
                {}};
    error.place.point = p;
    if (i < shape.sources.size()) {
      error.place.ring = shape.sources[i].ring;
      error.place.vertex = shape.sources[i].vertex;
    }
    return error;
  }
  return std::nullopt;
}

}  // namespace medial
