#include "medial/io/write.h"

#include <cmath>

#include "io/axis_tables.h"
#include "io/dxf_writer.h"
#include "io/native.h"
#include "io/picture.h"
#include "io/place.h"
#include "io/table_writer.h"

namespace medial::io {

namespace {

#ifdef MEDIAL_DXF
constexpr char axis_formats[] = ".json .geojson .gpkg .shp .fgb .wkt .csv .dxf .svg .pdf .png .ps";
#else
constexpr char axis_formats[] = ".json .geojson .gpkg .shp .fgb .wkt .csv .svg .pdf .png .ps";
#endif

Status put_axes(OutputStream& out, const std::string& format, const Document<AxisItem>& file,
                const WriteOptions& options) {
  if (format == "json") return write_native(out, file);
  if (format == "csv") return write_csv(out, file, options);
  if (format == "wkt") return write_wkt(out, file, options);
#ifdef MEDIAL_DXF
  if (format == "dxf") return write_dxf(out, file, options);
#endif
  return write_picture(out, format, file, options);
}

}  // namespace

std::string known_output_formats() { return axis_formats; }

Status write_axes(const std::string& path, const std::string& format,
                  const Document<AxisItem>& file, const WriteOptions& options) {
  const Result<std::string> known = output_format(path, format, "json", axis_formats);
  if (!known) return known.error();
  if (!(options.chord > 0) || !std::isfinite(options.chord))
    return Error{ErrorCode::invalid_option, "chord is not a positive number", in_file(path)};
  if (holds_tables(*known))
    return write_tables(path, *known, "medial", axis_tables(file, *known, options));
  return write_whole(path, [&](OutputStream& out) { return put_axes(out, *known, file, options); });
}

}  // namespace medial::io
