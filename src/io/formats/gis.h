#pragma once

// Formats of GIS that GDAL makes.

#include "io/tables.h"

class GDALDataset;

namespace medial::io {

/// Makes a dataset with an empty layer for each table. Errors: unsupported, unwritable.
Status create_by_gdal(const std::string& path, const Target& target, const TableSource& source);

/// Lets `make` make the file of a target, or where that is a stream a file for a while, whose bytes
/// go on: some drivers of GDAL need to seek, or do not notice a full disk. Errors: those of `make`,
/// unwritable.
Status make_file(Target& target, const std::function<Status(const std::string& path)>& make);

}  // namespace medial::io
