#include "papers/shaked_bruckstein_1996/spline.h"

#include <algorithm>
#include <array>

namespace medial::papers {
namespace {

/// Solves lower[i] x[i-1] + diagonal[i] x[i] + upper[i] x[i+1] = right[i] around a cycle:
/// elimination for the matrix without its two corners, which are a matrix of rank one (Sherman and
/// Morrison). The spline's matrix is dominated by its diagonal: no pivots.
std::vector<Vec2> solve_cyclic(const std::vector<double>& lower, std::vector<double> diagonal,
                               const std::vector<double>& upper, std::vector<Vec2> right) {
  const std::size_t n = diagonal.size();
  const double gamma = -diagonal[0];
  std::vector<double> corner(n, 0.0);
  corner[0] = gamma;
  corner[n - 1] = upper[n - 1];
  diagonal[0] -= gamma;
  diagonal[n - 1] -= lower[0] * upper[n - 1] / gamma;
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = lower[i] / diagonal[i - 1];
    diagonal[i] -= factor * upper[i - 1];
    right[i] = right[i] - factor * right[i - 1];
    corner[i] -= factor * corner[i - 1];
  }
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) {
      right[i] = right[i] - upper[i] * right[i + 1];
      corner[i] -= upper[i] * corner[i + 1];
    }
    right[i] = (1 / diagonal[i]) * right[i];
    corner[i] /= diagonal[i];
  }
  const double ratio = lower[0] / gamma;
  const Vec2 top = right[0] + ratio * right[n - 1];
  const double bottom = 1 + corner[0] + ratio * corner[n - 1];
  for (std::size_t i = 0; i < n; ++i) right[i] = right[i] - (corner[i] / bottom) * top;
  return right;
}

/// The periodic cubic spline through the points, its parameter the length of the chords: a cubic
/// for each edge.
Contour interpolated(const std::vector<Vec2>& p) {
  const std::size_t n = p.size();
  std::vector<double> h(n), lower(n), diagonal(n), upper(n);
  std::vector<Vec2> right(n);
  for (std::size_t i = 0; i < n; ++i) h[i] = distance(p[i], p[(i + 1) % n]);
  for (std::size_t i = 0; i < n; ++i) {
    const double before = h[(i + n - 1) % n], after = h[i];
    lower[i] = 1 / before;
    upper[i] = 1 / after;
    diagonal[i] = 2 * (lower[i] + upper[i]);
    right[i] = (3 / (before * before)) * (p[i] - p[(i + n - 1) % n]) +
               (3 / (after * after)) * (p[(i + 1) % n] - p[i]);
  }
  const std::vector<Vec2> slope = solve_cyclic(lower, diagonal, upper, right);
  Contour contour;
  contour.start_at(p[0]);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    contour.bezier_to(
        std::array{p[i] + (h[i] / 3) * slope[i], p[next] - (h[i] / 3) * slope[next], p[next]});
  }
  return contour;
}

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const double t = std::clamp(dot(p - a, b - a) / squared_norm(b - a), 0.0, 1.0);
  return distance(p, a + t * (b - a));
}

/// How far a cubic strays from its chord: its control points do at least as far.
double deviation(const Contour& contour, std::size_t i) {
  const Vec2* c = contour.points.data() + contour.pieces[i].first;
  return std::max(distance_to_segment(c[1], c[0], c[3]), distance_to_segment(c[2], c[0], c[3]));
}

}  // namespace

Contour spline_through(std::vector<Vec2> points, double tolerance) {
  while (true) {
    Contour contour = interpolated(points);
    std::vector<Vec2> finer;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 next = points[(i + 1) % points.size()];
      finer.push_back(points[i]);
      // Points where the curve is to turn sooner: the middle of an edge that it leaves.
      if (!(deviation(contour, i) <= tolerance)) {
        const Vec2 middle = midpoint(points[i], next);
        if (!(middle == points[i]) && !(middle == next)) finer.push_back(middle);
      }
    }
    if (finer.size() == points.size()) return contour;
    points = std::move(finer);
  }
}

}  // namespace medial::papers
