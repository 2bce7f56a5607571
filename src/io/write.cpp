#include "medial/io/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "io/dxf_writer.h"
#include "io/format_name.h"
#include "io/gdal_support.h"
#include "io/gdal_writer.h"
#include "io/guarded.h"
#include "io/native.h"
#include "io/output.h"
#include "io/picture.h"
#include "io/place.h"
#include "io/table_writer.h"

namespace medial::io {

namespace {

using namespace std::string_view_literals;
constexpr std::array formats{"json"sv, "geojson"sv, "gpkg"sv, "shp"sv, "fgb"sv, "wkt"sv, "csv"sv,
#ifdef MEDIAL_DXF
                             "dxf"sv,
#endif
                             "svg"sv,  "pdf"sv,     "png"sv,  "ps"sv};

bool through_gdal(const std::string& format) {
  return format == "geojson" || format == "gpkg" || format == "shp" || format == "fgb";
}

/// The format by the option or, without one, by the extension.
Result<std::string> format_of(const std::string& path, const std::string& option) {
  const std::string format = path == "-" && option.empty() ? "json" : format_name(path, option);
  if (std::ranges::find(formats, format) != formats.end()) return format;
  return Error{
      ErrorCode::unsupported,
      fmt::format("'{}' is no format to write; known are {}", format, known_output_formats()),
      in_file(path)};
}

Status write_stream(OutputStream& out, const std::string& format, const NativeFile& file,
                    const WriteOptions& options) {
  Status status = success();
  if (format == "json") {
    status = write_native(out, file);
  } else if (format == "csv") {
    write_csv(out, file, options);
  } else if (format == "wkt") {
    write_wkt(out, file, options);
#ifdef MEDIAL_DXF
  } else if (format == "dxf") {
    status = write_dxf(out, file, options);
#endif
  } else {
    status = write_picture(out, format, file, options);
  }
  if (!status) return status;
  return out.finish();
}

Status write_gdal_stream(OutputStream& out, const std::string& format, const NativeFile& file,
                         const WriteOptions& options) {
  Status status = put_gdal_file(out, "medial", format, [&](const std::string& name) {
    return write_gdal(name, format, file, options);
  });
  return status ? out.finish() : status;
}

Status write_any(const std::string& path, const std::string& option, const NativeFile& file,
                 const WriteOptions& options) {
  Result<std::string> format = format_of(path, option);
  if (!format) return format.error();
  if (!(options.chord > 0) || !std::isfinite(options.chord)) {
    return Error{ErrorCode::invalid_option, "chord is not a positive number", {}};
  }
  if (is_stream(path)) {
    Result<OutputStream> out = OutputStream::open(path);
    if (!out) return out.error();
    return through_gdal(*format) ? write_gdal_stream(*out, *format, file, options)
                                 : write_stream(*out, *format, file, options);
  }
  Result<PendingFile> pending = PendingFile::create(path);
  if (!pending) return pending.error();
  if (*format == "gpkg" || *format == "shp") {
    if (Status status = write_gdal(pending->path(), *format, file, options); !status) return status;
  } else {
    Result<OutputStream> out = OutputStream::open(pending->path());
    if (!out) return out.error();
    Status status = through_gdal(*format) ? write_gdal_stream(*out, *format, file, options)
                                          : write_stream(*out, *format, file, options);
    if (!status) return status;
  }
  return pending->commit();
}

}  // namespace

std::string known_output_formats() { return fmt::format(".{}", fmt::join(formats, " .")); }

Status write_axes(const std::string& path, const std::string& format, const NativeFile& file,
                  const WriteOptions& options) {
  return guarded(path, [&] { return write_any(path, format, file, options); });
}

}  // namespace medial::io
