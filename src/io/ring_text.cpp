#include "io/ring_text.h"

#include <algorithm>
#include <cmath>

#include "base/arc.h"
#include "base/twofold.h"

namespace medial::io {

namespace {

Vec2 next_point(const Ring& ring, std::size_t i) {
  return ring.points[i + 1 == ring.points.size() ? 0 : i + 1];
}

/// The bulge of the arc from a through m to b: tangent of half the angle by which its chords turn
/// at m, which is half of the arc's angle; sine / (1 + cosine), or (1 - cosine) / sine where the
/// first would cancel. With twice the digits of double, as all of an arc that is nearly a full
/// circle is in the gap between a and b. Not a number where a coordinate is not one, or overflows.
double bulge_of(Vec2 a, Vec2 m, Vec2 b) {
  const Twofold ux = Twofold(m.x) - a.x, uy = Twofold(m.y) - a.y;
  const Twofold vx = Twofold(b.x) - m.x, vy = Twofold(b.y) - m.y;
  const Twofold sine = ux * vy - uy * vx, cosine = ux * vx + uy * vy;  // times both lengths
  if (sine.high == 0) return 0;
  const Twofold lengths = sqrt(ux * ux + uy * uy) * sqrt(vx * vx + vy * vy);
  return cosine.high < 0 ? ((lengths - cosine) / sine).high : (sine / (lengths + cosine)).high;
}

}  // namespace

std::vector<std::vector<Ring>> polygons_of(const Shape& shape) {
  std::vector<std::vector<Ring>> polygons(shape.component_count());
  for (const bool holes : {false, true})
    for (std::size_t i = 0; i < shape.loop_count(); ++i)
      if (shape.hole[i] == holes) polygons[shape.component[i]].push_back(ring_of(shape, i));
  return polygons;
}

bool has_arcs(const Shape& shape) {
  return std::ranges::any_of(shape.bulges, [](double bulge) { return bulge != 0; });
}

Box box_of(const OffsetItem& item) {
  if (!item.shape.points.empty() || item.planar_graph.points.empty())
    return bounding_box(item.shape);
  return bounding_box(item.planar_graph);
}

double chord_of(const ShapeItem& item, const WriteOptions& options) {
  return item.shape.points.empty() ? 1 : options.chord * diagonal(bounding_box(item.shape));
}

double chord_of(const OffsetItem& item, const WriteOptions& options) {
  const double size = diagonal(box_of(item));
  double reach = size;
  for (const OffsetRegion& region : item.offsets.regions)
    reach = std::max(reach, size - 2 * region.clearance);
  return options.chord * reach;
}

void add_piece(std::span<const Vec2> points, bool circular, Ring& ring) {
  if (points.empty()) return;
  if (ring.points.empty()) ring.points.push_back(points[0]);
  if (circular || !ring.bulges.empty()) ring.bulges.resize(ring.points.size(), 0);
  if (!circular) {
    ring.points.insert(ring.points.end(), points.begin() + 1, points.end());
    if (!ring.bulges.empty()) ring.bulges.resize(ring.points.size(), 0);
    return;
  }
  for (std::size_t i = 2; i < points.size(); i += 2) {
    const Vec2 a = ring.points.back(), m = points[i - 1], b = points[i];
    if (a == b) {  // a whole circle, by its diameter
      ring.bulges.back() = 1;
      ring.points.push_back(m);
      ring.bulges.push_back(1);
    } else {
      ring.bulges.back() = bulge_of(a, m, b);
    }
    ring.points.push_back(b);
    ring.bulges.push_back(0);
  }
}

double bulge_after(const Ring& ring, std::size_t i) {
  return ring.bulges.empty() ? 0 : ring.bulges[i];
}

void put_point(OutputStream& out, Vec2 p, char separator) {
  out.put(p.x);
  out.put(separator);
  out.put(p.y);
}

std::vector<Vec2> chords_of(const Ring& ring, double chord) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < ring.points.size(); ++i) {
    const Vec2 from = ring.points[i], to = next_point(ring, i);
    out.push_back(from);
    const double bulge = bulge_after(ring, i);
    if (bulge == 0) continue;
    // A piece of the angle a has the sagitta r (1 - cos(a / 2)).
    constexpr double most = 100000;
    const double angle = 4 * std::atan(bulge);
    const double radius = distance(from, to) / (2 * std::sin(std::abs(angle) / 2));
    const double widest = 2 * std::acos(std::max(1 - chord / radius, 0.0));
    const int pieces = static_cast<int>(std::clamp(std::ceil(std::abs(angle) / widest), 1.0, most));
    const Vec2 tangent = start_tangent({from, to, bulge});
    for (int k = 1; k < pieces; ++k) {
      const double half = angle * k / (2 * pieces);
      out.push_back(from + (2 * radius * std::sin(std::abs(half))) *
                               turned(tangent, std::cos(half), std::sin(half)));
    }
  }
  out.push_back(ring.points[0]);
  return out;
}

void put_wkt_points(OutputStream& out, const std::vector<Vec2>& points) {
  const char* separator = "(";
  for (const Vec2 p : points) {
    out.put(separator);
    put_point(out, p, ' ');
    separator = ", ";
  }
  out.put(')');
}

void put_geojson_points(OutputStream& out, const std::vector<Vec2>& points) {
  const char* separator = "[[";
  for (const Vec2 p : points) {
    out.put(separator);
    put_point(out, p, ',');
    out.put(']');
    separator = ",[";
  }
  out.put(']');
}

namespace {

/// Whether the apex of an edge, as its coordinates round, shows that it is an arc: a segment is as
/// near to one that is flatter, and has no curvature that comes from rounding.
bool is_curved(const Ring& ring, std::size_t i) {
  const BulgeArc arc{ring.points[i], next_point(ring, i), bulge_after(ring, i)};
  if (arc.bulge == 0) return false;
  const Vec2 p = apex(arc);
  const double spacing = 0x1p-52 * std::max(std::abs(p.x), std::abs(p.y));
  return distance(p, midpoint(arc.start, arc.end)) > spacing;
}

}  // namespace

void put_wkt_curve(OutputStream& out, const Ring& ring) {
  const std::size_t count = ring.points.size();
  bool straight = true;
  for (std::size_t i = 0; i < count && straight; ++i) straight = !is_curved(ring, i);
  if (!straight) out.put("COMPOUNDCURVE (");
  for (std::size_t i = 0; i < count;) {
    const bool arcs = is_curved(ring, i);
    if (i > 0) out.put(", ");
    out.put(arcs ? "CIRCULARSTRING (" : "(");
    put_point(out, ring.points[i], ' ');
    for (; i < count && is_curved(ring, i) == arcs; ++i) {
      if (arcs) {
        out.put(", ");
        put_point(out, apex({ring.points[i], next_point(ring, i), ring.bulges[i]}), ' ');
      }
      out.put(", ");
      put_point(out, next_point(ring, i), ' ');
    }
    out.put(')');
  }
  if (!straight) out.put(')');
}

}  // namespace medial::io
