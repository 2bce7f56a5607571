#pragma once

#include "io/format.h"

namespace medial::io {

/// Distances and images by GDAL: .tif .png .pgm.
Status write_raster(Target& target, const DistancesOutput& output);
Status write_raster(Target& target, const ImageOutput& output);

/// The outline of an image's foreground as one feature, or of each label's pixels as one each. A
/// document in pixels with y downwards, or placed where the file says.
Result<Document<Feature>> outline_document(ImageFile file, std::span<const std::uint32_t> labels,
                                           const ReadOptions& options);

/// Whether a file is called like a map of ROS; and its free cells.
bool is_ros_map(const std::string& path);
Result<ImageFile> read_ros_image(const std::string& path, TextSource& source,
                                 const ImageOptions& options);

}  // namespace medial::io
