#pragma once

#include <string>
#include <vector>

#include "medial/document.h"
#include "medial/error.h"
#include "medial/io/write.h"
#include "medial/offset.h"

namespace medial::io {

/// What the features that lie in one region of a buffer have in common.
struct BufferSource {
  std::vector<std::uint32_t> features;  ///< in their order in the input
  /// Name and value, in the order of the first feature: those on which all of them agree.
  Attributes attributes;
};

/// A shape, or a planar graph, and its offset curves.
struct OffsetItem {
  Shape shape;
  Offsets offsets;
  Attributes attributes = {};
  PlanarGraph planar_graph = {};           ///< what buffers are of, where there is no shape
  std::vector<BufferSource> sources = {};  ///< of each region of a buffer; or empty
};

/// Writes offset curves by the extension of `path`, as write_axes() does: .json (lossless;
/// docs/format.md); .wkt (a multi-surface with exact circular strings for each clearance of a
/// feature, or a multi-polygon of chords with `chords`); .geojson (a polygon of chords for each
/// region; both in longitudes and latitudes again where the reference system is a local projection,
/// .wkt then with chords); .dxf (closed polylines with bulges, a layer for each clearance); .svg
/// .pdf .png .ps. Chords stay within options.chord. Errors: unsupported, unwritable,
/// invalid_option.
Status write_offsets(const std::string& path, const std::string& format,
                     const Document<OffsetItem>& file, const WriteOptions& options = {},
                     bool chords = false);

/// The extensions write_offsets() takes, for help texts.
std::string known_offset_formats();

}  // namespace medial::io
