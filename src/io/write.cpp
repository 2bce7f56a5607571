#include "medial/io/write.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "io/format.h"
#include "io/format_name.h"
#include "io/guarded.h"
#include "io/place.h"
#include "io/reference_system.h"
#include "io/write_target.h"
#include "medial/document.h"

namespace medial::io {

namespace {

/// Writes a whole document by its format's own function.
template <class Output>
Status write_document(const Destination& destination, const std::string& asked,
                      const Written& written, const Output& output) {
  return write_target(destination, asked, written, [&](Target& target, const Format& format) {
    return std::get<Writer<Output>>(format.writers)(target, output);
  });
}

/// The same for documents with options, which are checked.
template <class Output>
Status write_checked(const Destination& target, const std::string& asked, Written written,
                     const Output& output) {
  if (!(output.options.chord > 0) || !std::isfinite(output.options.chord))
    return Error{ErrorCode::invalid_option, "chord is not a positive number", in_file(target.path)};
  written.kind = Output::kind;
  written.crs_wkt = output.document.crs_wkt;
  written.unit = output.document.unit;
  written.overwrite = output.options.overwrite;
  written.layer = output.options.layer;
  return write_document(target, asked, written, output);
}

/// Puts a file in its place. Of a shapefile that was there nothing stays: not its indices, nor a
/// reference system that the new one does not have.
Status commit_whole(PendingFile& pending) {
  namespace fs = std::filesystem;
  std::vector<fs::path> stale;
  std::error_code ignored;
  if (format_name(pending.target()) == "shp")
    for (const char* part : {".shx", ".dbf", ".prj", ".cpg", ".qix", ".sbn", ".sbx", ".qpj", ".SHX",
                             ".DBF", ".PRJ", ".CPG", ".QIX", ".SBN", ".SBX", ".QPJ"})
      if (!fs::exists(fs::path(pending.path()).replace_extension(part), ignored))
        stale.push_back(fs::path(pending.target()).replace_extension(part));
  Status done = pending.commit();
  if (done)
    for (const fs::path& part : stale) fs::remove(part, ignored);
  return done;
}

}  // namespace

Status write_target(const Destination& destination, const std::string& asked,
                    const Written& written,
                    const std::function<Status(Target&, const Format&)>& write) {
  const std::string& path = destination.path;
  Target target;
  if (written.crs_wkt.empty()) target.unit = name_of(written.unit);
  target.format = path == "-" && asked.empty() ? written.format : format_name(path, asked);
  const Result<const Format*> found = find_format(target.format, written.kind);
  if (!found) return Error{found.error().code, found.error().text, in_file(path)};
  const Format* format = *found;
  if (format == nullptr)
    return Error{ErrorCode::unsupported,
                 fmt::format("'{}' is not a format that can be written here; use one of {}",
                             target.format, formats_of(written.kind)),
                 in_file(path)};
  target.tables = format->tables;
  const bool stream = is_stream(path);
  target.name = stream ? written.name : std::filesystem::path(path).stem().string();
  const auto fill = [&]() -> Status {
    if (format->geographic) {
      Result<OutputCrs> crs = output_crs_of(written.crs_wkt, written.unit);
      if (!crs) return std::move(crs).error();
      target.crs = std::move(*crs);
    }
    Status done = write(target, *format);
    return target.status() ? done : target.status();
  };
  if (!format->own_files || stream)
    return write_whole(destination, [&](OutputStream& out) {
      target.out = &out;
      return fill();
    });
  return guarded(path, [&]() -> Status {
    Result<PendingFile> pending = PendingFile::create(path);
    if (!pending) return std::move(pending).error();
    target.path = pending->path();
    target.overwrite = written.overwrite;
    target.layer = written.layer;
    std::unique_ptr<Addition> addition;
    std::error_code ignored;
    const bool adds = format->begin_addition != nullptr;
    if (adds && std::filesystem::exists(path, ignored)) {
      auto begun = format->begin_addition(path, target.path);
      if (!begun) return std::move(begun).error();
      addition = std::move(*begun);
    }
    if (Status filled = fill(); !filled) return filled;
    if (addition) return addition->commit();
    return adds ? pending->commit_new() : commit_whole(*pending);
  });
}

Status write_axes(const Destination& target, const std::string& format,
                  const Document<AxisItem>& file, const WriteOptions& options) {
  return write_checked(target, format, {{}, "json"}, AxesOutput{file, options});
}

Status write_shapes(const Destination& target, const std::string& format,
                    const Document<ShapeItem>& file, const WriteOptions& options) {
  return write_checked(target, format, {{}, "json"}, ShapesOutput{file, options});
}

Status write_voronoi(const Destination& target, const std::string& format,
                     const Document<VoronoiItem>& file, const WriteOptions& options) {
  return write_checked(target, format, {{}, "json"}, VoronoiOutput{file, options});
}

Status write_offsets(const Destination& target, const std::string& format,
                     const Document<OffsetItem>& file, const WriteOptions& options) {
  return write_checked(target, format, {{}, "json"}, OffsetsOutput{file, options});
}

Status write_carving(const Destination& target, const std::string& format,
                     const Document<CarveItem>& file, const MachineOptions& machine,
                     const WriteOptions& options) {
  for (const double value :
       {machine.safe, machine.rapid, machine.carving.feed, machine.carving.plunge,
        machine.clearing.feed, machine.clearing.plunge})
    if (!(value > 0) || !std::isfinite(value) || !(machine.chord >= 0))
      return Error{ErrorCode::invalid_option, "heights, feeds and chords must be positive", {}};
  return write_checked(target, format, {{}, "nc"}, CarvingOutput{{file, options}, machine});
}

Status write_features(const Destination& target, const std::string& format,
                      const Document<AxisItem>& axes, std::span<const AxisFeatures> features,
                      const FeatureWriteOptions& options) {
  return write_checked(target, format, {{}, "json", "features"},
                       FeaturesOutput{{axes, options.write}, features, options});
}

Status write_layers(const Destination& target, const std::string& format,
                    const Document<Layer>& layers, const Document<AxisItem>& background,
                    const WriteOptions& options) {
  return write_checked(target, format, {{}, "geojson"},
                       LayersOutput{{layers, options}, background});
}

Status write_field(const std::string& path, const std::string& format,
                   std::span<const Shape> shapes, std::span<const PotentialField> fields,
                   const FieldPictureOptions& options) {
  return write_document(path, format, {FieldOutput::kind, "svg", "medial", {}, options.unit},
                        FieldOutput{shapes, fields, options});
}

Status write_voxels(const std::string& path, const std::string& format, const VoxelAxis& axis,
                    const Solid& solid, double width) {
  return write_document(path, format, {VoxelsOutput::kind, "ply"},
                        VoxelsOutput{axis, solid, width});
}

Status write_distances(const std::string& path, const DistanceMap& distances,
                       const ImageFile& source, const DistanceFormat& format) {
  return write_document(path, {}, {DistancesOutput::kind, "pgm"},
                        DistancesOutput{distances, source, format});
}

Status write_image(const std::string& path, const std::string& format, const Image& image,
                   const ImageFile& source) {
  return write_document(path, format, {ImageOutput::kind, "pbm"}, ImageOutput{image, source});
}

}  // namespace medial::io
