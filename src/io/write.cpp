#include "medial/io/write.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "io/format.h"
#include "io/format_name.h"
#include "io/guarded.h"
#include "io/place.h"
#include "io/reference_system.h"
#include "medial/document.h"

namespace medial::io {

namespace {

/// What a document of one kind is called where its file has no name, and its format.
struct Standard {
  const char* format;
  const char* name = "medial";
};

/// The one way from a document to a file: looks the format up, decides on the reference system,
/// opens, writes, and puts the file in its place.
template <class Output>
Status write_document(const Destination& destination, const std::string& asked,
                      const Standard& standard, const std::string& crs_wkt, const Output& output,
                      Unit unit = Unit::unknown) {
  const std::string& path = destination.path;
  Target target;
  if (crs_wkt.empty()) target.unit = name_of(unit);
  target.format = path == "-" && asked.empty() ? standard.format : format_name(path, asked);
  const Format* format = find_format(target.format, Output::kind);
  if (format == nullptr)
    return Error{ErrorCode::unsupported,
                 fmt::format("'{}' is not a format that can be written here; use one of {}",
                             target.format, formats_of(Output::kind)),
                 in_file(path)};
  const bool stream = is_stream(path);
  target.name = stream ? standard.name : std::filesystem::path(path).stem().string();
  const auto write = [&]() -> Status {
    if (format->geographic) {
      Result<OutputCrs> crs = output_crs_of(crs_wkt, unit);
      if (!crs) return std::move(crs).error();
      target.crs = std::move(*crs);
    }
    Status written = std::get<Writer<Output>>(format->writers)(target, output);
    return target.status() ? written : target.status();
  };
  if (!format->own_files || stream)
    return write_whole(destination, [&](OutputStream& out) {
      target.out = &out;
      return write();
    });
  return guarded(path, [&]() -> Status {
    Result<PendingFile> pending = PendingFile::create(path);
    if (!pending) return std::move(pending).error();
    target.path = pending->path();
    target.adds_to_file = format->adds_layers;
    if constexpr (requires { output.options.overwrite; })
      target.overwrite = output.options.overwrite;
    // A library adds to a copy: what is there stays whole whatever happens.
    std::error_code failed;
    if (format->adds_layers && std::filesystem::exists(path, failed))
      std::filesystem::copy_file(path, target.path, failed);
    if (failed)
      return Error{ErrorCode::unwritable, "cannot copy what is there: " + failed.message(), {}};
    Status written = write();
    return written ? pending->commit() : written;
  });
}

/// The same for documents with options, which are checked.
template <class Output>
Status write_checked(const Destination& target, const std::string& asked, const Standard& standard,
                     const Output& output) {
  if (!(output.options.chord > 0) || !std::isfinite(output.options.chord))
    return Error{ErrorCode::invalid_option, "chord is not a positive number", in_file(target.path)};
  return write_document(target, asked, standard, output.document.crs_wkt, output,
                        output.document.unit);
}

}  // namespace

Status write_axes(const Destination& target, const std::string& format,
                  const Document<AxisItem>& file, const WriteOptions& options) {
  return write_checked(target, format, {"json"}, AxesOutput{file, options});
}

Status write_shapes(const Destination& target, const std::string& format,
                    const Document<ShapeItem>& file, const WriteOptions& options) {
  return write_checked(target, format, {"json"}, ShapesOutput{file, options});
}

Status write_voronoi(const Destination& target, const std::string& format,
                     const Document<VoronoiItem>& file, const WriteOptions& options) {
  return write_checked(target, format, {"json"}, VoronoiOutput{file, options});
}

Status write_offsets(const Destination& target, const std::string& format,
                     const Document<OffsetItem>& file, const WriteOptions& options, bool chords) {
  return write_checked(target, format, {"json"}, OffsetsOutput{{file, options}, chords});
}

Status write_carving(const Destination& target, const std::string& format,
                     const Document<CarveItem>& file, const MachineOptions& machine,
                     const WriteOptions& options) {
  for (const double value :
       {machine.safe, machine.rapid, machine.carving.feed, machine.carving.plunge,
        machine.clearing.feed, machine.clearing.plunge})
    if (!(value > 0) || !std::isfinite(value) || !(machine.chord >= 0))
      return Error{ErrorCode::invalid_option, "heights, feeds and chords must be positive", {}};
  return write_checked(target, format, {"nc"}, CarvingOutput{{file, options}, machine});
}

Status write_features(const Destination& target, const std::string& format,
                      const Document<AxisItem>& axes, std::span<const AxisFeatures> features,
                      const FeatureWriteOptions& options) {
  return write_checked(target, format, {"json", "features"},
                       FeaturesOutput{{axes, options.write}, features, options});
}

Status write_layers(const Destination& target, const std::string& format,
                    const Document<Layer>& layers, const Document<AxisItem>& background,
                    const WriteOptions& options) {
  return write_checked(target, format, {"geojson"}, LayersOutput{{layers, options}, background});
}

Status write_field(const std::string& path, const std::string& format,
                   std::span<const Shape> shapes, std::span<const PotentialField> fields,
                   const FieldPictureOptions& options) {
  return write_document(path, format, {"svg"}, {}, FieldOutput{shapes, fields, options});
}

Status write_voxels(const std::string& path, const std::string& format, const VoxelAxis& axis,
                    const Solid& solid, double width) {
  return write_document(path, format, {"ply"}, {}, VoxelsOutput{axis, solid, width});
}

Status write_distances(const std::string& path, const DistanceMap& distances,
                       const ImageFile& source, const DistanceFormat& format) {
  return write_document(path, {}, {"pgm"}, {}, DistancesOutput{distances, source, format});
}

Status write_image(const std::string& path, const Image& image, const ImageFile& source) {
  return write_document(path, {}, {"pbm"}, {}, ImageOutput{image, source});
}

}  // namespace medial::io
