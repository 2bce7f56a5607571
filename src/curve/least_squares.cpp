#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "curve/fit.h"
#include "medial/geometry.h"

namespace medial {
namespace {

constexpr std::size_t most_knots = std::size_t{1} << 17;

/// A closed polygon as a function of the length along it.
class Polygon {
 public:
  explicit Polygon(std::vector<Vec2> points) : points_(std::move(points)) {
    ways_.push_back(0);
    for (std::size_t i = 0; i < points_.size(); ++i)
      ways_.push_back(ways_.back() + distance(points_[i], points_[(i + 1) % points_.size()]));
  }
  double length() const { return ways_.back(); }
  /// Of the vertices, ascending; the length at last.
  const std::vector<double>& ways() const { return ways_; }
  /// The point at `way`, which lies on the edge `i` or a later one; i becomes that.
  Vec2 at(double way, std::size_t& i) const {
    while (i + 2 < ways_.size() && ways_[i + 1] < way) ++i;
    const double t = (way - ways_[i]) / (ways_[i + 1] - ways_[i]);
    const Vec2 a = points_[i], b = points_[(i + 1) % points_.size()];
    return a + std::clamp(t, 0.0, 1.0) * (b - a);
  }

 private:
  std::vector<Vec2> points_;
  std::vector<double> ways_;
};

/// A periodic cubic B-spline: a control point for each knot. Span i leads from knot i to the next
/// one, and depends on the control points i - 1 to i + 2.
class Spline {
 public:
  explicit Spline(std::vector<double> knots, double length)
      : knots_(std::move(knots)), control_(knots_.size()), length_(length) {}

  std::size_t size() const { return knots_.size(); }
  double begin(std::size_t i) const { return knots_[i]; }
  double span(std::size_t i) const {
    return i + 1 < size() ? knots_[i + 1] - knots_[i] : length_ - knots_[i] + knots_[0];
  }
  std::size_t index(std::size_t i, int offset) const {
    return (i + size() + static_cast<std::size_t>(offset + 8) - 8) % size();
  }

  using Row = std::array<double, 4>;
  /// The four Bezier points of a span, each as shares of the four control points (Boehm).
  std::array<Row, 4> shares(std::size_t i) const {
    std::array<double, 5> h{};
    for (int k = 0; k < 5; ++k) h[static_cast<std::size_t>(k)] = span(index(i, k - 2));
    const auto leg = [&](std::size_t k, double left) {
      // At `left` beyond the first of three spans from h[k] on.
      const double t = left / (h[k] + h[k + 1] + h[k + 2]);
      return std::array{1 - t, t};
    };
    const auto before = leg(0, h[0] + h[1]), first = leg(1, h[1]), second = leg(1, h[1] + h[2]),
               after = leg(2, h[2]);
    const double s = h[1] / (h[1] + h[2]), e = h[2] / (h[2] + h[3]);
    return {{{(1 - s) * before[0], (1 - s) * before[1] + s * first[0], s * first[1], 0},
             {0, first[0], first[1], 0},
             {0, second[0], second[1], 0},
             {0, (1 - e) * second[0], (1 - e) * second[1] + e * after[0], e * after[1]}}};
  }
  /// The shares of the four control points in the point at t of a span.
  static Row row(const std::array<Row, 4>& shares, double t) {
    const double u = 1 - t;
    const std::array<double, 4> weights{u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t};
    Row sum{};
    for (std::size_t b = 0; b < 4; ++b)
      for (std::size_t c = 0; c < 4; ++c) sum[c] += weights[b] * shares[b][c];
    return sum;
  }
  Vec2 point(std::size_t i, const Row& row) const {
    Vec2 sum;
    for (std::size_t c = 0; c < 4; ++c)
      sum = sum + row[c] * control_[index(i, static_cast<int>(c) - 1)];
    return sum;
  }
  std::vector<Vec2>& control() { return control_; }

  Contour contour() const {
    Contour result;
    for (std::size_t i = 0; i < size(); ++i) {
      const auto bezier = shares(i);
      if (i == 0) result.start_at(point(0, bezier[0]));
      const Vec2 end = i + 1 < size() ? point(i, bezier[3]) : result.points.front();
      result.bezier_to(std::array{point(i, bezier[1]), point(i, bezier[2]), end});
    }
    return result;
  }

 private:
  std::vector<double> knots_;
  std::vector<Vec2> control_;
  double length_;
};

/// Visits samples of an polygon, span by span: what spans of one length have in common is their
/// number, which grows with the vertices in a span.
template <class Visit>
void visit_samples(const Polygon& polygon, const Spline& spline, const Visit& visit) {
  std::size_t edge = 0;
  for (std::size_t i = 0; i < spline.size(); ++i) {
    const double begin = spline.begin(i), span = spline.span(i);
    const auto& ways = polygon.ways();
    const auto vertices = std::lower_bound(ways.begin(), ways.end(), begin + span) -
                          std::lower_bound(ways.begin(), ways.end(), begin);
    const auto count = 8 + 2 * static_cast<std::size_t>(vertices);
    const auto shares = spline.shares(i);
    for (std::size_t k = 0; k < count; ++k) {
      const double t = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
      const Vec2 p = polygon.at(begin + t * span, edge);
      visit(i, t, span / static_cast<double>(count), Spline::row(shares, t), p);
    }
  }
}

/// The normal equations of least squares: a cyclic band matrix, three entries to each side.
struct Equations {
  std::vector<std::array<double, 7>> band;
  std::vector<Vec2> right;

  std::vector<Vec2> times(const std::vector<Vec2>& x) const {
    const std::size_t n = x.size();
    std::vector<Vec2> y(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < 7; ++k) y[i] = y[i] + band[i][k] * x[(i + n + k - 3) % n];
    return y;
  }

  /// By conjugate gradients: B-splines of one degree make a matrix whose condition, scaled by its
  /// diagonal, does not grow with their number.
  void solve(std::vector<Vec2>& x) const {
    const std::size_t n = x.size();
    const auto dotted = [](const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
      double sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
      return sum;
    };
    const auto scaled = [&](std::vector<Vec2> v) {
      for (std::size_t i = 0; i < n; ++i) v[i] = (1 / band[i][3]) * v[i];
      return v;
    };
    std::vector<Vec2> residual = times(x);
    for (std::size_t i = 0; i < n; ++i) residual[i] = right[i] - residual[i];
    std::vector<Vec2> way = scaled(residual);
    double size = dotted(residual, way);
    const double enough = 1e-24 * dotted(right, scaled(right));
    constexpr int most_rounds = 300;
    for (int round = 0; round < most_rounds && size > enough; ++round) {
      const std::vector<Vec2> image = times(way);
      const double t = size / dotted(way, image);
      for (std::size_t i = 0; i < n; ++i) {
        x[i] = x[i] + t * way[i];
        residual[i] = residual[i] - t * image[i];
      }
      const std::vector<Vec2> next = scaled(residual);
      const double next_size = dotted(residual, next);
      for (std::size_t i = 0; i < n; ++i) way[i] = next[i] + (next_size / size) * way[i];
      size = next_size;
    }
  }
};

void fit(const Polygon& polygon, Spline& spline) {
  const std::size_t n = spline.size();
  Equations equations{std::vector<std::array<double, 7>>(n), std::vector<Vec2>(n)};
  visit_samples(polygon, spline,
                [&](std::size_t i, double, double weight, const Spline::Row& row, Vec2 p) {
                  for (std::size_t a = 0; a < 4; ++a) {
                    const std::size_t j = spline.index(i, static_cast<int>(a) - 1);
                    equations.right[j] = equations.right[j] + weight * row[a] * p;
                    for (std::size_t b = 0; b < 4; ++b)
                      equations.band[j][3 + b - a] += weight * row[a] * row[b];
                  }
                });
  std::size_t edge = 0;
  for (std::size_t i = 0; i < n; ++i) spline.control()[i] = polygon.at(spline.begin(i), edge);
  equations.solve(spline.control());
  // Along an axis the influence of far points decays to values that no coordinate may have.
  const double least = polygon.length() * 0x1p-60;
  for (Vec2& p : spline.control()) {
    if (std::abs(p.x) < least) p.x = 0;
    if (std::abs(p.y) < least) p.y = 0;
  }
}

/// The knots with one more in the middle of each span that strays from the polygon, at its ends
/// too: a knot that strays divides the spans on both its sides, else one of them would be divided
/// towards it without end. As many as before where none strays.
std::vector<double> refined(const Polygon& polygon, const Spline& spline, double tolerance) {
  std::vector<bool> strays(spline.size());
  visit_samples(polygon, spline,
                [&](std::size_t i, double, double, const Spline::Row& row, Vec2 p) {
                  if (!(distance(spline.point(i, row), p) <= tolerance)) strays[i] = true;
                });
  std::size_t edge = 0;
  for (std::size_t i = 0; i < spline.size(); ++i) {
    const Vec2 knot = spline.point(i, spline.shares(i)[0]);
    if (distance(knot, polygon.at(spline.begin(i), edge)) <= tolerance) continue;
    strays[i] = strays[spline.index(i, -1)] = true;
  }
  std::vector<double> knots;
  for (std::size_t i = 0; i < spline.size(); ++i) {
    knots.push_back(spline.begin(i));
    if (strays[i]) knots.push_back(spline.begin(i) + 0.5 * spline.span(i));
  }
  return knots;
}

/// The distinct vertices of a polygon that a smooth curve is to follow within `tolerance`.
Result<std::vector<Vec2>> points_to_fit(std::span<const Vec2> polygon, double tolerance) {
  if (!(tolerance > 0) || !std::isfinite(tolerance))
    return Error{ErrorCode::invalid_option, "the tolerance of the fit must be positive", {}};
  std::vector<Vec2> points;
  for (const Vec2 p : polygon) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
      return Error{ErrorCode::not_finite, "a coordinate is not finite", {}};
    if (points.empty() || !(points.back() == p)) points.push_back(p);
  }
  while (points.size() > 1 && points.back() == points.front()) points.pop_back();
  if (points.size() < 3)
    return Error{ErrorCode::too_few_points, "fewer than three distinct points", {}};
  return points;
}

}  // namespace

// Curve and polygon are compared at eight places between knots and two between vertices.
Result<Contour> fit_smooth_contour(std::span<const Vec2> polygon, double tolerance) {
  auto points = points_to_fit(polygon, tolerance);
  if (!points) return std::move(points).error();
  const Polygon closed(std::move(points).value());
  constexpr std::size_t fewest = 8;
  std::vector<double> knots;
  for (std::size_t i = 0; i < fewest; ++i)
    knots.push_back(static_cast<double>(i) * closed.length() / static_cast<double>(fewest));
  while (true) {
    Spline spline(std::move(knots), closed.length());
    fit(closed, spline);
    knots = refined(closed, spline, tolerance);
    if (knots.size() == spline.size()) return spline.contour();
    if (knots.size() > most_knots)
      return Error{ErrorCode::unsupported, "no smooth curve of 2^17 knots is that near", {}};
  }
}

Result<std::vector<Contour>> curve::fit_loops(std::span<const std::vector<Vec2>> polygons,
                                              double tolerance) {
  std::vector<double> radii;
  for (const auto& polygon : polygons) {
    Box box = Box::nothing();
    for (const Vec2 p : polygon) box.add(p);
    radii.push_back(distance(box.low, box.high) / 2);
  }
  const auto largest = std::max_element(radii.begin(), radii.end()) - radii.begin();
  std::vector<Contour> curves;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (radii[i] <= tolerance && i != static_cast<std::size_t>(largest)) continue;
    auto curve = fit_smooth_contour(polygons[i], tolerance);
    if (!curve) return std::move(curve).error();
    curves.push_back(std::move(curve).value());
  }
  return curves;
}

}  // namespace medial
