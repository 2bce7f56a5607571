#pragma once

#include <span>
#include <string>

#include "medial/error.h"
#include "medial/field.h"
#include "medial/shape.h"

namespace medial::io {

/// How a potential is drawn.
struct FieldPictureOptions {
  double width = 800;      ///< of the picture, in pixels or points, in [16, 8000]
  int lines = 40;          ///< force lines begin on a grid, so many along the longer side; 0: none
  bool brightness = true;  ///< a point is the brighter the lower its potential, by its logarithm
  bool y_down = false;     ///< the y axis points down
};

/// Draws shapes with the potential of their borders, `fields` in the order of the shapes, by the
/// extension of `path`, as write_axes() does: .svg .pdf .png .ps. Samples the potential once for
/// each pixel, on all threads. Errors: unsupported, unwritable, invalid_option (width, lines).
Status write_field(const std::string& path, const std::string& format,
                   std::span<const Shape> shapes, std::span<const PotentialField> fields,
                   const FieldPictureOptions& options = {});

/// The extensions write_field() takes, for help texts.
std::string known_field_formats();

}  // namespace medial::io
