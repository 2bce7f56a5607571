#include "io/tables.h"

#include <cpl_conv.h>
#include <fmt/format.h>

#include "io/gdal_support.h"
#include "io/gdal_target.h"
#include "io/geojson.h"
#include "io/gpkg_tables.h"
#include "io/guarded.h"

namespace medial::io {

namespace {

/// Makes the file of a path; one below /vsimem/ is in memory.
Status make_file(const std::string& path, const std::string& format, const OutputCrs& crs,
                 const TableSource& source) {
  return format == "gpkg" ? write_gpkg(path, crs, source)
                          : write_by_gdal(path, format, crs, source);
}

Status put_stream(OutputStream& out, const std::string& path, const std::string& format,
                  const std::string& name, const TableSource& source) {
  const Result<OutputCrs> crs = OutputCrs::make(source.crs_wkt);
  if (!crs) return crs.error();
  const std::string own = is_stream(path) ? name : std::string(CPLGetBasename(path.c_str()));
  if (format == "geojson") return put_geojson(out, own, *crs, source);
  return put_gdal_file(out, own, format, [&](const std::string& made) {
    return make_file(made, format, *crs, source);
  });
}

}  // namespace

bool holds_tables(const std::string& format) {
  return format == "geojson" || format == "gpkg" || format == "shp" || format == "fgb";
}

Status write_tables(const std::string& path, const std::string& format, const std::string& name,
                    const TableSource& source) {
  if ((format == "gpkg" || format == "shp") && !is_stream(path)) {
    return guarded(path, [&]() -> Status {
      const Result<OutputCrs> crs = OutputCrs::make(source.crs_wkt);
      if (!crs) return crs.error();
      Result<PendingFile> pending = PendingFile::create(path);
      if (!pending) return std::move(pending).error();
      Status made = make_file(pending->path(), format, *crs, source);
      return made ? pending->commit() : made;
    });
  }
  return write_whole(
      path, [&](OutputStream& out) { return put_stream(out, path, format, name, source); });
}

}  // namespace medial::io
