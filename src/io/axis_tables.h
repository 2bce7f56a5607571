#pragma once

#include <string>

#include "io/tables.h"
#include "medial/io/write.h"

namespace medial::io {

/// A line for each branch, and for a GeoPackage the nodes as a second table. Lengths and radii are
/// in the units of the computation. The source refers to both arguments.
TableSource axis_tables(const Document<AxisItem>& file, const std::string& format,
                        const WriteOptions& options);

}  // namespace medial::io
