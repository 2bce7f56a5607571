#include "io/gis/project_curves.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "base/arc.h"

namespace medial::io {

namespace {

constexpr std::size_t degree = 5;
constexpr int most_halvings = 20;

/// The parameters at which curves are taken to their images (Chebyshev's, both ends among them),
/// and those at which the result is compared, between them.
struct ChebyshevPlaces {
  std::array<double, degree + 1> fitted{};
  std::array<double, degree> compared{};
  ChebyshevPlaces() {
    for (std::size_t i = 0; i <= degree; ++i)
      fitted[i] = 0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / degree);
    for (std::size_t i = 0; i < degree; ++i) compared[i] = 0.5 * (fitted[i] + fitted[i + 1]);
  }
};

using Basis = std::array<double, degree + 1>;

/// Bernstein's polynomials of a parameter.
Basis basis_at(double t) {
  Basis basis{1};
  for (std::size_t n = 1; n <= degree; ++n) {
    for (std::size_t i = n; i > 0; --i) basis[i] = (1 - t) * basis[i] + t * basis[i - 1];
    basis[0] *= 1 - t;
  }
  return basis;
}

using Matrix = std::array<Basis, degree + 1>;

/// From a polynomial's values at the fitted places to its control points: the inverse of the matrix
/// of Bernstein's polynomials there, by elimination. Its condition is below 100.
Matrix control_of_values(const ChebyshevPlaces& places) {
  Matrix matrix{}, inverse{};
  for (std::size_t i = 0; i <= degree; ++i) {
    matrix[i] = basis_at(places.fitted[i]);
    inverse[i][i] = 1;
  }
  for (std::size_t column = 0; column <= degree; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row <= degree; ++row)
      if (std::abs(matrix[row][column]) > std::abs(matrix[pivot][column])) pivot = row;
    std::swap(matrix[column], matrix[pivot]);
    std::swap(inverse[column], inverse[pivot]);
    const double scale = 1 / matrix[column][column];
    for (std::size_t row = 0; row <= degree; ++row) {
      if (row == column) continue;
      const double factor = scale * matrix[row][column];
      for (std::size_t k = 0; k <= degree; ++k) {
        matrix[row][k] -= factor * matrix[column][k];
        inverse[row][k] -= factor * inverse[column][k];
      }
    }
    for (std::size_t k = 0; k <= degree; ++k) {
      matrix[column][k] *= scale;
      inverse[column][k] *= scale;
    }
  }
  return inverse;
}

/// A point of a Bezier curve, rational where there are weights, by de Casteljau.
Vec2 point_at(std::span<const Vec2> control, std::span<const double> weights, double t) {
  std::vector<Vec2> points(control.begin(), control.end());
  std::vector<double> w(weights.begin(), weights.end());
  w.resize(points.size(), 1);
  for (std::size_t left = points.size() - 1; left > 0; --left)
    for (std::size_t i = 0; i < left; ++i) {
      const double a = (1 - t) * w[i], b = t * w[i + 1];
      w[i] = a + b;
      points[i] = (1 / w[i]) * (a * points[i] + b * points[i + 1]);
    }
  return points[0];
}

class Projector {
 public:
  Projector(const PointMap& map, double tolerance)
      : map_(map), tolerance_(tolerance), inverse_(control_of_values(places_)) {}

  /// Appends the image of a stretch of a curve to `image`, which ends where that begins.
  bool add(const std::function<Vec2(double)>& curve, double from, double to, int halvings,
           Contour& image) const {
    std::vector<Vec2> points;
    const auto take = [&](double t) { points.push_back(curve(from + t * (to - from))); };
    for (const double t : places_.fitted) take(t);
    for (const double t : places_.compared) take(t);
    if (!map_(points)) return false;
    const Vec2 origin = points[0];
    std::array<Vec2, degree + 1> control{};
    for (std::size_t i = 0; i <= degree; ++i) {
      for (std::size_t k = 0; k <= degree; ++k)
        control[i] = control[i] + inverse_[i][k] * (points[k] - origin);
      control[i] = origin + control[i];
    }
    control[0] = origin;
    control[degree] = points[degree];
    for (std::size_t i = 0; i < degree; ++i) {
      const Vec2 off = point_at(control, {}, places_.compared[i]) - points[degree + 1 + i];
      if (norm(off) <= tolerance_) continue;
      if (halvings == 0) return false;
      const double middle = 0.5 * (from + to);
      return add(curve, from, middle, halvings - 1, image) &&
             add(curve, middle, to, halvings - 1, image);
    }
    image.bezier_to(std::span(control).subspan(1));
    return true;
  }

 private:
  const PointMap& map_;
  double tolerance_;
  ChebyshevPlaces places_;
  Matrix inverse_;
};

}  // namespace

bool project_contour(const PointMap& map, double tolerance, Contour& contour) {
  const Projector projector(map, tolerance);
  Contour image;
  image.role = contour.role;
  image.open = contour.open;
  if (contour.points.empty()) return true;
  const auto image_of = [&](Vec2 point) -> std::optional<Vec2> {
    std::vector<Vec2> one{point};
    return map(one) ? std::optional(one[0]) : std::nullopt;
  };
  const auto start = image_of(contour.points[0]);
  if (!start) return false;
  image.start_at(*start);
  for (const CurvePiece& piece : contour.pieces) {
    const auto control = std::span(contour.points).subspan(piece.first, piece.degree + 1);
    if (piece.degree == 1 && piece.bulge == 0) {
      const auto end = image_of(control[1]);
      if (!end) return false;
      image.line_to(*end);
      continue;
    }
    if (piece.degree == 1) {
      // The chord to the point at a share t of the arc's angle, without a centre.
      const double half = 2 * std::atan(piece.bulge);
      const auto arc = [&](double t) {
        const double back = (t - 1) * half;
        return control[0] + (std::sin(t * half) / std::sin(half)) *
                                turned(control[1] - control[0], std::cos(back), std::sin(back));
      };
      if (!projector.add(arc, 0, 1, most_halvings, image)) return false;
    } else {
      const auto weights =
          contour.weights.empty()
              ? std::span<const double>()
              : std::span<const double>(contour.weights).subspan(piece.first, piece.degree + 1);
      const auto curve = [&](double t) { return point_at(control, weights, t); };
      if (!projector.add(curve, 0, 1, most_halvings, image)) return false;
    }
    // The end is the next piece's beginning, exactly.
    const auto end = image_of(control.back());
    if (!end) return false;
    image.points.back() = *end;
  }
  contour = std::move(image);
  return true;
}

}  // namespace medial::io
