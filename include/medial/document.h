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
  css_pixel,  ///< 1/96 inch: for drawings without a physical size
  pixel,      ///< of an image
  degree,
};
const char* name_of(Unit unit);  ///< "mm", "in", "px" ...; "pixel" for images; empty: unknown
std::optional<Unit> unit_of(std::string_view name);  ///< nothing if it is no unit
std::string unit_names();                            ///< "um, mm, ...": names that unit_of() takes
double millimetres(Unit unit);            ///< 25.4 / 96 for css_pixel; 0 if it has no length
Unit unit_of_length(double millimetres);  ///< unknown if none has this length

/// Properties of a file, for all of its items.
struct DocumentInfo {
  std::string crs_wkt;                 ///< coordinate reference system as WKT, empty if none
  bool geographic = false;             ///< coordinates are longitude and latitude
  bool y_down = false;                 ///< the y axis points down, as in SVG; used for pictures
  Unit unit = Unit::unknown;           ///< of lengths
  double pixel = 0;                    ///< of an image with square pixels: their side
  double dots_per_inch = 0;            ///< of an image, if the file states it
  std::vector<std::string> notes;      ///< changes by repair or reprojection, one sentence each
  std::vector<std::uint64_t> indices;  ///< of items in the file; empty if none was left out
  std::vector<std::string> text_attributes;    ///< names of those that are text, not numbers
  double corner_angle = 0, arc_tolerance = 0;  ///< suitable for Options, ArcOptions; 0: defaults
  std::uint64_t index_of(std::size_t i) const { return indices.empty() ? i : indices[i]; }
};

/// The content of a file: items of one kind (features, shapes, axes ...) and common properties.
template <class T>
struct Document : DocumentInfo {
  std::vector<T> items;
  /// Leaves out all items but these, which are in order and keep their numbers in the file.
  void keep(const std::vector<std::size_t>& kept) {
    if (kept.size() == items.size()) return;
    std::vector<T> all = std::exchange(items, {});
    std::vector<std::uint64_t> numbers;
    for (const std::size_t i : kept) numbers.push_back(index_of(i));
    indices = std::move(numbers);
    for (const std::size_t i : kept) items.push_back(std::move(all[i]));
  }
};

/// A feature's properties besides its geometry: names and values as text, in order.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// One polygon or multipolygon, painted path or glyph of a file. Contours hold its curves.
struct Feature {
  std::vector<Ring> rings;
  std::vector<Contour> contours;
  std::vector<Chain> chains;          ///< loose points and lines, if requested
  std::vector<VertexSource> sources;  ///< of the rings' points; empty: their own indices
  std::int64_t id = 0;                ///< in the source, or the index
  bool filled = false;                ///< a drawing: its fill rule decides, even at crossings
  Attributes attributes;
};

struct UnitOptions {
  Unit given = Unit::unknown;    ///< of the input; overrides what the file states
  Unit assumed = Unit::unknown;  ///< of an input that states none; adds a note
  double pixel_size = 0;         ///< of an image, in the unit `given`; 0: as it states
  double scale = 1;              ///< factor for all lengths, above 0
  Unit wanted = Unit::unknown;   ///< of the result; unknown: that of the input
};

/// Converts all lengths of features. Adds a note if the factor rests on 96 pixels or on an image's
/// dots per inch, and if it drops a reference system in other units. Errors: invalid_option
/// (degrees; a unit is wanted, but the input has none; a pixel size for other files than images).
Status convert_units(Document<Feature>& features, const UnitOptions& options);

struct ShapeItem {
  Shape shape;
  Attributes attributes;
  std::vector<Contour> contours = {};  ///< boundary before curves became arcs, if requested
};

struct AxisItem {
  Shape shape;
  MedialAxis axis;
  Attributes attributes;
  std::vector<Contour> contours = {};  ///< instead of a shape that is not built yet
  bool part = false;                   ///< only a part of the shape's axis: see VerifyOptions::part
};

}  // namespace medial
