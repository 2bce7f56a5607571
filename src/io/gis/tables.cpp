#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "io/gis/gdal_support.h"
#include "io/gis/make_file.h"
#include "medial/document.h"

namespace medial::io {

namespace {

const char* driver_of(const std::string& format) {
  if (format == "gpkg") return "GPKG";
  return format == "shp" ? "ESRI Shapefile" : "FlatGeobuf";
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
  GdalTables(Target& target, const TableSource& source, GDALDataset& dataset,
             const GdalMessages& messages)
      : TableSink(target), source_(source), messages_(messages) {
    const int count = dataset.GetLayerCount(), own = static_cast<int>(source.tables.size());
    for (int i = count - own; i < count; ++i) layers_.push_back(dataset.GetLayer(i));
  }

 private:
  Status put(std::size_t table, std::span<const Value> first, std::span<const Value> rest,
             std::span<std::vector<Vec2>> parts) override {
    OGRFeature feature(layers_[table]->GetLayerDefn());
    int field = 0;
    for (const auto values : {first, rest})
      for (const Value& value : values) set(feature, field++, value);
    feature.SetGeometryDirectly(geometry_of(source_.tables[table].kind, parts).release());
    if (layers_[table]->CreateFeature(&feature) != OGRERR_NONE) return cannot_write(messages_);
    return success();
  }

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
  const GdalMessages& messages_;
  std::vector<OGRLayer*> layers_;
};

/// Layers of the same name as a table go, if they may.
Status make_room(GDALDataset& dataset, const Target& target, const TableSource& source) {
  for (const Table& table : source.tables) {
    for (int i = dataset.GetLayerCount(); i-- > 0;) {
      if (!EQUAL(dataset.GetLayer(i)->GetName(), table.name.c_str())) continue;
      if (!target.overwrite)
        return Error{
            ErrorCode::unwritable,
            fmt::format("the file has a layer '{}' already; --overwrite replaces it", table.name),
            {}};
      if (dataset.DeleteLayer(i) != OGRERR_NONE)
        return Error{ErrorCode::unwritable,
                     fmt::format("the layer '{}' cannot be replaced", table.name),
                     {}};
    }
  }
  return success();
}

/// Null where there is none.
std::unique_ptr<OGRSpatialReference> reference_of(const OutputCrs& crs) {
  auto reference = std::make_unique<OGRSpatialReference>();
  if (!crs.wkt.empty()) {
    if (reference->importFromWkt(crs.wkt.c_str()) != OGRERR_NONE) return nullptr;
    reference->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
  }
  if (!(millimetres(crs.unit) > 0)) return nullptr;
  reference->SetLocalCS("plane");
  reference->SetLinearUnits(name_of(crs.unit), 1e-3 * millimetres(crs.unit));
  return reference;
}

Status create_layers(GDALDataset& dataset, const Target& target, const TableSource& source,
                     const GdalMessages& messages) {
  const bool several = target.format == "gpkg";
  // An index is left to who reads: row by row it takes three times as long as all else.
  std::array<char, 17> no_index{"SPATIAL_INDEX=NO"};
  std::array<char*, 2> options{no_index.data(), nullptr};
  const auto reference = reference_of(target.crs);
  for (const Table& table : source.tables) {
    OGRLayer* layer =
        dataset.CreateLayer((several ? table.name : target.name).c_str(), reference.get(),
                            type_of(table.kind), several ? options.data() : nullptr);
    if (layer == nullptr) return cannot_write(messages);
    for (const Column& column : table.columns) {
      OGRFieldDefn field(column.name.c_str(), type_of(column.type));
      if (layer->CreateField(&field) != OGRERR_NONE) return cannot_write(messages);
    }
  }
  return success();
}

/// A dataset with its layers and what fills them.
Status make_dataset(const std::string& path, Target& target, const TableSource& source) {
  register_gdal();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_of(target.format));
  if (driver == nullptr)
    return Error{
        ErrorCode::unsupported, fmt::format("this GDAL cannot write {}", target.format), {}};
  const GdalMessages messages;
  const bool adds = target.adds_to_file && std::filesystem::exists(path);
  GDALDatasetUniquePtr dataset(
      adds
          ? GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE | GDAL_OF_VERBOSE_ERROR)
          : driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset) return cannot_write(messages);
  if (Status room = adds ? make_room(*dataset, target, source) : success(); !room) return room;
  if (Status created = create_layers(*dataset, target, source, messages); !created) return created;
  GdalTables tables(target, source, *dataset, messages);
  const bool transactions = dataset->TestCapability(ODsCTransactions) != 0;
  if (transactions) dataset->StartTransaction();
  if (Status filled = source.fill(tables); !filled) return filled;
  if (transactions) dataset->CommitTransaction();  // a failure is among the messages
  dataset.reset();                                 // closing writes, too
  return messages.failure().empty() ? success() : cannot_write(messages);
}

Status put_gdal_tables(Target& target, const TableSource& source) {
  if (source.tables.size() != 1 && target.format != "gpkg")
    return Error{ErrorCode::unsupported,
                 fmt::format(".{} holds one layer only, and there are {}; .gpkg and .geojson hold "
                             "several",
                             target.format, source.tables.size()),
                 {}};
  if (target.out != nullptr && target.format == "shp")
    return Error{
        ErrorCode::unsupported, "a shapefile is several files and cannot go to a stream", {}};
  return make_file(target,
                   [&](const std::string& path) { return make_dataset(path, target, source); });
}

}  // namespace

Status make_file(Target& target, const std::function<Status(const std::string&)>& make) {
  if (target.out == nullptr) return make(target.path);
  const auto folder = std::filesystem::temp_directory_path();
  Result<PendingFile> made =
      PendingFile::create((folder / (target.name + "." + target.format)).string());
  if (!made) return std::move(made).error();
  if (Status status = make(made->path()); !status) return status;
  std::ifstream file(made->path(), std::ios::binary);
  std::array<char, 65536> bytes{};
  while (file.read(bytes.data(), bytes.size()) || file.gcount() > 0)
    target.out->put(std::string_view(bytes.data(), static_cast<std::size_t>(file.gcount())));
  return file.bad() ? Status(Error{ErrorCode::unwritable, "cannot read what was made", {}})
                    : success();
}

Format gpkg_format() {
  Format format{".gpkg"};
  format.own_files = format.adds_layers = true;
  return with_tables<put_gdal_tables>(format);
}

Format shp_format() {
  Format format{".shp"};
  format.own_files = true;
  return with_tables<put_gdal_tables>(format);
}

Format fgb_format() { return with_tables<put_gdal_tables>(Format{".fgb"}); }

}  // namespace medial::io
