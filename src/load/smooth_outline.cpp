#include <algorithm>
#include <array>
#include <cmath>

#include "base/in_flight.h"
#include "medial/raster.h"

// A smooth curve between the pixels. A crack is the common side of a foreground and a background
// pixel. The curve crosses the line between the two pixels' centres once, at a point q that may
// move along this line. The four centres around a pixel's corner form a cell, which the curve
// traverses from one such point to another. Polygons through such points never cross themselves or
// each other: they are the contours of marching squares. The curve is the quadratic B-spline with
// these control points: each piece is a parabola from the middle of one side of the polygon to the
// middle of the next, tangent to both.
//
// The curve is simple, too. A piece lies in the triangle of the two middles and q, and so in the
// two cells on both sides of q. If only one strand traverses a cell, nothing else is there. If two
// do, at a corner where pixels touch, each stays on its own side of the diagonal between them if
// its points move by at most a fifth of a pixel: the coordinates of a strand that cuts off the
// upper left of the cell [0, 1] x [0, 1] then have a sum of at most 0.85.

namespace medial {
namespace {

constexpr double most_free = 0.45;  // largest move of a point; at 1/2, it would be a pixel's centre
constexpr double most_tight = 0.2;  // the same next to a corner with two strands
constexpr double most_distance = 0.5;  // of the curve from the cracks
constexpr double most_share = 0.01;    // relative difference of the curve's area from the pixels'
constexpr int sweeps = 60;

/// A crack of a ring, from corner to corner of a pixel.
struct Crack {
  Vec2 middle;
  Vec2 along;         ///< the unit step
  Vec2 across;        ///< the unit normal
  double offset = 0;  ///< of the point from the middle, along the normal
  double most = most_free;

  Vec2 point() const { return middle + offset * across; }
  Vec2 end() const { return middle + 0.5 * along; }
};

/// Whether exactly two pixels that touch in this corner are foreground.
bool is_touching(const Image& image, Vec2 corner) {
  const auto x = static_cast<std::int64_t>(corner.x), y = static_cast<std::int64_t>(corner.y);
  const bool a = image.at(x - 1, y - 1), b = image.at(x, y - 1);
  return image.at(x, y) == a && image.at(x - 1, y) == b && a != b;
}

std::vector<Crack> cracks_of(const Image& image, const Ring& ring) {
  std::vector<Crack> cracks;
  for (std::size_t i = 0; i < ring.points.size(); ++i) {
    const Vec2 start = ring.points[i], way = ring.points[(i + 1) % ring.points.size()] - start;
    const double length = std::max(std::abs(way.x), std::abs(way.y));
    const Vec2 along = (1 / length) * way;
    for (double at = 0; at < length; ++at) {
      Crack crack{start + (at + 0.5) * along, along, left_of(along)};
      if (is_touching(image, start + at * along) || is_touching(image, start + (at + 1) * along))
        crack.most = most_tight;
      cracks.push_back(crack);
    }
  }
  return cracks;
}

/// Twice the signed area within the curve: the sum over its parabolas, from a to c with the control
/// point b, of (2 a x b + a x c + 2 b x c) / 3.
double twice_area(const std::vector<Vec2>& points) {
  const std::size_t n = points.size();
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 b = points[i] - points[0];
    const Vec2 a = midpoint(points[i == 0 ? n - 1 : i - 1] - points[0], b);
    const Vec2 c = midpoint(b, points[i + 1 == n ? 0 : i + 1] - points[0]);
    sum += 2 * cross(a, b) + cross(a, c) + 2 * cross(b, c);
  }
  return sum / 3;
}

/// Moves the points to minimise the bending of the polygon: the sum of the squared differences
/// between the unit directions of successive sides, by Gauss-Seidel sweeps (with the current
/// lengths, but at least a quarter of a pixel). After k sweeps, waves of about k^(1/4) 2 pi pixels
/// are smoothed; stairs are shorter. Before each sweep, moves all points equally if the enclosed
/// area differs from that of the pixels by more than `most_share`; otherwise, small shapes would
/// swell or shrink.
void relax(std::vector<Crack>& cracks) {
  constexpr double shortest = 0.25;
  const std::size_t n = cracks.size();
  std::vector<Vec2> points(n);
  const auto move = [&](std::size_t i, double by) {
    cracks[i].offset = std::clamp(cracks[i].offset + by, -cracks[i].most, cracks[i].most);
    points[i] = cracks[i].point();
  };
  double twice_pixels = 0;
  for (std::size_t i = 0; i < n; ++i) {
    move(i, 0);
    twice_pixels += cross(cracks[i].middle - cracks[0].middle, cracks[i].along);
  }
  const double most_error = most_share * std::abs(twice_pixels);
  const auto at = [n](std::size_t i) { return i < n ? i : i - n; };
  const auto inverse_length = [&](std::size_t i) {
    return 1 / std::max(shortest, norm(points[at(i + 1)] - points[i]));
  };
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const double error = twice_area(points) - twice_pixels;
    const double beyond = error - std::clamp(error, -most_error, most_error);
    const double outwards = 0.5 * beyond / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) move(i, outwards);
    for (std::size_t i = 0; i < n; ++i) {
      const std::array around = {at(i + n - 2), at(i + n - 1), i, at(i + 1), at(i + 2)};
      std::array<double, 4> inverse;
      std::array<Vec2, 4> side;
      for (std::size_t k = 0; k < 4; ++k) {
        inverse[k] = inverse_length(around[k]);
        side[k] = inverse[k] * (points[around[k + 1]] - points[around[k]]);
      }
      // The three bends that depend on the point, and their derivatives by its position.
      const std::array change = {inverse[1], -inverse[1] - inverse[2], inverse[2]};
      double slope = 0, squares = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        slope += change[k] * dot(side[k + 1] - side[k], cracks[i].across);
        squares += change[k] * change[k];
      }
      move(i, -slope / squares);
    }
  }
}

/// An upper bound for the distance of a point from a parabola.
double distance_to(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
  constexpr int steps = 32;
  double nearest = norm(p - a);
  for (int i = 1; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps, s = 1 - t;
    nearest = std::min(nearest, norm(p - (s * s * a + 2 * s * t * b + t * t * c)));
  }
  return nearest;
}

/// Moves points back towards their cracks where the curve cuts off too much of a pixel's corner.
void keep_corners(std::vector<Crack>& cracks) {
  const std::size_t n = cracks.size();
  const auto middle = [&cracks, n](std::size_t i) {
    return midpoint(cracks[i % n].point(), cracks[(i + 1) % n].point());
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < n; ++i) {
      Crack& before = cracks[i];
      Crack& after = cracks[(i + 1) % n];
      if (before.along == after.along) continue;
      const Vec2 corner = before.end();
      if (norm(corner - middle(i)) <= most_distance ||
          distance_to(corner, middle(i + n - 1), before.point(), middle(i)) <= most_distance ||
          distance_to(corner, middle(i), after.point(), middle(i + 1)) <= most_distance)
        continue;
      before.offset *= 0.75;
      after.offset *= 0.75;
      changed = true;
    }
  }
}

/// Rounds offsets to multiples of 2^-40 pixels, because offsets that tend to 0 would become too
/// small for coordinates.
void cut_digits(std::vector<Crack>& cracks) {
  for (Crack& crack : cracks) crack.offset = std::trunc(0x1p40 * crack.offset) * 0x1p-40;
}

Contour contour_of(const std::vector<Crack>& cracks) {
  const std::size_t n = cracks.size();
  Contour contour;
  contour.points.reserve(2 * n + 1);
  contour.pieces.reserve(n);
  Vec2 before = midpoint(cracks[n - 1].point(), cracks[0].point());
  contour.points.push_back(before);
  const Vec2 first = before;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 after = i + 1 == n ? first : midpoint(cracks[i].point(), cracks[i + 1].point());
    contour.pieces.push_back({static_cast<std::uint32_t>(contour.points.size() - 1), 2, 0});
    contour.points.push_back(cracks[i].point());
    contour.points.push_back(after);
  }
  return contour;
}

}  // namespace

Result<std::vector<Contour>> smooth_outline(const Image& image) {
  auto rings = pixel_outline(image, 0);
  if (!rings) return std::move(rings).error();
  try {
    std::vector<Contour> contours;
    contours.reserve(rings->size());
    for (const Ring& ring : *rings) {
      std::vector<Crack> cracks = cracks_of(image, ring);
      relax(cracks);
      keep_corners(cracks);
      cut_digits(cracks);
      contours.push_back(contour_of(cracks));
    }
    return contours;
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
