#include "io/path_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace medial::io {

namespace {

Vec2 point_at(const EllipticalArc& arc, double angle) {
  return arc.center + std::cos(angle) * arc.u + std::sin(angle) * arc.v;
}

/// Whether the half axes are a circle's up to the rounding of a few operations.
bool is_circular(const EllipticalArc& arc) {
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  const double u = squared_norm(arc.u);
  const double v = squared_norm(arc.v);
  return std::fabs(u - v) <= rounding * u && std::fabs(dot(arc.u, arc.v)) <= rounding * u;
}

}  // namespace

EllipticalArc transformed(const Affine& map, const EllipticalArc& arc) {
  return {map(arc.center), map.vector(arc.u), map.vector(arc.v), arc.begin, arc.end};
}

void add_arc(Contour& contour, Vec2 to, double bulge) {
  if (std::fabs(bulge) > 1) {
    const Vec2 from = contour.points.back();
    const Vec2 chord = to - from;
    const Vec2 middle = midpoint(from, to) - 0.5 * bulge * left_of(chord);
    const double half = bulge / (1 + std::hypot(1.0, bulge));
    contour.arc_to(middle, half);
    contour.arc_to(to, half);
  } else {
    contour.arc_to(to, bulge);
  }
}

void add_arc(Contour& contour, const EllipticalArc& arc, std::optional<Vec2> to) {
  const double turn = arc.end - arc.begin;
  if (!(turn != 0)) {
    if (to && !(*to == contour.points.back())) contour.line_to(*to);
    return;
  }
  if (!is_circular(arc)) {
    contour.ellipse_to(arc.center, arc.u, arc.v, arc.begin, arc.end);
    if (to) contour.points.back() = *to;
    return;
  }
  const double side = cross(arc.u, arc.v) > 0 ? 1 : -1;
  const Vec2 end = to ? *to : point_at(arc, arc.end);
  if (std::fabs(turn) > std::numbers::pi) {
    const double bulge = side * std::tan(turn / 8);
    contour.arc_to(point_at(arc, arc.begin + 0.5 * turn), bulge);
    contour.arc_to(end, bulge);
  } else {
    contour.arc_to(end, side * std::tan(turn / 4));
  }
}

Contour closed_ellipse(Vec2 center, Vec2 u, Vec2 v) {
  Contour contour;
  contour.start_at(center + u);
  if (is_circular({center, u, v})) {
    const double bulge = cross(u, v) > 0 ? 1 : -1;
    contour.arc_to(center - u, bulge);
    contour.arc_to(center + u, bulge);
  } else {
    contour.ellipse_to(center, u, v, 0, 2 * std::numbers::pi);
    contour.points.back() = contour.points.front();
  }
  return contour;
}

Contour transformed(const Affine& map, const Contour& contour) {
  Contour result = contour;
  for (Vec2& point : result.points) point = map(point);
  const bool has_arcs =
      std::ranges::any_of(contour.pieces, [](const CurvePiece& piece) { return piece.bulge != 0; });
  if (!has_arcs) return result;
  if (is_circular({{}, map.x, map.y})) {
    if (map.determinant() < 0) {
      for (CurvePiece& piece : result.pieces) piece.bulge = -piece.bulge;
    }
    return result;
  }
  Contour rebuilt;
  rebuilt.role = contour.role;
  rebuilt.start_at(result.points.front());
  for (const CurvePiece& piece : contour.pieces) {
    const Vec2 from = contour.points[piece.first];
    const Vec2 to = contour.points[piece.first + piece.degree];
    const auto images = std::span(result.points).subspan(piece.first + 1, piece.degree);
    if (piece.bulge != 0) {
      // The centre lies on the chord's bisector: to its left where the arc turns left by less than
      // half a turn.
      const double b = piece.bulge;
      const Vec2 chord = to - from;
      const Vec2 center = midpoint(from, to) + (1 - b * b) / (4 * b) * left_of(chord);
      const Vec2 u = from - center;
      add_arc(rebuilt, {map(center), map.vector(u), map.vector(left_of(u)), 0, 4 * std::atan(b)},
              images.front());
    } else {
      rebuilt.bezier_to(images, contour.weights_of(piece));
    }
  }
  return rebuilt;
}

bool is_degenerate(const Contour& contour) {
  const auto is_straight = [](const CurvePiece& piece) {
    return piece.degree == 1 && piece.bulge == 0;
  };
  if (!std::ranges::all_of(contour.pieces, is_straight)) return false;
  const auto& points = contour.points;
  if (points.empty()) return true;
  const auto other = std::ranges::find_if(points, [&](Vec2 p) { return !(p == points.front()); });
  return other == points.end() ||
         std::ranges::all_of(points, [&](Vec2 p) { return p == points.front() || p == *other; });
}

}  // namespace medial::io
