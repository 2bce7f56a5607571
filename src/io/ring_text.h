#pragma once

// Rings as text, shared by the writers of shapes and of offset curves.

#include <vector>

#include "io/output.h"
#include "medial/shape.h"

namespace medial::io {

/// The bulge of the edge that begins at point i; 0: it is straight.
double bulge_after(const Ring& ring, std::size_t i);

/// "x y" or "x,y".
void put_point(OutputStream& out, Vec2 p, char separator);

/// The ring's points, and points on its arcs so that chords stay within `chord` (at most 1e5 an
/// arc); the first one again at the end.
std::vector<Vec2> chords_of(const Ring& ring, double chord);

/// Points as well-known text, "(x y, x y)", and as GeoJSON, "[[x,y],[x,y]]".
void put_wkt_points(OutputStream& out, const std::vector<Vec2>& points);
void put_geojson_points(OutputStream& out, const std::vector<Vec2>& points);

/// A ring as well-known text without loss: its points where it is straight, and otherwise a
/// compound curve of runs of straight edges and runs of arcs, with a point in the middle of each.
void put_wkt_curve(OutputStream& out, const Ring& ring);

}  // namespace medial::io
