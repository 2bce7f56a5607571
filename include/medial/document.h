#pragma once

#include <string_view>

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
  us_foot,  ///< of surveys in the USA, 1200 / 3937 m
  yard,
  css_pixel,  ///< of a drawing without a physical size: 96 to the inch
  pixel,      ///< of an image
  degree,
};
const char* name_of(Unit unit);  ///< "mm", "in", "px" ...; "pixel" of images; empty: unknown
std::optional<Unit> unit_of(std::string_view name);  ///< of length; nothing for other words
std::string unit_names();                            ///< "um, mm, ...": those that unit_of() takes
double millimetres(Unit unit);            ///< of pixels of drawings 25.4 / 96; 0: it has no length
Unit unit_of_length(double millimetres);  ///< unknown if none has this length

/// What holds for all items of a file.
struct DocumentInfo {
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

/// What a file holds: items of one kind (features, shapes, axes ...), and what holds for all.
template <class T>
struct Document : DocumentInfo {
  std::vector<T> items;
};

/// What a file says of a feature besides its geometry: names and values as text, in their order.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// One polygon or multipolygon of a file, one painted path, one glyph. Contours hold its curves.
struct Feature {
  std::vector<Ring> rings;
  std::vector<Contour> contours;
  std::vector<Chain> chains;          ///< loose points and lines, if asked for
  std::vector<VertexSource> sources;  ///< of the rings' points, in order; empty: themselves
  std::int64_t id = 0;                ///< of the source, or its index
  bool filled = false;                ///< a drawing: its fill rule decides, whatever crosses
  Attributes attributes;
};

struct UnitOptions {
  Unit given = Unit::unknown;    ///< what the input is in, whatever it says itself
  Unit assumed = Unit::unknown;  ///< the same for an input that does not say, with a note
  double pixel_size = 0;         ///< of an image, in units `given`; 0: as it says
  double scale = 1;              ///< enlarges by this factor, above 0
  Unit wanted = Unit::unknown;   ///< of the result; unknown: as the input
};

/// Converts all lengths of features. One that rests on 96 pixels or on an image's dots per inch
/// leaves a note, and a reference system in other units is dropped with one. Errors: invalid_option
/// (degrees, an input without a unit where one is wanted, a pixel size of what is no image).
Status convert_units(Document<Feature>& features, const UnitOptions& options);

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
  bool part = false;  ///< of the shape's axis, pruned, cut or smoothed: see VerifyOptions::part
};

}  // namespace medial
