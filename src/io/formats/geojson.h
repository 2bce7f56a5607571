#pragma once

#include <memory>
#include <optional>
#include <string>

#include "io/feature_reader.h"

namespace medial::io {

/// Opens a file of GeoJSON that is a plain collection of polygons, as far as its beginning says,
/// and what it reads: see Unusual. Null: GDAL has to read it.
std::unique_ptr<FeatureReader> open_geojson(const std::string& path);
/// Reads it in one pass; nothing: GDAL has to.
std::optional<Document<Feature>> read_geojson(const std::string& path);

}  // namespace medial::io
