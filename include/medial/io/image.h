#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "medial/error.h"
#include "medial/raster.h"

namespace medial::io {

struct ImageOptions {
  /// Pixels at or above this value are foreground. Nothing: half of the format's largest value
  /// (128 of 8 bits, 0.5 of real numbers, any set bit of 1 bit).
  std::optional<double> threshold;
  bool invert = false;  ///< pixels below the threshold are foreground instead
};

/// Where pixels lie: column c and row r of a pixel's upper left corner are the point
/// (t[0] + c t[1] + r t[2], t[3] + c t[4] + r t[5]).
using PixelPlacement = std::array<double, 6>;
constexpr PixelPlacement unplaced = {0, 1, 0, 0, 0, 1};

/// What a file of an image holds.
struct ImageFile {
  Image image;
  PixelPlacement placement = unplaced;
  std::string crs_wkt;  ///< coordinate reference system as WKT, empty if none
  bool geographic = false;
  std::vector<std::string> notes;

  bool placed() const { return placement != unplaced; }
};

/// Whether a file begins like an image: PNG, TIFF or PBM, PGM (P1, P2, P4, P5). False for what
/// cannot be opened.
bool is_image(const std::string& path);

/// Reads a binary image: PBM (set bits, black, are the foreground) and PGM, which may be compressed
/// by gzip, or PNG, TIFF and GeoTIFF through GDAL. Of colours the luminance counts (ITU-R BT.601);
/// what is transparent or without data is background, inverted or not. `-` is standard input.
/// Errors: unreadable, malformed, unsupported (other formats), too_large, empty (no foreground),
/// out_of_memory.
Result<ImageFile> read_image(const std::string& path, const ImageOptions& options = {});

struct DistanceFormat {
  bool squared = false;  ///< the squared distance, exactly, instead of the distance
  double scale = 1;      ///< what is written is this times the value
};

/// Writes distances by the extension of `path`: .tif holds them as 32 bits (real numbers, or
/// squared whole ones), with the placement of `source` if that has one; .png and .pgm as whole
/// numbers of 16 bits, the nearest ones. Never a partial file. Errors: unsupported, invalid_option
/// (16 bits do not hold the largest value, or there is no background at all), unwritable.
Status write_distances(const std::string& path, const DistanceMap& distances,
                       const ImageFile& source, const DistanceFormat& format = {});

/// Writes an image as .png, .tif (bytes 0 and 255) or .pbm. Errors: unsupported, unwritable.
Status write_image(const std::string& path, const Image& image, const ImageFile& source);

}  // namespace medial::io
