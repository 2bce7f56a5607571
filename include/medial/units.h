#pragma once

// Units of length: their names, and documents in other units.

#include <optional>
#include <string>
#include <string_view>

#include "medial/document.h"
#include "medial/error.h"

namespace medial {

/// "mm", "in", "px" ...; empty: unknown. Of an image's pixels "pixel".
const char* name_of(Unit unit);
/// A unit of length by its name; nothing for other words.
std::optional<Unit> unit_of(std::string_view name);
/// "um, mm, ...": the names that unit_of() takes.
std::string unit_names();
/// Of one unit; of pixels of drawings 25.4 / 96; 0: it has no length.
double millimetres(Unit unit);

/// The unit that is so many millimetres long; unknown: none.
Unit unit_of_length(double millimetres);

struct UnitOptions {
  Unit given = Unit::unknown;    ///< what the input is in, whatever it says itself
  Unit assumed = Unit::unknown;  ///< the same for an input that does not say, with a note
  double pixel_size = 0;         ///< of an image, in units `given`; 0: as it says
  double scale = 1;              ///< enlarges by this factor, above 0
  Unit wanted = Unit::unknown;   ///< of the result; unknown: as the input
};

/// Converts all lengths of features; bulges and weights stay. A conversion that rests on 96 pixels
/// or on an image's dots per inch leaves a note, and a reference system in other units is dropped
/// with one. Errors: invalid_option (degrees, an input without a unit where one is wanted, a pixel
/// size of what is no image).
Status convert_units(Document<Feature>& features, const UnitOptions& options);

}  // namespace medial
