#include "io/gdal_target.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "io/gdal_support.h"
#include "io/guarded.h"

namespace medial::io {

namespace {

const char* driver_of(const std::string& format) {
  if (format == "geojson") return "GeoJSON";
  if (format == "gpkg") return "GPKG";
  if (format == "shp") return "ESRI Shapefile";
  return "FlatGeobuf";
}

}  // namespace

OutputCrs::OutputCrs() = default;
OutputCrs::~OutputCrs() = default;
OutputCrs::OutputCrs(OutputCrs&&) noexcept = default;

Result<OutputCrs> OutputCrs::make(const std::string& crs_wkt) {
  OutputCrs result;
  std::string wkt = crs_wkt;
  if (is_local_projection(wkt)) {
    Result<BackToGeographic> back = BackToGeographic::make(wkt);
    if (!back) return std::move(back).error();
    result.back_ = std::move(*back);
    wkt = result.back_->crs_wkt();
  }
  if (wkt.empty()) return result;
  const GdalMessages messages;
  auto reference = std::make_unique<OGRSpatialReference>();
  if (reference->importFromWkt(wkt.c_str()) != OGRERR_NONE) return result;
  reference->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  result.reference_ = std::move(reference);
  return result;
}

Status OutputCrs::transform(std::vector<Vec2>& points) const {
  return back_ ? back_->transform(points) : success();
}

Status OutputCrs::transform(std::vector<Disk>& disks) const {
  if (!back_) return success();
  std::vector<Vec2> points;
  points.reserve(disks.size());
  for (const Disk& disk : disks) points.push_back(disk.center);
  if (Status done = back_->transform(points); !done) return done;
  for (std::size_t i = 0; i < disks.size(); ++i) disks[i].center = points[i];
  return success();
}

bool through_gdal(const std::string& format) {
  return format == "geojson" || format == "gpkg" || format == "shp" || format == "fgb";
}

Error cannot_write(const GdalMessages& messages) {
  return {ErrorCode::unwritable, "cannot write: " + messages.failure(), {}};
}

Status write_dataset(
    const std::string& path, const std::string& format,
    const std::function<Status(GDALDataset& target, const GdalMessages& messages)>& fill) {
  register_gdal();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_of(format));
  if (driver == nullptr)
    return Error{ErrorCode::unsupported, fmt::format("this GDAL cannot write {}", format), {}};
  const GdalMessages messages;
  GDALDatasetUniquePtr target(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!target) return cannot_write(messages);
  const bool transactions = target->TestCapability(ODsCTransactions) != 0;
  if (transactions) target->StartTransaction();
  if (Status filled = fill(*target, messages); !filled) return filled;
  if (transactions && target->CommitTransaction() != OGRERR_NONE) return cannot_write(messages);
  target.reset();  // closing writes, too
  return messages.failure().empty() ? success() : cannot_write(messages);
}

void set_points(OGRSimpleCurve& curve, const std::vector<Vec2>& points) {
  curve.setNumPoints(static_cast<int>(points.size()), FALSE);
  for (std::size_t i = 0; i < points.size(); ++i)
    curve.setPoint(static_cast<int>(i), points[i].x, points[i].y);
}

Status write_file(const std::string& path, const std::string& format, const std::string& name,
                  const std::function<Status(const std::string& path)>& make,
                  const std::function<Status(OutputStream& out)>& put) {
  const bool several_files_or_seeks = format == "gpkg" || format == "shp";
  if (several_files_or_seeks && !is_stream(path)) {
    return guarded(path, [&]() -> Status {
      Result<PendingFile> pending = PendingFile::create(path);
      if (!pending) return std::move(pending).error();
      if (Status made = make(pending->path()); !made) return made;
      return pending->commit();
    });
  }
  return write_whole(path, [&](OutputStream& out) -> Status {
    return through_gdal(format) ? put_gdal_file(out, name, format, make) : put(out);
  });
}

}  // namespace medial::io
