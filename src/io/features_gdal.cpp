#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <memory>
#include <optional>

#include "io/features_writer.h"
#include "io/gdal_support.h"
#include "io/place.h"
#include "io/table_writer.h"
#include "medial/io/projection.h"

namespace medial::io {

namespace {

const char* driver_of(const std::string& format) {
  if (format == "geojson") return "GeoJSON";
  if (format == "gpkg") return "GPKG";
  if (format == "shp") return "ESRI Shapefile";
  return "FlatGeobuf";
}

OGRFieldType type_of(ColumnType type) {
  switch (type) {
    case ColumnType::whole:
      return OFTInteger64;
    case ColumnType::real:
      return OFTReal;
    case ColumnType::text:
      break;
  }
  return OFTString;
}

class FeaturesGdalWriter {
 public:
  FeaturesGdalWriter(const NativeFile& axes, std::span<const AxisFeatures> features,
                     const FeatureWriteOptions& options, std::string shown)
      : axes_(axes), features_(features), options_(options), shown_(std::move(shown)) {}

  Status write(const std::string& path, const std::string& format) {
    register_gdal();
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_of(format));
    if (driver == nullptr)
      return Error{ErrorCode::unsupported, fmt::format("this GDAL cannot write {}", format), {}};
    if (Status status = prepare_crs(); !status) return status;
    const GdalMessages messages;
    GDALDatasetUniquePtr target(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    if (!target) return failed(messages);
    const bool transactions = target->TestCapability(ODsCTransactions) != 0;
    if (transactions) target->StartTransaction();
    if (format == "gpkg") {
      for (const FeatureTable table :
           {FeatureTable::runs, FeatureTable::branches, FeatureTable::points})
        if (Status status = write_layer(*target, table, name_of(table), messages); !status)
          return status;
    } else {
      // The only layer of a file that holds one is named after the file.
      const std::string name = CPLGetBasename(target->GetDescription());
      if (Status status = write_layer(*target, options_.table, name, messages); !status)
        return status;
    }
    if (transactions && target->CommitTransaction() != OGRERR_NONE) return failed(messages);
    target.reset();  // closing writes, too
    return messages.failure().empty() ? success() : failed(messages);
  }

 private:
  Status failed(const GdalMessages& messages) const {
    return Error{ErrorCode::unwritable, "cannot write: " + messages.failure(), in_file(shown_)};
  }

  Status prepare_crs() {
    std::string wkt = axes_.crs_wkt;
    if (is_local_projection(wkt)) {
      Result<BackToGeographic> back = BackToGeographic::make(wkt);
      if (!back) return back.error();
      back_ = std::move(*back);
      wkt = back_->crs_wkt();
    }
    const GdalMessages messages;
    if (!wkt.empty() && crs_.importFromWkt(wkt.c_str()) == OGRERR_NONE) {
      crs_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
      has_crs_ = true;
    }
    return success();
  }

  Status write_layer(GDALDataset& target, FeatureTable table, const std::string& name,
                     const GdalMessages& messages) {
    const bool points = table == FeatureTable::points;
    OGRLayer* layer = target.CreateLayer(name.c_str(), has_crs_ ? &crs_ : nullptr,
                                         points ? wkbPoint : wkbLineString, nullptr);
    if (layer == nullptr) return failed(messages);
    for (const TableColumn& column : columns_of(table)) {
      OGRFieldDefn field(column.name, type_of(column.type));
      if (layer->CreateField(&field) != OGRERR_NONE) return failed(messages);
    }
    for (std::size_t i = 0; i < features_.size(); ++i) {
      const NativeItem& item = axes_.items[i];
      for (TableRow& row :
           rows_of(table, i, item.axis, features_[i], chord_of(item, options_.write))) {
        if (Status status = write_row(*layer, row, points, messages); !status) return status;
      }
    }
    return success();
  }

  Status write_row(OGRLayer& layer, TableRow& row, bool point, const GdalMessages& messages) {
    if (back_) {
      if (Status status = back_->transform(row.points); !status) return status;
    }
    OGRFeature feature(layer.GetLayerDefn());
    for (int k = 0; k < static_cast<int>(row.values.size()); ++k) {
      const Value& value = row.values[static_cast<std::size_t>(k)];
      if (const auto* number = std::get_if<std::int64_t>(&value)) {
        feature.SetField(k, static_cast<GIntBig>(*number));
      } else if (const auto* decimal = std::get_if<double>(&value)) {
        feature.SetField(k, *decimal);
      } else if (const auto* words = std::get_if<std::string>(&value)) {
        feature.SetField(k, words->c_str());
      } else {
        feature.SetFieldNull(k);
      }
    }
    if (point) {
      feature.SetGeometryDirectly(new OGRPoint(row.points[0].x, row.points[0].y));
    } else {
      auto line = std::make_unique<OGRLineString>();
      line->setNumPoints(static_cast<int>(row.points.size()), FALSE);
      for (std::size_t k = 0; k < row.points.size(); ++k)
        line->setPoint(static_cast<int>(k), row.points[k].x, row.points[k].y);
      feature.SetGeometryDirectly(line.release());
    }
    if (layer.CreateFeature(&feature) != OGRERR_NONE) return failed(messages);
    return success();
  }

  const NativeFile& axes_;
  std::span<const AxisFeatures> features_;
  const FeatureWriteOptions& options_;
  std::string shown_;
  OGRSpatialReference crs_;
  bool has_crs_ = false;
  std::optional<BackToGeographic> back_;
};

}  // namespace

Status write_features_gdal(const std::string& path, const std::string& format,
                           const NativeFile& axes, std::span<const AxisFeatures> features,
                           const FeatureWriteOptions& options) {
  return FeaturesGdalWriter(axes, features, options, path).write(path, format);
}

}  // namespace medial::io
