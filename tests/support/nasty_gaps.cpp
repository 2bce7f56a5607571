#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/generate_parts.h"
#include "support/nasty.h"

namespace medial::test {
namespace {

using Polygon = std::vector<Vec2>;

/// The gaps of one shape: all alike, or each of a size of its own.
class Gaps {
 public:
  explicit Gaps(Random& random)
      : random_(random), one_(random.power_of_ten(smallest, largest)), alike_(random.chance(0.5)) {}
  double next() { return alike_ ? one_ : random_.power_of_ten(smallest, largest); }
  double one() const { return one_; }

 private:
  static constexpr double smallest = -14, largest = -6;  // exponents of ten
  Random& random_;
  double one_;
  bool alike_;
};

/// Adds the convex parts that random cuts through their middles make of a polygon.
void cut_up(Random& random, const Polygon& polygon, int depth, std::vector<Polygon>& parts) {
  Vec2 middle{0, 0};
  for (const Vec2 p : polygon) middle = middle + p;
  middle = (1 / static_cast<double>(polygon.size())) * middle;
  const double angle = random.chance(0.5) ? random.chance(0.5) ? 0 : std::numbers::pi / 2
                                          : random.between(0, std::numbers::pi);
  const Vec2 normal = turned({1, 0}, angle);
  Polygon below, above;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double a = dot(normal, p - middle), b = dot(normal, q - middle);
    if (a <= 0) below.push_back(p);
    if (a >= 0) above.push_back(p);
    if (!(a * b < 0)) continue;
    below.push_back(p + (a / (a - b)) * (q - p));
    above.push_back(below.back());
  }
  if (depth == 0 || below.size() < 3 || above.size() < 3) {
    parts.push_back(polygon);
    return;
  }
  cut_up(random, below, depth - 1, parts);
  cut_up(random, above, depth - 1, parts);
}

/// Adds a convex polygon whose sides are moved inwards, as a ring.
void add_shrunk(const Polygon& polygon, double width, Rings& rings) {
  constexpr double flat = 1e-9;
  Polygon inner;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i];
    const Vec2 before = p - polygon[(i + polygon.size() - 1) % polygon.size()];
    const Vec2 after = polygon[(i + 1) % polygon.size()] - p;
    const Vec2 a = (1 / norm(before)) * left_of(before), b = (1 / norm(after)) * left_of(after);
    if (cross(a, b) > flat) inner.push_back(p + (width / (1 + dot(a, b))) * (a + b));
  }
  if (inner.size() >= 3) rings.push_back(ring_of(inner));
}

Polygon centred_square(double half) {
  return {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
}

/// Holes that would fill a square but for the gaps between them.
Rings slots(Random& random, Gaps& gaps) {
  constexpr double half = 0.3;
  std::vector<Polygon> parts;
  cut_up(random, centred_square(half), static_cast<int>(random.integer(1, 5)), parts);
  Rings rings{
      ring_of(centred_square(half + (random.chance(0.5) ? gaps.next() : random.between(0, 0.3))))};
  for (const Polygon& part : parts)
    if (random.chance(0.9)) add_shrunk(part, 0.5 * gaps.next(), rings);
  return rings;
}

/// Rectangular holes in rows and columns.
Rings rows_and_columns(Random& random, Gaps& gaps) {
  constexpr double half = 0.3;
  Rings rings{ring_of(centred_square(0.5))};
  std::vector<double> xs{-half, half}, ys{-half, half};
  for (std::int64_t k = random.integer(1, 4); k > 0; --k) {
    xs.push_back(random.between(-half, half));
    ys.push_back(random.between(-half, half));
  }
  std::sort(xs.begin(), xs.end());
  std::sort(ys.begin(), ys.end());
  for (std::size_t i = 0; i + 1 < xs.size(); ++i)
    for (std::size_t j = 0; j + 1 < ys.size(); ++j)
      if (random.chance(0.8))
        add_shrunk({{xs[i], ys[j]}, {xs[i + 1], ys[j]}, {xs[i + 1], ys[j + 1]}, {xs[i], ys[j + 1]}},
                   0.5 * gaps.next(), rings);
  return rings;
}

/// Wedges around one point.
Rings fan(Random& random, Gaps& gaps) {
  Rings rings{ring_of(centred_square(0.5))};
  const auto count = random.integer(3, 12);
  for (std::int64_t i = 0; i < count; ++i) {
    const double step = 2 * std::numbers::pi / static_cast<double>(count);
    const double from = step * static_cast<double>(i);
    const Vec2 arm{random.chance(0.5) ? 0.4 : random.between(0.1, 0.4), 0};
    add_shrunk({{0, 0}, turned({0.4, 0}, from), turned(arm, from + step)}, 0.5 * gaps.next(),
               rings);
  }
  return rings;
}

/// A bar with slits in it and thin teeth on it, some with pointed ends, some beside each other.
Rings slits(Random& random, Gaps& gaps) {
  constexpr double height = 0.3;
  Polygon bar{{0, 0}, {1, 0}, {1, height}};
  const auto count = random.integer(1, 8);
  double x = 1;
  for (std::int64_t i = 0; i < count; ++i) {
    const double width = gaps.next();
    const double end = random.chance(0.3)   ? random.between(0.31, 1)
                       : random.chance(0.5) ? 0.1
                                            : random.between(0.001, 0.29);
    x -= random.chance(0.3) ? 2 * width : random.between(0.9, 1) / static_cast<double>(count + 1);
    if (x - width <= 0.01) break;
    bar.push_back({x, height});
    if (random.chance(0.3)) {
      bar.push_back({x - 0.5 * width, end});
    } else {
      bar.push_back({x, end});
      bar.push_back({x - width, end});
    }
    x -= width;
    bar.push_back({x, height});
  }
  bar.push_back({0, height});
  return {ring_of(bar)};
}

/// Strips on top of each other, some with slanting sides.
Rings strips(Random& random, Gaps& gaps) {
  Rings rings{ring_of(centred_square(0.5))};
  double y = -0.4;
  for (std::int64_t k = random.integer(1, 7); k > 0 && y < 0.3; --k) {
    const double thick = random.chance(0.5) ? random.between(0.01, 0.1) : gaps.next();
    const double left = random.between(-0.4, 0), right = random.between(0.05, 0.4);
    const double lower = random.chance(0.3) ? gaps.next() : 0;
    const double upper = random.chance(0.3) ? gaps.next() : 0;
    rings.push_back(ring_of(
        {{left, y}, {right, y + lower}, {right, y + thick + lower}, {left, y + thick + upper}}));
    y += thick + lower + upper + gaps.next();
  }
  return rings;
}

/// Regular polygons around each other.
Rings rings_in_rings(Random& random, Gaps& gaps) {
  Rings rings;
  const auto corners = static_cast<std::size_t>(random.integer(3, 8));
  double radius = 0.5;
  for (std::int64_t k = random.integer(2, 8); k > 0; --k) {
    rings.push_back(regular_polygon(corners, radius)[0]);
    radius -= gaps.next() / std::cos(std::numbers::pi / static_cast<double>(corners));
  }
  return rings;
}

}  // namespace

Rings narrow_gaps(Random& random) {
  const double turn = random.chance(0.3) ? 0 : random.between(0, 2 * std::numbers::pi);
  const Vec2 shift =
      random.chance(0.7) ? Vec2{0, 0} : Vec2{random.between(-1, 1), random.between(-1, 1)};
  Gaps gaps(random);
  Rings rings;
  switch (random.integer(0, 6)) {
    case 0:
      rings = slots(random, gaps);
      break;
    case 1:
      rings = rows_and_columns(random, gaps);
      break;
    case 2:
      rings = fan(random, gaps);
      break;
    case 3:
      rings = slits(random, gaps);
      break;
    case 4:
      rings = strips(random, gaps);
      break;
    case 5:
      rings = rings_in_rings(random, gaps);
      break;
    default:
      rings = near_touching(random, gaps.one());
  }
  for (Ring& ring : rings)
    for (Vec2& p : ring.points) p = turned(p, turn) + shift;
  return rings;
}

}  // namespace medial::test
