#pragma once

#include "io/format.h"

namespace medial::io {

/// The outline of an image's foreground as one feature, or of each label's pixels as one each. A
/// document in pixels with y downwards, or placed where the file says.
Result<Document<Feature>> outline_document(ImageFile file, std::span<const std::uint32_t> labels,
                                           const ReadOptions& options);

/// The free cells of a map of ROS.
Result<ImageFile> read_ros_image(const std::string& path, TextSource& source,
                                 const ImageOptions& options);

}  // namespace medial::io
