#include "medial/contour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace medial {
namespace {

/// A control point times its weight, and the weight: what B-spline formulas are linear in.
struct Homogeneous {
  double x = 0;
  double y = 0;
  double w = 0;
};

Homogeneous mix(Homogeneous a, Homogeneous b, double t) {
  const double s = 1 - t;
  return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.w + t * b.w};
}

/// The blossom of a spline's span [knots[span], knots[span + 1]]: `low` of its arguments are the
/// span's begin, the others its end. With `degree - i` at the begin that is Bezier control point i
/// of the span, the same as inserting both knots until they have full multiplicity. O(degree^2).
Homogeneous blossom(std::uint32_t degree, std::span<const double> knots, std::size_t span,
                    std::uint32_t low, std::vector<Homogeneous>& points) {
  for (std::uint32_t level = 1; level <= degree; ++level) {
    const double u = level <= low ? knots[span] : knots[span + 1];
    for (std::size_t j = span; j >= span - degree + level; --j) {
      const double begin = knots[j], end = knots[j + degree - level + 1];
      Homogeneous& point = points[j - (span - degree)];
      point = mix(points[j - (span - degree) - 1], point, (u - begin) / (end - begin));
      if (j == 0) break;
    }
  }
  return points[degree];
}

Error invalid_spline(const char* text) { return {ErrorCode::malformed, text, {}}; }

/// Sine and cosine that are exact at the multiples of a quarter turn.
Vec2 direction(double angle) {
  const double quarters = angle / (std::numbers::pi / 2);
  const double nearest = std::round(quarters);
  if (std::abs(quarters - nearest) <= 1e-15 * std::max(1.0, std::abs(quarters))) {
    constexpr Vec2 axes[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return axes[static_cast<int>(std::fmod(std::fmod(nearest, 4) + 4, 4))];
  }
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

void Contour::start_at(Vec2 point) {
  points.assign(1, point);
  weights.clear();
  pieces.clear();
}

void Contour::line_to(Vec2 end) { arc_to(end, 0); }

void Contour::arc_to(Vec2 end, double bulge) {
  if (points.empty()) return start_at(end);
  pieces.push_back({static_cast<std::uint32_t>(points.size() - 1), 1, bulge});
  points.push_back(end);
  if (!weights.empty()) weights.push_back(weights.back());
}

void Contour::bezier_to(std::span<const Vec2> control, std::span<const double> control_weights) {
  if (control.empty()) return;
  if (points.empty()) return start_at(control.back());
  pieces.push_back({static_cast<std::uint32_t>(points.size() - 1),
                    static_cast<std::uint32_t>(control.size()), 0});
  if (!control_weights.empty() && weights.empty()) weights.assign(points.size(), 1);
  const double scale = weights.empty() ? 1 : weights.back();
  for (std::size_t i = 0; i < control.size(); ++i) {
    points.push_back(control[i]);
    if (weights.empty()) continue;
    weights.push_back(scale * (i < control_weights.size() ? control_weights[i] : 1));
  }
}

std::vector<double> Contour::weights_of(const CurvePiece& piece) const {
  if (weights.empty()) return {};
  const auto first = weights.begin() + piece.first;
  std::vector<double> relative(first + 1, first + 1 + piece.degree);
  for (double& weight : relative) weight /= *first;
  return relative;
}

void Contour::ellipse_to(Vec2 center, Vec2 u, Vec2 v, double begin, double end) {
  constexpr double quarter = std::numbers::pi / 2;
  const auto point_at = [&](Vec2 d) { return center + d.x * u + d.y * v; };
  const Vec2 first = point_at(direction(begin));
  if (points.empty()) start_at(first);
  const double sweep = end - begin;
  if (!std::isfinite(sweep)) {
    points.push_back({sweep, sweep});  // not finite: approximate_by_arcs() says so
    pieces.push_back({static_cast<std::uint32_t>(points.size() - 2), 1, 0});
    if (!weights.empty()) weights.push_back(weights.back());
    return;
  }
  // A sweep that is some quarters up to rounding takes no piece more for it.
  constexpr double rounding = 1e-12;
  const bool whole = std::abs(sweep) >= 4 * quarter * (1 - rounding);
  const int count =
      whole ? 4 : std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / quarter - rounding)));
  const double half = (whole ? std::copysign(4 * quarter, sweep) : sweep) / (2 * count);
  for (int i = 0; i < count; ++i) {
    const bool last = i + 1 == count;
    const Vec2 middle = (1 / std::cos(half)) * direction(begin + (2 * i + 1) * half);
    const Vec2 stop =
        last && whole ? first : point_at(direction(last ? end : begin + 2 * (i + 1) * half));
    bezier_to(std::vector<Vec2>{point_at(middle), stop}, std::vector<double>{std::cos(half), 1});
  }
}

Status Contour::spline_to(std::uint32_t degree, std::span<const double> knots,
                          std::span<const Vec2> control, std::span<const double> control_weights) {
  if (degree == 0 || control.size() <= degree || knots.size() != control.size() + degree + 1) {
    return invalid_spline("a spline needs degree + 1 more knots than control points");
  }
  if (!control_weights.empty() && control_weights.size() != control.size()) {
    return invalid_spline("a spline needs a weight for each control point, or none");
  }
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i]) || (i > 0 && knots[i] < knots[i - 1])) {
      return invalid_spline("the knots of a spline must not decrease");
    }
    // A knot inside of multiplicity degree + 1 tears the curve.
    if (i >= degree && knots[i] == knots[i - degree] && knots[i] > knots[degree] &&
        knots[i] < knots[control.size()]) {
      return invalid_spline("an inner knot of a spline is repeated too often");
    }
  }
  if (knots[degree] == knots[control.size()]) {
    return invalid_spline("the knots of a spline span no interval");
  }
  for (double weight : control_weights) {
    if (!(weight > 0) || !std::isfinite(weight)) {
      return Error{ErrorCode::unsupported, "a weight of a spline is not positive", {}};
    }
  }

  std::vector<Homogeneous> work(degree + 1);
  std::vector<Vec2> piece;
  std::vector<double> piece_weights;
  for (std::size_t span = degree; span < control.size(); ++span) {
    if (knots[span] == knots[span + 1]) continue;
    piece.clear();
    piece_weights.clear();
    double first_weight = 1;
    for (std::uint32_t i = 0; i <= degree; ++i) {
      for (std::uint32_t j = 0; j <= degree; ++j) {
        const std::size_t from = span - degree + j;
        const double w = control_weights.empty() ? 1 : control_weights[from];
        work[j] = {w * control[from].x, w * control[from].y, w};
      }
      const Homogeneous h = blossom(degree, knots, span, degree - i, work);
      const Vec2 point = control_weights.empty() ? Vec2{h.x, h.y} : Vec2{h.x / h.w, h.y / h.w};
      if (i == 0) {
        first_weight = h.w;
        if (points.empty()) start_at(point);
      } else {
        piece.push_back(point);
        piece_weights.push_back(h.w / first_weight);
      }
    }
    if (control_weights.empty()) piece_weights.clear();
    bezier_to(piece, piece_weights);
  }
  return success();
}

Contour contour_of(std::span<const Vec2> points, std::span<const double> bulges, bool closed) {
  Contour contour;
  if (points.empty()) return contour;
  contour.start_at(points.front());
  for (std::size_t i = 0; i < points.size() - (closed ? 0 : 1); ++i) {
    const Vec2 end = points[i + 1 == points.size() ? 0 : i + 1];
    if (!(end == points[i])) contour.arc_to(end, bulges.empty() ? 0 : bulges[i]);
  }
  contour.open = !closed;
  return contour;
}

Contour reversed(const Contour& contour) {
  Contour result;
  result.role = contour.role;
  result.open = contour.open;
  result.points.assign(contour.points.rbegin(), contour.points.rend());
  result.weights.assign(contour.weights.rbegin(), contour.weights.rend());
  const auto last = static_cast<std::uint32_t>(contour.points.size()) - 1;
  for (auto piece = contour.pieces.rbegin(); piece != contour.pieces.rend(); ++piece)
    result.pieces.push_back({last - piece->first - piece->degree, piece->degree, -piece->bulge});
  return result;
}

}  // namespace medial
