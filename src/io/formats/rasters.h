#pragma once

#include "io/format.h"

namespace medial::io {

/// Distances and images by GDAL: .tif .png .pgm.
Status write_raster(Target& target, const DistancesOutput& output);
Status write_raster(Target& target, const ImageOutput& output);

}  // namespace medial::io
