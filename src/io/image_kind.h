#pragma once

#include <cstddef>
#include <string_view>

namespace medial::io {

/// How many characters of a file begins_like_image() looks at.
constexpr std::size_t image_sniffed = 12;

bool begins_like_pnm(std::string_view text);
/// PNG, JPEG, BMP, WebP, GIF, TIFF: what GDAL reads.
bool begins_like_raster(std::string_view text);
/// Whether it is an image, by its first bytes, whatever its name.
bool begins_like_image(std::string_view text);

}  // namespace medial::io
