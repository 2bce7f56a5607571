#pragma once

#include <gdal_priv.h>

#include "io/gis/rows.h"

namespace medial::io {

std::unique_ptr<RowFile> rows_of_gdal(GDALDatasetUniquePtr dataset,
                                      std::span<const EmptyLayer> layers);

}  // namespace medial::io
