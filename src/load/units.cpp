#include <array>
#include <cmath>

#include "medial/document.h"

namespace medial {
namespace {

struct NamedUnit {
  Unit unit;
  const char* name;
  double millimetres;
};
constexpr double inch = 25.4;
constexpr std::array<NamedUnit, 11> lengths{{{Unit::micrometre, "um", 1e-3},
                                             {Unit::millimetre, "mm", 1},
                                             {Unit::centimetre, "cm", 10},
                                             {Unit::metre, "m", 1e3},
                                             {Unit::kilometre, "km", 1e6},
                                             {Unit::mil, "mil", 1e-3 * inch},
                                             {Unit::inch, "in", inch},
                                             {Unit::foot, "ft", 12 * inch},
                                             {Unit::us_foot, "us-ft", 1.2e6 / 3937},
                                             {Unit::yard, "yd", 36 * inch},
                                             {Unit::css_pixel, "px", inch / 96}}};

const NamedUnit* find(Unit unit) {
  for (const NamedUnit& one : lengths)
    if (one.unit == unit) return &one;
  return nullptr;
}

void scale(std::vector<Vec2>& points, double factor) {
  for (Vec2& p : points) p = factor * p;
}

void scale(Document<Feature>& features, double factor) {
  if (factor == 1) return;
  features.arc_tolerance *= factor;
  for (Feature& feature : features.items) {
    for (Ring& ring : feature.rings) scale(ring.points, factor);
    for (Contour& contour : feature.contours) scale(contour.points, factor);
    for (Chain& chain : feature.chains) scale(chain.points, factor);
  }
  features.pixel *= factor;
  if (!features.crs_wkt.empty()) {
    features.crs_wkt.clear();
    features.notes.push_back("the reference system does not hold in other units and is left out");
  }
}

Error refused(const char* text) { return {ErrorCode::invalid_option, text, {}}; }

/// The length of one unit of the features, in millimetres; 0: unknown. Adds a note on assumptions.
double length_of_unit(Document<Feature>& features) {
  if (features.unit == Unit::css_pixel)
    features.notes.push_back("no physical size is given; assumed: 96 pixels per inch");
  if (features.unit != Unit::pixel || !(features.dots_per_inch > 0))
    return millimetres(features.unit);
  features.notes.push_back("the image says " + std::to_string(std::lround(features.dots_per_inch)) +
                           " dots per inch");
  return inch / features.dots_per_inch;
}

/// The unit that the options say or assume.
Status take_units(Document<Feature>& features, const UnitOptions& options) {
  const bool unplaced = features.unit == Unit::pixel && features.pixel > 0;
  if (options.pixel_size > 0 && !unplaced)
    return refused("a pixel size is for images that are not georeferenced");
  if (options.pixel_size > 0) scale(features, options.pixel_size);
  const bool says_nothing =
      features.unit == Unit::unknown || (unplaced && !(features.dots_per_inch > 0));
  if (options.given != Unit::unknown || options.pixel_size > 0) {
    if (unplaced && options.pixel_size == 0 && features.dots_per_inch > 0)
      features.notes.push_back(std::string("each pixel is taken for 1 ") + name_of(options.given) +
                               ", though the image says how large it is; --output-units " +
                               name_of(options.given) + " uses that size");
    features.unit = options.given;
  } else if (says_nothing && options.assumed != Unit::unknown) {
    features.unit = options.assumed;
    features.notes.push_back(std::string("no unit is given; assumed: ") + name_of(options.assumed) +
                             "; --units overrides that");
  }
  return success();
}

}  // namespace

const char* name_of(Unit unit) {
  const NamedUnit* found = find(unit);
  if (found != nullptr) return found->name;
  return unit == Unit::pixel ? "pixel" : unit == Unit::degree ? "degree" : "";
}

std::optional<Unit> unit_of(std::string_view name) {
  for (const NamedUnit& one : lengths)
    if (one.name == name) return one.unit;
  return std::nullopt;
}

std::string unit_names() {
  std::string names;
  for (const NamedUnit& one : lengths) names += (names.empty() ? "" : ", ") + std::string(one.name);
  return names;
}

double millimetres(Unit unit) {
  const NamedUnit* found = find(unit);
  return found == nullptr ? 0 : found->millimetres;
}

Unit unit_of_length(double millimetres) {
  constexpr double rounding = 1e-9;
  for (const NamedUnit& one : lengths)
    if (std::abs(one.millimetres - millimetres) < rounding * one.millimetres) return one.unit;
  return Unit::unknown;
}

Status convert_units(Document<Feature>& features, const UnitOptions& options) {
  const bool other = options.given != Unit::unknown || options.wanted != Unit::unknown;
  if (features.geographic && (other || options.scale != 1 || options.assumed != Unit::unknown))
    return refused("longitudes and latitudes have no unit of length; --project makes them metres");
  if (Status taken = take_units(features, options); !taken) return taken;
  double factor = options.scale;
  if (options.wanted != Unit::unknown && options.wanted != features.unit) {
    const double from = length_of_unit(features);
    if (!(from > 0)) return refused("the input has no unit to convert; --units gives it one");
    factor *= from / millimetres(options.wanted);
    if (options.assumed != Unit::unknown && options.given == Unit::unknown &&
        features.unit != Unit::css_pixel && features.unit != Unit::pixel)
      features.notes.push_back(std::string("the unit of the input is '") + name_of(features.unit) +
                               "', that of the result and of options '" + name_of(options.wanted) +
                               "'; --output-units chooses another");
    features.unit = options.wanted;
  }
  scale(features, factor);
  return success();
}

}  // namespace medial
