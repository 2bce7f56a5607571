#pragma once

#include <memory>
#include <string>

#include "io/feature_reader.h"

namespace medial::io {

/// Opens a file of GeoJSON that is a plain collection of polygons; null: GDAL has to read it.
std::unique_ptr<FeatureReader> open_geojson(const std::string& path);

}  // namespace medial::io
