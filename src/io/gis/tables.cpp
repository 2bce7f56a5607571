#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <mutex>
#include <optional>
#include <sstream>

#include "io/gis/gdal_support.h"
#include "io/gis/make_file.h"
#include "io/gis/rows.h"
#include "io/gis/shared_database.h"
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

/// Runs work(), with GDAL's words for what it could not write.
template <class Work>
Status heard(const Work& work) {
  const GdalMessages messages;
  Status done = work();
  if (messages.failure().empty() || (!done && done.error().code != ErrorCode::unwritable))
    return done;
  return cannot_write(messages);
}

OGRFieldType type_of(ColumnType type) {
  return type == ColumnType::whole ? OFTInteger64 : type == ColumnType::real ? OFTReal : OFTString;
}

OGRwkbGeometryType type_of(GeometryKind kind) {
  if (kind == GeometryKind::point) return wkbPoint;
  return kind == GeometryKind::line ? wkbLineString : wkbPolygon;
}

constexpr std::size_t rows_together = 256;

void set_points(OGRSimpleCurve& curve, std::span<const OGRRawPoint> points) {
  curve.setPoints(static_cast<int>(points.size()), points.data());
}

/// Gives a feature the geometry of a row. Points and lines stay the same objects, row after row.
void set_geometry(OGRFeature& feature, GeometryKind kind, const Rows& rows, std::size_t row) {
  if (kind == GeometryKind::polygon) {
    auto polygon = std::make_unique<OGRPolygon>();
    for (std::size_t i = 0; i < rows.ring_count(row); ++i) {
      auto ring = std::make_unique<OGRLinearRing>();
      set_points(*ring, rows.ring(row, i));
      ring->closeRings();
      polygon->addRingDirectly(ring.release());
    }
    feature.SetGeometryDirectly(polygon.release());
    return;
  }
  if (feature.GetGeometryRef() == nullptr) {
    if (kind == GeometryKind::point) feature.SetGeometryDirectly(new OGRPoint);
    if (kind == GeometryKind::line) feature.SetGeometryDirectly(new OGRLineString);
  }
  const std::span<const OGRRawPoint> points = rows.ring(row, 0);
  if (kind == GeometryKind::line)
    return set_points(*feature.GetGeometryRef()->toLineString(), points);
  feature.GetGeometryRef()->toPoint()->setX(points[0].x);
  feature.GetGeometryRef()->toPoint()->setY(points[0].y);
}

/// What a layer is called: of formats with one layer like the file.
std::string layer_name(const Target& target, const Table& table, bool first) {
  if (target.format != "gpkg") return target.name;
  if (target.layer.empty()) return table.name;
  return first ? target.layer : target.layer + "_" + table.name;
}

/// Whether a layer has the columns of a table, whatever the input's attributes were.
bool has_columns_of(OGRLayer& layer, const Table& table) {
  return std::ranges::all_of(table.columns, [&layer](const Column& column) {
    return column.is_attribute || layer.GetLayerDefn()->GetFieldIndex(column.name.c_str()) >= 0;
  });
}

/// GDAL before 3.7 removes the triggers of a spatial index by names that newer GDALs no longer give
/// them: adds those that are missing. With the layer, SQLite removes all.
void complete_triggers(GDALDataset& dataset, OGRLayer& layer) {
  if (dataset.GetDriver() == nullptr || !EQUAL(dataset.GetDriver()->GetDescription(), "GPKG") ||
      layer.TestCapability(OLCFastSpatialFilter) == 0)
    return;
  const auto quoted = [](const std::string& name) {
    std::ostringstream text;
    text << std::quoted(name, '"', '"');
    return text.str();
  };
  for (const char* trigger : {"insert", "update1", "update2", "update3", "update4", "delete"})
    dataset.ExecuteSQL(
        fmt::format("CREATE TRIGGER IF NOT EXISTS {} AFTER DELETE ON {} BEGIN SELECT 1; END",
                    quoted(fmt::format("rtree_{}_{}_{}", layer.GetName(), layer.GetGeometryColumn(),
                                       trigger)),
                    quoted(layer.GetName()))
            .c_str(),
        nullptr, nullptr);
}

/// Removes layers of the same name as a table, if that was asked for: the first one, which the user
/// named, and of the others those that have our columns.
Status make_room(GDALDataset& dataset, const Target& target, const TableSource& source) {
  for (const Table& table : source.tables) {
    const bool first = &table == source.tables.data();
    const std::string name = layer_name(target, table, first);
    for (int i = dataset.GetLayerCount(); i-- > 0;) {
      OGRLayer& layer = *dataset.GetLayer(i);
      if (!EQUAL(layer.GetName(), name.c_str())) continue;
      if (!target.overwrite)
        return Error{ErrorCode::unwritable,
                     fmt::format("the file has a layer '{}' already; --overwrite replaces it, "
                                 "--output-layer gives the new one another name",
                                 name),
                     {}};
      if (!first && !has_columns_of(layer, table))
        return Error{ErrorCode::unwritable,
                     fmt::format("the file has a layer '{}' with other columns, which --overwrite "
                                 "leaves alone; --output-layer gives the new one another name",
                                 name),
                     {}};
      complete_triggers(dataset, layer);
      if (dataset.DeleteLayer(i) != OGRERR_NONE)
        return Error{
            ErrorCode::unwritable, fmt::format("the layer '{}' cannot be replaced", name), {}};
    }
  }
  return success();
}

/// Null where there is none.
std::unique_ptr<OGRSpatialReference> reference_of(const OutputCrs& crs, bool is_geopackage) {
  auto reference = std::make_unique<OGRSpatialReference>();
  if (!crs.wkt.empty()) {
    if (reference->importFromWkt(crs.wkt.c_str()) != OGRERR_NONE) return nullptr;
    reference->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
  }
  if (!(millimetres(crs.unit) > 0)) {
    // A GeoPackage without this name for "none" is taken to hold longitudes and latitudes.
    if (!is_geopackage || crs.unit != Unit::unknown) return nullptr;
    reference->SetLocalCS(no_reference);
    return reference;
  }
  reference->SetLocalCS("plane");
  reference->SetLinearUnits(name_of(crs.unit), 1e-3 * millimetres(crs.unit));
  return reference;
}

Status create_layers(GDALDataset& dataset, const Target& target, const TableSource& source,
                     const GdalMessages& messages) {
  // An index is left to who reads: row by row it takes three times as long as all else, and that of
  // a FlatGeobuf needs memory for all rows.
  const bool unindexed =
      target.format == "gpkg" || (target.columns != nullptr && target.format == "fgb");
  std::array<char, 17> no_index{"SPATIAL_INDEX=NO"};
  std::array<char, 15> letters{"ENCODING=UTF-8"};  // of shapefiles, which says a .cpg beside them
  std::array<char*, 2> options{unindexed                ? no_index.data()
                               : target.format == "shp" ? letters.data()
                                                        : nullptr,
                               nullptr};
  const auto reference = reference_of(target.crs, target.format == "gpkg");
  for (const Table& table : source.tables) {
    const std::string name = layer_name(target, table, &table == source.tables.data());
    OGRLayer* layer =
        dataset.CreateLayer(name.c_str(), reference.get(), type_of(table.kind), options.data());
    if (layer == nullptr) return cannot_write(messages);
    for (const Column& column : table.columns) {
      OGRFieldDefn field(column.name.c_str(), type_of(column.type));
      if (layer->CreateField(&field) != OGRERR_NONE) return cannot_write(messages);
    }
  }
  return success();
}

void set_field(OGRFeature& feature, int number, const Rows& rows, const Rows::Field& field) {
  switch (field.kind) {
    case Rows::Kind::nothing:
      return feature.SetFieldNull(number);
    case Rows::Kind::whole:
      return feature.SetField(number, static_cast<GIntBig>(field.whole));
    case Rows::Kind::real:
      return feature.SetField(number, field.real);
    case Rows::Kind::text:
      return feature.SetField(number, rows.text(field));
  }
}

/// A file with a layer for each table, which GDAL makes. GDAL also adds the rows, unless another
/// library is faster at that. It reports to the thread that calls, so every function listens by
/// itself.
class GdalFile {
 public:
  GdalFile() = default;
  GdalFile(const GdalFile&) = delete;
  GdalFile& operator=(const GdalFile&) = delete;
  ~GdalFile() {
    const GdalMessages unheard;
    faster_.reset();
    layers_.clear();
    dataset_.reset();
  }

  Status open(const std::string& path, const Target& target, const TableSource& source);

  Status add(const Rows& rows) {
    if (faster_) return faster_->add(rows);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const Layer& layer = layers_[rows.table(row)];
      OGRFeature& feature = *layer.feature;
      feature.SetFID(OGRNullFID);
      int number = 0;
      for (const Rows::Field& field : rows.fields(row)) set_field(feature, number++, rows, field);
      set_geometry(feature, layer.kind, rows, row);
      if (layer.layer->CreateFeature(&feature) != OGRERR_NONE)
        return Error{ErrorCode::unwritable, "cannot write", {}};
    }
    return success();
  }
  /// Closing writes, too.
  Status close();

 private:
  struct Layer {
    OGRLayer* layer;
    GeometryKind kind;
    OGRFeatureUniquePtr feature;  ///< each row in turn
  };

  /// Closes the file, whose rows others add.
  template <class OpenRows>
  Status hand_over(const GdalMessages& messages, const OpenRows& open_rows);

  GDALDatasetUniquePtr dataset_;
  std::vector<Layer> layers_;
  std::unique_ptr<RowFile> faster_;
};

template <class OpenRows>
Status GdalFile::hand_over(const GdalMessages& messages, const OpenRows& open_rows) {
  std::vector<EmptyLayer> empty;
  for (const Layer& layer : layers_) {
    const OGRFeatureDefn& columns = *layer.layer->GetLayerDefn();
    EmptyLayer& one = empty.emplace_back(
        EmptyLayer{layer.layer->GetName(), layer.layer->GetGeometryColumn(), {}, layer.kind});
    for (int i = 0; i < columns.GetFieldCount(); ++i)
      one.columns.emplace_back(columns.GetFieldDefn(i)->GetNameRef());
  }
  layers_.clear();
  dataset_.reset();
  if (!messages.failure().empty()) return cannot_write(messages);
  auto rows = open_rows(empty);
  if (!rows) return std::move(rows).error();
  faster_ = std::move(*rows);
  return success();
}

Status GdalFile::open(const std::string& path, const Target& target, const TableSource& source) {
  register_gdal();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_of(target.format));
  if (driver == nullptr)
    return Error{
        ErrorCode::unsupported, fmt::format("this GDAL cannot write {}", target.format), {}};
  const GdalMessages messages;
  std::error_code ignored;
  const bool adds = std::filesystem::exists(path, ignored);  // a copy of what is there
  dataset_.reset(adds ? GDALDataset::Open(path.c_str(),
                                          GDAL_OF_VECTOR | GDAL_OF_UPDATE | GDAL_OF_VERBOSE_ERROR)
                      : driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset_) return cannot_write(messages);
  if (Status room = adds ? make_room(*dataset_, target, source) : success(); !room) return room;
  if (Status created = create_layers(*dataset_, target, source, messages); !created) return created;
  const int count = dataset_->GetLayerCount(), own = static_cast<int>(source.tables.size());
  for (int i = 0; i < own; ++i) {
    OGRLayer* layer = dataset_->GetLayer(count - own + i);
    layers_.push_back({layer, source.tables[static_cast<std::size_t>(i)].kind,
                       OGRFeatureUniquePtr(new OGRFeature(layer->GetLayerDefn()))});
  }
  Status handed = success();
  if (target.format == "gpkg")
    handed = hand_over(messages, [&](std::span<const EmptyLayer> layers) {
      return rows_of_geopackage(path, layers, !adds);
    });
#ifdef MEDIAL_SHAPELIB
  if (target.format == "shp")
    handed = hand_over(messages, [&](auto) { return rows_of_shapefile(path); });
#endif
  if (!handed) return handed;
  return messages.failure().empty() ? success() : cannot_write(messages);
}

Status GdalFile::close() {
  if (faster_) return heard([this] { return faster_->close(); });
  const GdalMessages messages;
  layers_.clear();
  dataset_.reset();
  return messages.failure().empty() ? success() : cannot_write(messages);
}

/// Takes rows, which go into a file if there is one.
class GdalTables final : public TableSink {
 public:
  GdalTables(Target& target, std::vector<Rows>& rows, GdalFile* file = nullptr)
      : TableSink(target), rows_(rows), file_(file) {}

  /// Puts the last rows into the file.
  Status finish() {
    if (rows_.empty()) return success();
    Status added = file_->add(rows_.back());
    rows_.back().clear();
    return added;
  }

 private:
  Status put(std::size_t table, std::span<const Value> first, std::span<const Value> rest,
             std::span<std::vector<Vec2>> parts) override {
    if (rows_.empty()) rows_.emplace_back();
    if (rows_.back().size() == rows_together) {
      if (file_ == nullptr)
        rows_.emplace_back();
      else if (Status added = finish(); !added)
        return added;
    }
    rows_.back().put(table, first, rest, parts);
    return success();
  }

  std::vector<Rows>& rows_;
  GdalFile* file_;
};

Status make_dataset(const std::string& path, Target& target, const TableSource& source) {
  GdalFile file;
  if (Status opened = file.open(path, target, source); !opened) return opened;
  std::vector<Rows> rows;
  GdalTables tables(target, rows, &file);
  const auto fill = [&]() -> Status {
    Status filled = source.fill(tables);
    return filled ? tables.finish() : filled;
  };
  if (Status filled = heard(fill); !filled) return filled;
  return file.close();
}

Status copy_to(OutputStream& out, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 65536> bytes{};
  while (file.read(bytes.data(), bytes.size()) || file.gcount() > 0)
    out.put(std::string_view(bytes.data(), static_cast<std::size_t>(file.gcount())));
  return file.bad() ? Status(Error{ErrorCode::unwritable, "cannot read what was made", {}})
                    : success();
}

Result<PendingFile> temporary_file(const Target& target) {
  Result<std::string> folder = temporary_folder();
  if (!folder) return std::move(folder).error();
  return PendingFile::create(fmt::format("{}/{}.{}", *folder, target.name, target.format));
}

/// Whether the format can hold the content.
Status check_tables(const Target& target, const TableSource& source) {
  if (source.tables.size() != 1 && target.tables != TableRoom::several)
    return Error{ErrorCode::unsupported,
                 fmt::format(".{} holds one layer only, and there are {}; .gpkg and .geojson hold "
                             "several",
                             target.format, source.tables.size()),
                 {}};
  if (target.out != nullptr && target.format == "shp")
    return Error{
        ErrorCode::unsupported, "a shapefile is several files and cannot go to a stream", {}};
  return success();
}

/// A document in parts, whose rows are made on all threads.
class GdalParts final : public PartWriter {
 public:
  static Result<std::unique_ptr<PartWriter>> make(Target& target, const PartOutput& none) {
    std::unique_ptr<GdalParts> parts(new GdalParts(target));
    const TableSource source = source_of(none, target);
    if (Status possible = check_tables(target, source); !possible)
      return std::move(possible).error();
    std::string path = target.path;
    if (target.out != nullptr) {
      Result<PendingFile> made = temporary_file(target);
      if (!made) return std::move(made).error();
      path = made->path();
      parts->temporary_.emplace(std::move(*made));
    }
    if (Status opened = parts->file_.open(path, target, source); !opened)
      return std::move(opened).error();
    return std::unique_ptr<PartWriter>(std::move(parts));
  }

  Result<std::shared_ptr<void>> prepare(const PartOutput& output, const Part& part) override {
    auto rows = std::make_shared<std::vector<Rows>>();
    Target own = target_.of_part(part);
    std::unique_lock<std::mutex> alone(projecting_, std::defer_lock);
    if (own.crs.changes_points()) alone.lock();
    GdalTables tables(own, *rows);
    Status filled = heard([&] { return source_of(output, own).fill(tables); });
    if (!filled) return std::move(filled).error();
    return std::shared_ptr<void>(std::move(rows));
  }

  Status add(void* prepared) override {
    return heard([&]() -> Status {
      for (const Rows& rows : *static_cast<const std::vector<Rows>*>(prepared))
        if (Status added = file_.add(rows); !added) return added;
      return success();
    });
  }

  Status finish() override {
    if (Status closed = file_.close(); !closed || !temporary_) return closed;
    return copy_to(*target_.out, temporary_->path());
  }

 private:
  explicit GdalParts(Target& target) : target_(target) {}
  static TableSource source_of(const PartOutput& output, const Target& target) {
    return std::visit([&](const auto& own) { return tables_of(own, target); }, output);
  }

  Target& target_;
  std::optional<PendingFile> temporary_;
  GdalFile file_;
  std::mutex projecting_;
};

Status put_gdal_tables(Target& target, const TableSource& source) {
  if (Status possible = check_tables(target, source); !possible) return possible;
  return make_file(target,
                   [&](const std::string& path) { return make_dataset(path, target, source); });
}

}  // namespace

Status make_file(Target& target, const std::function<Status(const std::string&)>& make) {
  if (target.out == nullptr) return make(target.path);
  Result<PendingFile> made = temporary_file(target);
  if (!made) return std::move(made).error();
  if (Status status = make(made->path()); !status) return status;
  return copy_to(*target.out, made->path());
}

Format gpkg_format() {
  Format format{".gpkg"};
  format.tables = TableRoom::several;
  format.own_files = true;
  format.begin_addition = begin_addition_to_database;
  format.write_parts = GdalParts::make;
  return with_tables<put_gdal_tables, OffsetsOutput, ShapesOutput, VoronoiOutput>(format);
}

Format shp_format() {
  Format format{".shp"};
  format.own_files = true;
  format.write_parts = GdalParts::make;
  format.growing = Growing::branches;
  return with_tables<put_gdal_tables, OffsetsOutput, ShapesOutput, VoronoiOutput>(format);
}

Format fgb_format() {
  Format format{".fgb"};
  format.write_parts = GdalParts::make;
  format.growing = Growing::branches;
  return with_tables<put_gdal_tables, OffsetsOutput, ShapesOutput, VoronoiOutput>(format);
}

}  // namespace medial::io
