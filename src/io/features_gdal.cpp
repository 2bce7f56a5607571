#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <memory>
#include <optional>

#include "io/features_writer.h"
#include "io/gdal_columns.h"
#include "io/gdal_support.h"
#include "io/gdal_target.h"
#include "io/gpkg_index.h"
#include "io/table_writer.h"

namespace medial::io {

namespace {

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

/// The input's attributes, named apart from the columns of every table.
AttributeColumns attribute_columns(const NativeFile& axes) {
  std::vector<const Attributes*> items;
  for (const NativeItem& item : axes.items) items.push_back(&item.attributes);
  std::vector<std::string> own;
  for (const FeatureTable table :
       {FeatureTable::runs, FeatureTable::branches, FeatureTable::points})
    for (const TableColumn& column : columns_of(table)) own.emplace_back(column.name);
  return {items, own};
}

class FeaturesGdalWriter {
 public:
  FeaturesGdalWriter(const NativeFile& axes, std::span<const AxisFeatures> features,
                     const FeatureWriteOptions& options, const OutputCrs& crs)
      : axes_(axes),
        features_(features),
        options_(options),
        crs_(crs),
        attributes_(attribute_columns(axes)) {}

  Status write_layer(GDALDataset& target, FeatureTable table, const std::string& name,
                     const GdalMessages& messages) {
    const bool points = table == FeatureTable::points;
    const bool indexed = has_gpkg_index(target);
    OGRLayer* layer =
        target.CreateLayer(name.c_str(), crs_.reference(), points ? wkbPoint : wkbLineString,
                           indexed ? without_index() : nullptr);
    if (layer == nullptr) return cannot_write(messages);
    for (const TableColumn& column : columns_of(table)) {
      OGRFieldDefn field(column.name, type_of(column.type));
      if (layer->CreateField(&field) != OGRERR_NONE) return cannot_write(messages);
    }
    if (!attributes_.create_in(*layer)) return cannot_write(messages);
    std::optional<GpkgIndex> index;
    if (indexed) index.emplace(target, *layer);
    for (std::size_t i = 0; i < features_.size(); ++i) {
      const NativeItem& item = axes_.items[i];
      for (TableRow& row :
           rows_of(table, i, item.axis, features_[i], chord_of(item, options_.write))) {
        if (Status status = write_row(*layer, row, item.attributes, points, index, messages);
            !status)
          return status;
      }
    }
    return index ? index->write(messages) : success();
  }

 private:
  Status write_row(OGRLayer& layer, TableRow& row, const Attributes& attributes, bool point,
                   std::optional<GpkgIndex>& index, const GdalMessages& messages) {
    if (Status status = crs_.transform(row.points); !status) return status;
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
    attributes_.set(feature, static_cast<int>(row.values.size()), attributes);
    if (point) {
      feature.SetGeometryDirectly(new OGRPoint(row.points[0].x, row.points[0].y));
    } else {
      auto line = std::make_unique<OGRLineString>();
      set_points(*line, row.points);
      feature.SetGeometryDirectly(line.release());
    }
    if (layer.CreateFeature(&feature) != OGRERR_NONE) return cannot_write(messages);
    if (index) index->add(feature.GetFID(), row.points);
    return success();
  }

  const NativeFile& axes_;
  std::span<const AxisFeatures> features_;
  const FeatureWriteOptions& options_;
  const OutputCrs& crs_;
  AttributeColumns attributes_;
};

}  // namespace

Status write_features_gdal(const std::string& path, const std::string& format,
                           const NativeFile& axes, std::span<const AxisFeatures> features,
                           const FeatureWriteOptions& options) {
  const Result<OutputCrs> crs = OutputCrs::make(axes.crs_wkt);
  if (!crs) return crs.error();
  FeaturesGdalWriter writer(axes, features, options, *crs);
  return write_dataset(path, format, [&](GDALDataset& target, const GdalMessages& messages) {
    if (format != "gpkg") {
      // The only layer of a file that holds one is named after the file.
      return writer.write_layer(target, options.table, CPLGetBasename(path.c_str()), messages);
    }
    for (const FeatureTable table :
         {FeatureTable::runs, FeatureTable::branches, FeatureTable::points})
      if (Status status = writer.write_layer(target, table, name_of(table), messages); !status)
        return status;
    return success();
  });
}

}  // namespace medial::io
