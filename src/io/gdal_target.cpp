#include "io/gdal_target.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "io/gdal_support.h"
#include "io/tables.h"

namespace medial::io {

namespace {

const char* driver_of(const std::string& format) {
  if (format == "gpkg") return "GPKG";
  if (format == "shp") return "ESRI Shapefile";
  return "FlatGeobuf";
}

/// An unwritable file, in GDAL's words.
Error cannot_write(const GdalMessages& messages) {
  return {ErrorCode::unwritable, "cannot write: " + messages.failure(), {}};
}

OGRFieldType type_of(ColumnType type) {
  return type == ColumnType::whole ? OFTInteger64 : type == ColumnType::real ? OFTReal : OFTString;
}

OGRwkbGeometryType type_of(GeometryKind kind) {
  if (kind == GeometryKind::point) return wkbPoint;
  return kind == GeometryKind::line ? wkbLineString : wkbPolygon;
}

void set_points(OGRSimpleCurve& curve, const std::vector<Vec2>& points) {
  curve.setNumPoints(static_cast<int>(points.size()), FALSE);
  for (std::size_t i = 0; i < points.size(); ++i)
    curve.setPoint(static_cast<int>(i), points[i].x, points[i].y);
}

std::unique_ptr<OGRGeometry> geometry_of(GeometryKind kind,
                                         std::span<const std::vector<Vec2>> parts) {
  if (kind == GeometryKind::point) return std::make_unique<OGRPoint>(parts[0][0].x, parts[0][0].y);
  if (kind == GeometryKind::line) {
    auto line = std::make_unique<OGRLineString>();
    set_points(*line, parts[0]);
    return line;
  }
  auto polygon = std::make_unique<OGRPolygon>();
  for (const auto& part : parts) {
    auto ring = std::make_unique<OGRLinearRing>();
    set_points(*ring, part);
    ring->closeRings();
    polygon->addRingDirectly(ring.release());
  }
  return polygon;
}

class GdalTables final : public TableSink {
 public:
  GdalTables(const TableSource& source, const OutputCrs& crs, const GdalMessages& messages)
      : source_(source), crs_(crs), messages_(messages) {}

  Status create_layers(GDALDataset& target, const std::string& format) {
    for (const Table& table : source_.tables) {
      const std::string name =
          format == "gpkg" ? table.name : CPLGetBasename(target.GetDescription());
      OGRLayer* layer =
          target.CreateLayer(name.c_str(), crs_.reference(), type_of(table.kind), nullptr);
      if (layer == nullptr) return cannot_write(messages_);
      for (const Column& column : table.columns) {
        OGRFieldDefn field(column.name.c_str(), type_of(column.type));
        if (layer->CreateField(&field) != OGRERR_NONE) return cannot_write(messages_);
      }
      layers_.push_back(layer);
    }
    return success();
  }

  Status add(std::size_t table, std::span<const Value> first, std::span<const Value> rest,
             std::span<std::vector<Vec2>> parts) override {
    for (std::vector<Vec2>& part : parts)
      if (Status placed = crs_.transform(part); !placed) return placed;
    OGRFeature feature(layers_[table]->GetLayerDefn());
    int field = 0;
    for (const auto values : {first, rest}) {
      for (const Value& value : values) {
        set(feature, field, value);
        ++field;
      }
    }
    feature.SetGeometryDirectly(geometry_of(source_.tables[table].kind, parts).release());
    if (layers_[table]->CreateFeature(&feature) != OGRERR_NONE) return cannot_write(messages_);
    return success();
  }

 private:
  static void set(OGRFeature& feature, int field, const Value& value) {
    if (const auto* number = std::get_if<std::int64_t>(&value)) {
      feature.SetField(field, static_cast<GIntBig>(*number));
    } else if (const auto* decimal = std::get_if<double>(&value)) {
      feature.SetField(field, *decimal);
    } else if (const auto* words = std::get_if<std::string>(&value)) {
      feature.SetField(field, words->c_str());
    } else {
      feature.SetFieldNull(field);
    }
  }

  const TableSource& source_;
  const OutputCrs& crs_;
  const GdalMessages& messages_;
  std::vector<OGRLayer*> layers_;
};

/// A dataset with its layers, and what `put` puts into it.
template <class Put>
Status make_dataset(const std::string& path, const std::string& format, const OutputCrs& crs,
                    const TableSource& source, const Put& put) {
  register_gdal();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_of(format));
  if (driver == nullptr)
    return Error{ErrorCode::unsupported, fmt::format("this GDAL cannot write {}", format), {}};
  const GdalMessages messages;
  GDALDatasetUniquePtr target(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!target) return cannot_write(messages);
  GdalTables tables(source, crs, messages);
  if (Status created = tables.create_layers(*target, format); !created) return created;
  if (Status filled = put(*target, tables); !filled) return filled;
  target.reset();  // closing writes, too
  return messages.failure().empty() ? success() : cannot_write(messages);
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

Status create_by_gdal(const std::string& path, const std::string& format, const OutputCrs& crs,
                      const TableSource& source) {
  return make_dataset(path, format, crs, source,
                      [](GDALDataset&, GdalTables&) { return success(); });
}

Status write_by_gdal(const std::string& path, const std::string& format, const OutputCrs& crs,
                     const TableSource& source) {
  return make_dataset(path, format, crs, source,
                      [&source](GDALDataset& target, GdalTables& tables) {
                        const bool transactions = target.TestCapability(ODsCTransactions) != 0;
                        if (transactions) target.StartTransaction();
                        if (Status filled = source.fill(tables); !filled) return filled;
                        if (transactions)
                          target.CommitTransaction();  // a failure is among the messages
                        return success();
                      });
}

}  // namespace medial::io
