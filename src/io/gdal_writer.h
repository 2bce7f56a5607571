#pragma once

#include <string>

#include "medial/io/write.h"

namespace medial::io {

/// Writes a line feature for each branch by GDAL's driver for `format` (geojson, gpkg, shp, fgb),
/// and in a GeoPackage the nodes as a second layer. Where the reference system is a local
/// projection of medial's own, centres go back to longitude and latitude, and radii and lengths
/// stay in metres. Errors: unwritable, unsupported.
Status write_gdal(const std::string& path, const std::string& format, const NativeFile& file,
                  const WriteOptions& options);

}  // namespace medial::io
