#pragma once

// Rings, shared by the writers of shapes and of offset curves.

#include <span>
#include <vector>

#include "io/output.h"
#include "medial/io/write.h"
#include "medial/shape.h"

namespace medial::io {

/// The rings of each part of a shape: the outer one first, then its holes.
std::vector<std::vector<Ring>> polygons_of(const Shape& shape);
bool has_arcs(const Shape& shape);

/// What offset curves are of: a shape or a planar graph.
Box box_of(const OffsetItem& item);

/// The allowed deviation of chords for an item, in units of the input.
double chord_of(const ShapeItem& item, const WriteOptions& options);
double chord_of(const OffsetItem& item, const WriteOptions& options);

/// Appends a piece of a ring or line: a line string, or a `circular` string of arcs, each with a
/// point between its ends. The first point is the last one of the piece before.
void add_piece(std::span<const Vec2> points, bool circular, Ring& ring);

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
