#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "medial/axis.h"
#include "medial/contour.h"
#include "medial/document.h"
#include "medial/error.h"
#include "medial/io/image.h"
#include "medial/load.h"
#include "medial/shape.h"
#include "medial/voronoi.h"

namespace medial::io {

struct ReadOptions {
  std::string layer;  ///< name of the layer; empty: the first
  std::string where;  ///< attribute filter of OGR SQL; empty: all
  /// Of polygons of straight edges; features with curves stay as they are, for load_shapes().
  RepairRule repair = RepairRule::none;
  bool project = false;  ///< geographic coordinates to a fitting local projection, in metres
  /// Of loose curves (DXF): ends at most this far apart, in units of the input, are joined; what
  /// stays open is left out. Infinity closes whatever is open. Nothing: 1e-6 of the diagonal of the
  /// bounding box.
  std::optional<double> close;
  ImageOptions image;  ///< of images: what is foreground
  /// For planar graphs: points, lines and open curves are kept too, lines and points as chains,
  /// open curves as contours that say so; of a drawing (SVG) also shapes that are not filled. A
  /// plain text of one block is a list of points, one of several has a chain or a point in each.
  bool loose = false;
  bool smooth_contour = false;  ///< of images: smooth_outline() instead of pixel_outline()
};

/// Reads polygons and curved shapes. `-` is standard input (WKT, GeoJSON, SVG, DXF, `x y` text or
/// medial's own by its first characters). .svg and .dxf are read as docs/inputs.md says; .wkt,
/// .txt, .xy and .json of medial's own by fast readers; images (PNG, TIFF, PBM, PGM, by their
/// first bytes) become one feature, the outline of their foreground with y downwards, or placed
/// where the file says; all else by GDAL. Any may be compressed by gzip. Errors: unreadable,
/// malformed, unsupported, empty, not_finite, no_area, too_large, invalid_option, out_of_memory.
Result<Document<Feature>> read_dataset(const std::string& path, const ReadOptions& options = {});

/// The outlines of a text, set in one line with the font's advances and kerning: a feature for each
/// character that has an outline, in font units, the baseline at y = 0. `text` is UTF-8, `font` a
/// scalable font file (TrueType, OpenType, Type 1). A character that the font lacks is drawn as
/// its replacement, with a note.
/// Errors: unreadable, malformed (text), unsupported (bitmap fonts), empty, out_of_memory.
Result<Document<Feature>> read_text(const std::string& text, const std::string& font);

/// A shape and its Voronoi diagram.
struct VoronoiItem {
  Shape shape;
  VoronoiDiagram diagram;
  Attributes attributes;
};

/// Whether the file begins like medial's own JSON; and its content. Errors: as read_dataset().
bool is_native(const std::string& path);
Result<Document<AxisItem>> read_native(const std::string& path);

/// Whether the file is a .json of Voronoi diagrams as write_voronoi() makes it; and its diagrams,
/// without shapes and reference system. Errors: unreadable, malformed, unsupported (a newer
/// version), too_large (4 GiB or more), out_of_memory.
bool is_voronoi(const std::string& path);
Result<Document<VoronoiItem>> read_voronoi(const std::string& path);

}  // namespace medial::io
