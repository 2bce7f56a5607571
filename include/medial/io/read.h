#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "medial/axis.h"
#include "medial/error.h"
#include "medial/shape.h"

namespace medial::io {

/// One polygon or multipolygon of an input file.
struct Feature {
  std::vector<Ring> rings;
  std::int64_t id = 0;  ///< of the source, or its index
  /// Name and value as text, in order.
  std::vector<std::pair<std::string, std::string>> attributes;
};

/// What a file holds.
struct Dataset {
  std::vector<Feature> features;
  std::string crs_wkt;             ///< coordinate reference system as WKT, empty if none
  bool geographic = false;         ///< coordinates are longitude and latitude
  std::vector<std::string> notes;  ///< what repair or reprojection changed, one sentence each
};

enum class RepairRule : std::uint8_t { none, make_valid, even_odd, non_zero };

struct ReadOptions {
  std::string layer;  ///< name of the layer; empty: the first
  std::string where;  ///< attribute filter of OGR SQL; empty: all
  RepairRule repair = RepairRule::none;
  bool project = false;  ///< geographic coordinates to a fitting local projection, in metres
};

/// Reads polygons. `-` is standard input (WKT, GeoJSON or `x y` text by its first characters).
/// .wkt, .wkt.gz, .txt, .xy and .json of medial's own go through fast readers of their own;
/// everything else through GDAL. Errors: unreadable, malformed, unsupported, empty, not_finite.
Result<Dataset> read_dataset(const std::string& path, const ReadOptions& options = {});

/// One shape of a native file, and its axis.
struct NativeItem {
  Shape shape;
  MedialAxis axis;
  std::vector<std::pair<std::string, std::string>> attributes;
};

/// medial's own JSON (docs/format.md): lossless.
struct NativeFile {
  std::vector<NativeItem> items;
  std::string crs_wkt;
};

/// Whether the file begins like medial's own JSON.
bool is_native(const std::string& path);
Result<NativeFile> read_native(const std::string& path);

}  // namespace medial::io
