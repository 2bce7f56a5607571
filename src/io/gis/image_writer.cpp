#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "io/gis/gdal_support.h"
#include "io/gis/make_file.h"
#include "io/gis/rasters.h"

namespace medial::io {

namespace {

/// Rows of pixels in memory, of one of GDAL's types.
struct Pixels {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  GDALDataType type = GDT_Byte;
  void* values = nullptr;
};

/// `placed`: says where the pixels lie; null: nowhere.
Status create_raster(const std::string& path, const std::string& format, const Pixels& pixels,
                     const ImageFile* placed) {
  const bool tiff = format.starts_with("tif");
  register_gdal();
  const GdalMessages messages;
  const auto failure = [&messages](const char* otherwise) {
    return Error{ErrorCode::unwritable,
                 messages.failure().empty() ? std::string(otherwise) : messages.failure(),
                 {}};
  };
  GDALDriver* const memory = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(tiff              ? "GTiff"
                                                                     : format == "png" ? "PNG"
                                                                                       : "PNM");
  if (memory == nullptr || driver == nullptr) return failure("GDAL lacks the format");
  const std::unique_ptr<GDALDataset> source(memory->Create("", static_cast<int>(pixels.width),
                                                           static_cast<int>(pixels.height), 0,
                                                           pixels.type, nullptr));
  if (!source) return failure("cannot be kept in memory");
  const std::string pointer = fmt::format("DATAPOINTER={}", pixels.values);
  const char* const band_options[] = {pointer.c_str(), nullptr};
  if (source->AddBand(pixels.type, const_cast<char**>(band_options)) != CE_None)
    return failure("cannot be kept in memory");
  if (placed != nullptr && placed->placed()) {
    PixelPlacement placement = placed->placement;
    source->SetGeoTransform(placement.data());
    OGRSpatialReference reference;
    if (!placed->crs_wkt.empty() && reference.importFromWkt(placed->crs_wkt.c_str()) == OGRERR_NONE)
      source->SetSpatialRef(&reference);
  }
  const char* const tiff_options[] = {"COMPRESS=DEFLATE", nullptr};
  std::unique_ptr<GDALDataset> written(
      driver->CreateCopy(path.c_str(), source.get(), FALSE,
                         tiff ? const_cast<char**>(tiff_options) : nullptr, nullptr, nullptr));
  if (!written) return failure("cannot be written");
  written->FlushCache(false);
  written.reset();
  if (!messages.failure().empty()) return failure("cannot be written");
  return success();
}

Status write_pixels(Target& target, const Pixels& pixels, const ImageFile* placed) {
  return make_file(target, [&](const std::string& path) {
    return create_raster(path, target.format, pixels, placed);
  });
}

/// The pixels as values of one type; `get(i)` gives that of pixel i.
template <class Value, class Get>
std::vector<Value> values_of(const DistanceMap& distances, const Get& get) {
  std::vector<Value> values(distances.squared.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<Value>(get(i));
  return values;
}

/// The raw bytes of a bitmap.
Status write_pbm(Target& target, const ImageOutput& output) {
  OutputStream& out = *target.out;
  const Image& image = output.image;
  out.put(fmt::format("P4\n{} {}\n", image.width(), image.height()));
  for (std::uint32_t y = 0; y < image.height(); ++y) {
    for (std::uint32_t x = 0; x < image.width(); x += 8) {
      unsigned byte = 0;
      for (std::uint32_t i = 0; i < 8; ++i) byte |= image.at(x + i, y) ? 128U >> i : 0;
      out.put(static_cast<char>(byte));
    }
  }
  return success();
}

Status write_raster(Target& target, const DistancesOutput& output) {
  const DistanceMap& distances = output.distances;
  const ImageFile& source = output.source;
  const DistanceFormat& format = output.format;
  const std::uint32_t largest =
      distances.squared.empty() ? 0 : *std::ranges::max_element(distances.squared);
  if (largest == DistanceMap::unbounded)
    return Error{
        ErrorCode::invalid_option,
        "the image has no background to measure distances to; count the outside as background",
        {}};
  const double unit = distances.to == DistanceTo::cracks ? 0.5 : 1;
  const auto value_of = [&format, unit](double squared) {
    return format.scale * (format.squared ? unit * unit * squared : unit * std::sqrt(squared));
  };
  const auto value = [&](std::size_t i) { return value_of(distances.squared[i]); };
  const bool tiff = target.format.starts_with("tif");
  Pixels pixels{distances.width, distances.height, GDT_Float32, nullptr};
  if (tiff && format.squared && format.scale == 1 && unit == 1) {
    std::vector<std::uint32_t> values = distances.squared;
    pixels.type = GDT_UInt32;
    pixels.values = values.data();
    return write_pixels(target, pixels, &source);
  }
  if (tiff) {
    std::vector<float> values = values_of<float>(distances, value);
    pixels.values = values.data();
    return write_pixels(target, pixels, &source);
  }
  if (!(value_of(largest) < 65535.5)) {
    return Error{ErrorCode::invalid_option,
                 fmt::format("16 bits do not hold the largest value, {:.6g}: write .tif, or scale",
                             value_of(largest)),
                 {}};
  }
  std::vector<std::uint16_t> values =
      values_of<std::uint16_t>(distances, [&](std::size_t i) { return std::lround(value(i)); });
  pixels.type = GDT_UInt16;
  pixels.values = values.data();
  return write_pixels(target, pixels, nullptr);
}

Status write_raster(Target& target, const ImageOutput& output) {
  const Image& image = output.image;
  std::vector<std::uint8_t> values(std::size_t{image.width()} * image.height());
  for (std::uint32_t y = 0; y < image.height(); ++y)
    for (std::uint32_t x = 0; x < image.width(); ++x)
      values[std::size_t{y} * image.width() + x] = image.at(x, y) ? 255 : 0;
  return write_pixels(target, {image.width(), image.height(), GDT_Byte, values.data()},
                      target.format.starts_with("tif") ? &output.source : nullptr);
}

}  // namespace

Format with_rasters(Format format) {
  return format.writes<DistancesOutput, ImageOutput>(write_raster, write_raster);
}

Format tif_format() {
  Format format{".tif .tiff"};
  format.own_files = true;
  return with_rasters(format);
}

Format pgm_format() { return Format{".pgm"}.writes<DistancesOutput>(write_raster); }
Format pbm_format() { return Format{".pbm"}.writes<ImageOutput>(write_pbm); }

}  // namespace medial::io
