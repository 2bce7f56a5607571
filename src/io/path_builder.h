#pragma once

#include <optional>

#include "medial/contour.h"
#include "medial/geometry.h"

namespace medial::io {

/// Document::corner_angle of outlines that people draw with curves: joints that they take for
/// smooth miss it by less, through coordinates rounded to a few decimals, or to a font's units.
constexpr double drawn_corner_angle = 1, font_corner_angle = 4;
/// Document::arc_tolerance of fonts, in their units, on whose grid the outlines lie: the steps in
/// which FreeType renders a glyph of a pixel a unit. Font tools that turn cubic into quadratic
/// curves move outlines by up to a thousandth of the em, thirty times as far or more.
constexpr double font_arc_tolerance = 1.0 / 64;

/// An affine map: p becomes x * p.x + y * p.y + origin.
struct Affine {
  Vec2 x{1, 0};
  Vec2 y{0, 1};
  Vec2 origin{0, 0};

  Vec2 vector(Vec2 v) const { return v.x * x + v.y * y; }
  Vec2 operator()(Vec2 p) const { return vector(p) + origin; }
  double determinant() const { return cross(x, y); }
  /// First `inner`, then this one.
  Affine operator*(const Affine& inner) const {
    return {vector(inner.x), vector(inner.y), (*this)(inner.origin)};
  }
};

/// An elliptical arc with conjugate half axes u and v: center + cos(t) u + sin(t) v for t from
/// `begin` to `end`, at most a whole turn.
struct EllipticalArc {
  Vec2 center;
  Vec2 u;
  Vec2 v;
  double begin = 0;
  double end = 0;
};

EllipticalArc transformed(const Affine& map, const EllipticalArc& arc);

/// Appends an elliptical arc that begins at the contour's last point: circular arcs as arcs of at
/// most half a turn, exact in their bulges; others as rational quadratics. `to` replaces the
/// computed end, so that contours close without a gap.
void add_arc(Contour& contour, const EllipticalArc& arc, std::optional<Vec2> to);

/// Appends an arc by its bulge, split into arcs of at most half a turn.
void add_arc(Contour& contour, Vec2 to, double bulge);

/// Starts a contour with a full circle or ellipse.
Contour closed_ellipse(Vec2 center, Vec2 u, Vec2 v);

/// A contour under a map. Arcs stay arcs under similarities; else they become rational quadratics.
Contour transformed(const Affine& map, const Contour& contour);

/// Whether a contour cannot enclose anything: straight, with fewer than three different points.
bool is_degenerate(const Contour& contour);

}  // namespace medial::io
