#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "io/format_name.h"
#include "io/gdal_support.h"
#include "io/guarded.h"
#include "io/output.h"
#include "io/place.h"
#include "medial/io/image.h"

namespace medial::io {

namespace {

/// Rows of pixels in memory, of one of GDAL's types.
struct Pixels {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  GDALDataType type = GDT_Byte;
  void* values = nullptr;
};

Status write_raster(const std::string& path, const char* driver_name, const Pixels& pixels,
                    const ImageFile* placed) {
  register_gdal();
  const GdalMessages messages;
  const auto failure = [&messages, &path](const char* otherwise) {
    return Error{ErrorCode::unwritable,
                 messages.failure().empty() ? std::string(otherwise) : messages.failure(),
                 in_file(path)};
  };
  GDALDriver* const memory = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(driver_name);
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
  Result<PendingFile> pending = PendingFile::create(path);
  if (!pending) return pending.error();
  const char* const tiff_options[] = {"COMPRESS=DEFLATE", nullptr};
  const bool tiff = std::string_view(driver_name) == "GTiff";
  std::unique_ptr<GDALDataset> written(
      driver->CreateCopy(pending->path().c_str(), source.get(), FALSE,
                         tiff ? const_cast<char**>(tiff_options) : nullptr, nullptr, nullptr));
  if (!written) return failure("cannot be written");
  written->FlushCache(false);
  written.reset();
  if (!messages.failure().empty()) return failure("cannot be written");
  return pending->commit();
}

Error unknown_format(const std::string& path, const char* known) {
  return {ErrorCode::unsupported, fmt::format("no such image format; known are {}", known),
          in_file(path)};
}

/// The pixels as values of one type; `get(i)` gives that of pixel i.
template <class Value, class Get>
std::vector<Value> values_of(const DistanceMap& distances, const Get& get) {
  std::vector<Value> values(distances.squared.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<Value>(get(i));
  return values;
}

Status write_distances_to(const std::string& path, const DistanceMap& distances,
                          const ImageFile& source, const DistanceFormat& format) {
  const std::string extension = format_name(path);
  const bool tiff = extension == "tif" || extension == "tiff";
  if (!tiff && extension != "png" && extension != "pgm")
    return unknown_format(path, ".tif .png .pgm");
  const std::uint32_t largest =
      distances.squared.empty() ? 0 : *std::ranges::max_element(distances.squared);
  if (largest == DistanceMap::unbounded)
    return Error{ErrorCode::invalid_option,
                 "without background there is no distance; count the outside as background",
                 {}};
  const double unit = distances.to == DistanceTo::cracks ? 0.5 : 1;
  const auto value_of = [&](std::uint32_t squared) {
    const double value = squared;
    return format.scale * (format.squared ? unit * unit * value : unit * std::sqrt(value));
  };
  const auto value = [&](std::size_t i) { return value_of(distances.squared[i]); };
  Pixels pixels{distances.width, distances.height, GDT_Float32, nullptr};
  if (tiff && format.squared && format.scale == 1 && unit == 1) {
    std::vector<std::uint32_t> values = distances.squared;
    pixels.type = GDT_UInt32;
    pixels.values = values.data();
    return write_raster(path, "GTiff", pixels, &source);
  }
  if (tiff) {
    std::vector<float> values = values_of<float>(distances, value);
    pixels.values = values.data();
    return write_raster(path, "GTiff", pixels, &source);
  }
  if (!(value_of(largest) < 65535.5)) {
    return Error{ErrorCode::invalid_option,
                 fmt::format("16 bits do not hold the largest value, {:.6g}: write .tif, or scale",
                             value_of(largest)),
                 in_file(path)};
  }
  std::vector<std::uint16_t> values =
      values_of<std::uint16_t>(distances, [&](std::size_t i) { return std::lround(value(i)); });
  pixels.type = GDT_UInt16;
  pixels.values = values.data();
  return write_raster(path, extension == "png" ? "PNG" : "PNM", pixels, nullptr);
}

Status write_pbm(const std::string& path, const Image& image) {
  Result<PendingFile> pending = PendingFile::create(path);
  if (!pending) return pending.error();
  Result<OutputStream> stream = OutputStream::open(pending->path());
  if (!stream) return stream.error();
  stream->put(fmt::format("P4\n{} {}\n", image.width(), image.height()));
  for (std::uint32_t y = 0; y < image.height(); ++y) {
    for (std::uint32_t x = 0; x < image.width(); x += 8) {
      unsigned byte = 0;
      for (std::uint32_t i = 0; i < 8; ++i) byte |= image.at(x + i, y) ? 128U >> i : 0;
      stream->put(static_cast<char>(byte));
    }
  }
  if (Status finished = stream->finish(); !finished) return finished;
  return pending->commit();
}

Status write_image_to(const std::string& path, const Image& image, const ImageFile& source) {
  const std::string extension = format_name(path);
  if (extension == "pbm") return write_pbm(path, image);
  const bool tiff = extension == "tif" || extension == "tiff";
  if (!tiff && extension != "png") return unknown_format(path, ".png .tif .pbm");
  std::vector<std::uint8_t> values(std::size_t{image.width()} * image.height());
  for (std::uint32_t y = 0; y < image.height(); ++y)
    for (std::uint32_t x = 0; x < image.width(); ++x)
      values[std::size_t{y} * image.width() + x] = image.at(x, y) ? 255 : 0;
  return write_raster(path, tiff ? "GTiff" : "PNG",
                      {image.width(), image.height(), GDT_Byte, values.data()},
                      tiff ? &source : nullptr);
}

}  // namespace

Status write_distances(const std::string& path, const DistanceMap& distances,
                       const ImageFile& source, const DistanceFormat& format) {
  return guarded(path, [&] { return write_distances_to(path, distances, source, format); });
}

Status write_image(const std::string& path, const Image& image, const ImageFile& source) {
  return guarded(path, [&] { return write_image_to(path, image, source); });
}

}  // namespace medial::io
