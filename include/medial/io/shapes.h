#pragma once

#include <string>
#include <vector>

#include "medial/document.h"
#include "medial/error.h"
#include "medial/shape.h"

namespace medial::io {

/// What write_shapes() writes.
struct ShapesFile {
  std::vector<ShapeItem> items;
  std::string crs_wkt;
  bool y_down = false;  ///< the y axis points down
  double chord = 1e-3;  ///< where arcs become points: by this fraction of the diagonal
  double width = 1024;  ///< of pictures of fixed size: .pdf .png .ps
};

/// Writes shapes by the extension of `path`: .json (native, lossless), .svg (paths of lines and
/// arcs, without loss but for the shift of its frame), .wkt (a geometry a line; with arcs a
/// MULTISURFACE), .geojson (arcs as points), .dxf (closed polylines with bulges), and pictures:
/// .pdf .png .ps. `-` is standard output and takes `format`. Writes to a temporary name beside the
/// target and renames. Errors: unsupported, unwritable.
Status write_shapes(const std::string& path, const std::string& format, const ShapesFile& file);

/// The extensions write_shapes() takes, for help texts.
std::string known_shape_formats();

}  // namespace medial::io
