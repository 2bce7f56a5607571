#pragma once

#include <string>
#include <utility>

#include "medial/axis.h"
#include "medial/contour.h"
#include "medial/planar_graph.h"

namespace medial {

enum class Unit : std::uint8_t {
  unknown,
  micrometre,
  millimetre,
  centimetre,
  metre,
  kilometre,
  mil,
  inch,
  foot,
  yard,
  css_pixel,  ///< of a drawing without a physical size: 96 to the inch
  pixel,      ///< of an image
  degree,
};

/// What a file holds: items of one kind (features, shapes, axes ...), and what holds for all.
template <class T>
struct Document {
  std::vector<T> items;
  std::string crs_wkt;             ///< coordinate reference system as WKT, empty if none
  bool geographic = false;         ///< coordinates are longitude and latitude
  bool y_down = false;             ///< the y axis points down, as in SVG; for pictures
  Unit unit = Unit::unknown;       ///< of lengths
  double pixel = 0;                ///< of an image: the side of its pixels, where they are squares
  double dots_per_inch = 0;        ///< of an image that says so
  std::vector<std::string> notes;  ///< what repair or reprojection changed, one sentence each
  std::vector<std::uint64_t> indices;  ///< of the items in the file, if some were left out
  double corner_angle = 0;  ///< Options::corner_angle that suits this kind of input; 0: its default

  std::uint64_t index_of(std::size_t i) const { return indices.empty() ? i : indices[i]; }
};

/// A document without items that has all else of another.
template <class To, class From>
Document<To> empty_like(const Document<From>& from) {
  return {{},         from.crs_wkt,       from.geographic, from.y_down,  from.unit,
          from.pixel, from.dots_per_inch, from.notes,      from.indices, from.corner_angle};
}

/// What a file says of a feature besides its geometry: names and values as text, in their order.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// One polygon or multipolygon of an input file, one painted path, one glyph. Free-form curves are
/// contours.
struct Feature {
  std::vector<Ring> rings;
  std::vector<Contour> contours;
  std::vector<Chain> chains;          ///< loose points and lines, if asked for
  std::vector<VertexSource> sources;  ///< of the rings' points, in order; empty: themselves
  std::int64_t id = 0;                ///< of the source, or its index
  bool filled = false;                ///< a drawing: its fill rule decides, whatever crosses
  Attributes attributes;
};

struct ShapeItem {
  Shape shape;
  Attributes attributes;
  std::vector<Contour> contours = {};  ///< its boundary before curves became arcs, if asked for
};

struct AxisItem {
  Shape shape;
  MedialAxis axis;
  Attributes attributes;
  std::vector<Contour> contours = {};  ///< in place of a shape that is not built yet
  /// A part of the shape's axis, pruned, cut or smoothed: ends need not be corners, nor disks
  /// cover.
  bool part = false;
};

}  // namespace medial
