#pragma once

#include <string>

#include "medial/io/read.h"

namespace medial::io {

/// Reads a layer of polygons by whatever vector driver of GDAL knows the file. `name` is a path or
/// one of GDAL's own names (/vsizip/..., PG:...); `shown` is what errors call it.
/// Errors: unreadable, malformed, unsupported, invalid_option.
Result<Document<Feature>> read_gdal(const std::string& name, const std::string& shown,
                                    const ReadOptions& options);

/// The same for a file that lies in memory.
Result<Document<Feature>> read_gdal_bytes(const std::string& bytes, const std::string& shown,
                                          const ReadOptions& options);

}  // namespace medial::io
