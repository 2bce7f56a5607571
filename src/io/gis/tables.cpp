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

#include "io/format_name.h"
#include "io/gis/gdal_rows.h"
#include "io/gis/gdal_support.h"
#include "io/gis/make_file.h"
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

bool is_geopackage(GDALDataset& dataset) {
  return dataset.GetDriver() != nullptr && EQUAL(dataset.GetDriver()->GetDescription(), "GPKG");
}

/// A text in SQL, between such quotes.
std::string quoted(const std::string& text, char quote) {
  std::ostringstream out;
  out << std::quoted(text, quote, quote);
  return out.str();
}

/// Whether the name of a new layer is free among what is no layer: indices, views and so on.
Status check_free(GDALDataset& dataset, const std::string& name) {
  if (!is_geopackage(dataset)) return success();
  const std::string sql = fmt::format(
      "SELECT type, name FROM sqlite_master WHERE name = {} COLLATE NOCASE", quoted(name, '\''));
  OGRLayer* found = dataset.ExecuteSQL(sql.c_str(), nullptr, nullptr);
  if (found == nullptr) return success();
  OGRFeatureUniquePtr row(found->GetNextFeature());
  Status free = success();
  if (row)
    free = Error{ErrorCode::unwritable,
                 fmt::format("the file has something else called '{}' (of type {}); "
                             "--output-layer gives the new layer another name",
                             row->GetFieldAsString(1), row->GetFieldAsString(0)),
                 {}};
  row.reset();  // before the result that it came from
  dataset.ReleaseResultSet(found);
  return free;
}

/// GDAL before 3.7 removes the triggers of a spatial index by names that newer GDALs no longer give
/// them: adds those that are missing. With the layer, SQLite removes all.
void complete_triggers(GDALDataset& dataset, OGRLayer& layer) {
  if (!is_geopackage(dataset) || layer.TestCapability(OLCFastSpatialFilter) == 0) return;
  for (const char* trigger : {"insert", "update1", "update2", "update3", "update4", "delete"})
    dataset.ExecuteSQL(
        fmt::format("CREATE TRIGGER IF NOT EXISTS {} AFTER DELETE ON {} BEGIN SELECT 1; END",
                    quoted(fmt::format("rtree_{}_{}_{}", layer.GetName(), layer.GetGeometryColumn(),
                                       trigger),
                           '"'),
                    quoted(layer.GetName(), '"'))
            .c_str(),
        nullptr, nullptr);
}

/// Removes layers of the same name as a table, if that was asked for: one that the user named, and
/// of the others those that have our columns.
Status make_room(GDALDataset& dataset, const Target& target, std::span<const Table> tables) {
  for (const Table& table : tables) {
    const bool first = &table == tables.data(), is_named = first && !target.layer.empty();
    const std::string name = layer_name(target, table, first);
    for (int i = dataset.GetLayerCount(); i-- > 0;) {
      OGRLayer& layer = *dataset.GetLayer(i);
      if (!EQUAL(layer.GetName(), name.c_str())) continue;
      if (!target.overwrite)
        return Error{ErrorCode::unwritable,
                     fmt::format("the file has a layer '{}' already; --overwrite replaces it, "
                                 "--output-layer gives the new one another name",
                                 layer.GetName()),
                     {}};
      if (!is_named && !has_columns_of(layer, table))
        return Error{ErrorCode::unwritable,
                     fmt::format("the file has a layer '{}' with other columns, which --overwrite "
                                 "leaves alone; --output-layer gives the new one another name",
                                 layer.GetName()),
                     {}};
      complete_triggers(dataset, layer);
      if (dataset.DeleteLayer(i) != OGRERR_NONE)
        return Error{
            ErrorCode::unwritable, fmt::format("the layer '{}' cannot be replaced", name), {}};
    }
    if (Status is_free = check_free(dataset, name); !is_free) return is_free;
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

Result<std::vector<EmptyLayer>> create_layers(GDALDataset& dataset, const Target& target,
                                              std::span<const Table> tables, bool in_parts,
                                              const GdalMessages& messages) {
  // An index is left to who reads: row by row it takes three times as long as all else, and that of
  // a FlatGeobuf needs memory for all rows.
  const bool unindexed = target.format == "gpkg" || (in_parts && target.format == "fgb");
  CPLStringList options;
  if (unindexed) options.SetNameValue("SPATIAL_INDEX", "NO");
  if (target.format == "shp") options.SetNameValue("ENCODING", "UTF-8");  // a .cpg says it
  const auto reference = reference_of(target.crs, target.format == "gpkg");
  std::vector<EmptyLayer> layers;
  for (const Table& table : tables) {
    const std::string name = layer_name(target, table, &table == tables.data());
    OGRLayer* layer =
        dataset.CreateLayer(name.c_str(), reference.get(), type_of(table.kind), options.List());
    if (layer == nullptr) return cannot_write(messages);
    for (const Column& column : table.columns) {
      OGRFieldDefn field(column.name.c_str(), type_of(column.type));
      if (layer->CreateField(&field) != OGRERR_NONE) return cannot_write(messages);
    }
    EmptyLayer& made = layers.emplace_back(
        EmptyLayer{layer->GetName(), layer->GetGeometryColumn(), {}, table.kind});
    OGRFeatureDefn& columns = *layer->GetLayerDefn();
    for (int i = 0; i < columns.GetFieldCount(); ++i)
      made.columns.emplace_back(columns.GetFieldDefn(i)->GetNameRef());
  }
  return layers;
}

using OpenRows = Result<std::unique_ptr<RowFile>> (*)(const std::string& path,
                                                      std::span<const EmptyLayer> layers,
                                                      bool is_new);

/// Null: no library.
OpenRows faster_than_gdal(const std::string& format) {
#ifdef MEDIAL_SHAPELIB
  if (format == "shp") return rows_of_shapefile;
#endif
  return format == "gpkg" ? rows_of_geopackage : nullptr;
}

/// Lets GDAL make a file with a layer for each table, or add them to a file, and opens it for rows
/// by the library that is fastest.
Result<std::unique_ptr<RowFile>> open_rows(const std::string& path, const Target& target,
                                           std::span<const Table> tables, bool in_parts) {
  register_gdal();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_of(target.format));
  if (driver == nullptr)
    return Error{
        ErrorCode::unsupported, fmt::format("this GDAL cannot write {}", target.format), {}};
  const GdalMessages messages;
  std::error_code ignored;
  const bool adds = std::filesystem::exists(path, ignored);  // a copy of what is there
  GDALDatasetUniquePtr dataset(
      adds
          ? GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE | GDAL_OF_VERBOSE_ERROR)
          : driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset) return cannot_write(messages);
  if (Status room = adds ? make_room(*dataset, target, tables) : success(); !room)
    return std::move(room).error();
  auto layers = create_layers(*dataset, target, tables, in_parts, messages);
  if (!layers) return std::move(layers).error();
  const OpenRows open_faster = faster_than_gdal(target.format);
  if (open_faster != nullptr) dataset.reset();
  if (!messages.failure().empty()) return cannot_write(messages);
  if (open_faster == nullptr) return rows_of_gdal(std::move(dataset), *layers);
  auto rows = open_faster(path, *layers, !adds);
  if (rows && !messages.failure().empty()) return cannot_write(messages);
  return rows;
}

/// Takes rows, which go into a file if there is one.
class RowSink final : public TableSink {
 public:
  RowSink(Target& target, std::vector<Rows>& rows, RowFile* file = nullptr)
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
  RowFile* file_;
};

Status close(RowFile& file) {
  return heard([&file] { return file.close(); });
}

Status make_dataset(const std::string& path, Target& target, const TableSource& source) {
  auto file = open_rows(path, target, source.tables, false);
  if (!file) return std::move(file).error();
  std::vector<Rows> rows;
  RowSink sink(target, rows, file->get());
  const auto fill = [&]() -> Status {
    Status filled = source.fill(sink);
    return filled ? sink.finish() : filled;
  };
  if (Status filled = heard(fill); !filled) return filled;
  return close(**file);
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

/// Whether a GeoPackage can have a layer of the name that the user gave.
Status check_layer_name(const Target& target) {
  const std::string& name = target.layer;
  if (target.format != "gpkg" || name.empty()) return success();
  const auto refuse = [](std::string text) {
    return Error{ErrorCode::invalid_option, std::move(text), {}};
  };
  const std::string lower = lower_case(name);
  for (const std::string_view prefix : {"sqlite_", "gpkg", "rtree_"})
    if (lower.starts_with(prefix))
      return refuse(
          fmt::format("no layer can be called '{}': a GeoPackage keeps names that begin "
                      "with '{}' for itself",
                      name, prefix));
  if (name.find_first_not_of(" \t\r\n") == name.npos)
    return refuse("the name of a layer cannot be blank");
  if (CPLIsUTF8(name.c_str(), -1) == FALSE) return refuse("the name of the layer is not UTF-8");
  return success();
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
  return check_layer_name(target);
}

/// A document in parts, whose rows are made on all threads.
class GdalParts final : public PartWriter {
 public:
  static Result<std::unique_ptr<PartWriter>> make(Target& target, const PartOutput& none) {
    std::unique_ptr<GdalParts> parts(new GdalParts(target));
    TableSource source = source_of(none, target);
    if (Status possible = check_tables(target, source); !possible)
      return std::move(possible).error();
    parts->tables_ = std::move(source.tables);
    parts->path_ = target.path;
    if (target.out != nullptr) {
      Result<PendingFile> made = temporary_file(target);
      if (!made) return std::move(made).error();
      parts->path_ = made->path();
      parts->temporary_.emplace(std::move(*made));
    }
    if (Status opened = parts->open(true); !opened) return std::move(opened).error();
    return std::unique_ptr<PartWriter>(std::move(parts));
  }

  Result<std::shared_ptr<void>> prepare(const PartOutput& output, const Part& part) override {
    auto rows = std::make_shared<std::vector<Rows>>();
    Target own = target_.of_part(part);
    std::unique_lock<std::mutex> alone(projecting_, std::defer_lock);
    if (own.crs.changes_points()) alone.lock();
    RowSink sink(own, *rows);
    Status filled = heard([&] { return source_of(output, own).fill(sink); });
    if (!filled) return std::move(filled).error();
    return std::shared_ptr<void>(std::move(rows));
  }

  Status add(void* prepared) override {
    return heard([&]() -> Status {
      for (const Rows& rows : *static_cast<const std::vector<Rows>*>(prepared)) {
        is_empty_ = is_empty_ && rows.size() == 0;
        if (Status added = file_->add(rows); !added) return added;
      }
      return success();
    });
  }

  Status finish() override {
    if (Status closed = close(*file_); !closed) return closed;
    // GDAL leaves a FlatGeobuf empty that has neither features nor an index.
    std::error_code problem;
    if (is_empty_ && std::filesystem::is_empty(path_, problem)) {
      std::filesystem::remove(path_, problem);
      if (Status opened = open(false); !opened) return opened;
      if (Status closed = close(*file_); !closed) return closed;
    }
    return temporary_ ? copy_to(*target_.out, path_) : success();
  }

 private:
  explicit GdalParts(Target& target) : target_(target) {}
  Status open(bool in_parts) {
    auto opened = open_rows(path_, target_, tables_, in_parts);
    if (!opened) return std::move(opened).error();
    file_ = std::move(*opened);
    return success();
  }
  static TableSource source_of(const PartOutput& output, const Target& target) {
    return std::visit([&](const auto& own) { return tables_of(own, target); }, output);
  }

  Target& target_;
  std::vector<Table> tables_;
  std::string path_;
  std::optional<PendingFile> temporary_;
  std::unique_ptr<RowFile> file_;
  bool is_empty_ = true;
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
