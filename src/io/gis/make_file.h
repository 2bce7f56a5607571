#pragma once

// Formats of GIS that GDAL makes.

#include "io/tables.h"

namespace medial::io {

/// Lets `make` make the file of a target, or if that is a stream, a temporary file whose bytes are
/// then passed on: some drivers of GDAL need to seek, or do not notice a full disk. Errors: those
/// of `make`, unwritable.
Status make_file(Target& target, const std::function<Status(const std::string& path)>& make);

}  // namespace medial::io
