#pragma once

#include <string>

#include "io/tables.h"

namespace medial::io {

class OutputCrs;

/// A GeoPackage: GDAL makes its layers, empty, and SQLite takes the rows one by one in its own
/// words, which takes a third of the time that GDAL's feature objects do. Errors: unwritable,
/// unsupported, and those of the source's `fill`.
Status write_gpkg(const std::string& path, const OutputCrs& crs, const TableSource& source);

}  // namespace medial::io
