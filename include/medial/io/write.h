#pragma once

#include <string>

#include "medial/error.h"
#include "medial/io/read.h"

namespace medial::io {

struct WriteOptions {
  double chord = 1e-3;       ///< chords stay within this share (> 0) of the bounding box diagonal
  bool radius_as_z = false;  ///< drawings (.dxf) have the radius as z
  // pictures (.svg .pdf .png .ps)
  double width = 1024;    ///< of the picture, in pixels or points, in [16, 8000]
  int disks = 0;          ///< draw about this many maximal disks; 0: none
  bool contacts = false;  ///< draw the feet of the nodes' disks
  bool shape = true;      ///< draw the shape
  bool nodes = false;     ///< draw the nodes by kind
  bool titles = false;    ///< write each item's attribute "title" below its shape
};

/// Writes axes by the extension of `path`: .json (native) .geojson .gpkg .shp .fgb .wkt .csv
/// .dxf .svg .pdf .png .ps; `-` is standard output and takes `format` (an extension without its
/// dot). Formats of GIS, .wkt and .csv get longitudes and latitudes again where the reference
/// system is a local projection (medial/io/projection.h). Writes to a temporary name beside the
/// target and renames: never a partial file. Errors: unsupported, unwritable, invalid_option
/// (chord, width), out_of_memory.
Status write_axes(const std::string& path, const std::string& format,
                  const Document<AxisItem>& file, const WriteOptions& options = {});

/// The extensions write_axes() takes, for help texts.
std::string known_output_formats();

/// Writes Voronoi diagrams by the extension of `path`, as write_axes() does: .json (lossless;
/// docs/format.md) .geojson (faces as polygons and edges as lines) .svg .pdf .png .ps. Errors:
/// unsupported, unwritable.
Status write_voronoi(const std::string& path, const std::string& format,
                     const Document<VoronoiItem>& file, const WriteOptions& options = {});

/// The extensions write_voronoi() takes, for help texts.
std::string known_voronoi_formats();

/// Writes a text to a new file that appears all at once, or to `-` or a device as it is. Errors:
/// unwritable, out_of_memory.
Status write_text(const std::string& path, const std::string& text);

/// Removes temporary files of writes under way; safe to call from a signal handler.
void remove_partial_files() noexcept;

}  // namespace medial::io
