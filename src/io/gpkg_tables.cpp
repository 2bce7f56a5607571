#include "io/gpkg_tables.h"

#include <fmt/format.h>

#include <bit>
#include <deque>
#include <optional>

#include "io/gdal_target.h"
#include "io/gpkg_index.h"
#include "io/sqlite.h"
#include "medial/box.h"

namespace medial::io {

namespace {

/// Appends the bytes of a value, as this machine orders them.
template <class Number>
void put(std::vector<std::uint8_t>& out, Number value) {
  const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(Number)>>(value);
  out.insert(out.end(), bytes.begin(), bytes.end());
}

/// A geometry as a GeoPackage has it (OGC 12-128r18, 2.1.3): a header, a box where it is no point,
/// and well-known binary.
void encode(GeometryKind kind, std::span<const std::vector<Vec2>> parts, const Box& extent,
            std::int32_t srs, std::vector<std::uint8_t>& out) {
  constexpr bool little = std::endian::native == std::endian::little;
  out.clear();
  for (const char c : {'G', 'P', '\0'}) put(out, c);
  const bool point = kind == GeometryKind::point;
  put(out, static_cast<std::uint8_t>((point ? 0 : 2) + (little ? 1 : 0)));
  put(out, srs);
  if (!point)
    for (const double value : {extent.low.x, extent.high.x, extent.low.y, extent.high.y})
      put(out, value);
  put(out, static_cast<std::uint8_t>(little ? 1 : 0));
  put(out, static_cast<std::uint32_t>(kind) + 1);
  if (kind == GeometryKind::polygon) put(out, static_cast<std::uint32_t>(parts.size()));
  for (const std::vector<Vec2>& part : parts) {
    if (!point) put(out, static_cast<std::uint32_t>(part.size()));
    for (const Vec2 p : part) {
      put(out, p.x);
      put(out, p.y);
    }
  }
}

/// A layer being filled. Its triggers, which keep the count and the index, wait until the end.
class GpkgLayer {
 public:
  GpkgLayer(Database& database, const Table& table)
      : database_(database), table_(table), index_(database, table.name) {
    Statement columns(database, "SELECT srs_id FROM gpkg_geometry_columns WHERE table_name=?");
    columns.bind(1, table.name);
    if (columns.step()) srs_ = static_cast<std::int32_t>(columns.whole(0));
    std::vector<std::string> names;
    {
      Statement triggers(database,
                         "SELECT name, sql FROM sqlite_master WHERE type='trigger' AND tbl_name=?");
      triggers.bind(1, table.name);
      while (triggers.step()) {
        names.push_back(triggers.text(0));
        triggers_.push_back(triggers.text(1));
      }
    }
    for (const std::string& name : names) database.run("DROP TRIGGER " + quoted_name(name));
    std::string marks = "?,?";  // the row's number and the geometry come first
    for (std::size_t i = 0; i < table.columns.size(); ++i) marks += ",?";
    insert_.emplace(database,
                    fmt::format("INSERT INTO {} VALUES({})", quoted_name(table.name), marks));
  }

  void add(std::span<const Value> first, std::span<const Value> rest,
           std::span<std::vector<Vec2>> parts) {
    Box own = Box::nothing();
    for (std::vector<Vec2>& part : parts) {
      if (table_.kind == GeometryKind::polygon && part.front() != part.back())
        part.push_back(part.front());
      for (const Vec2 p : part) own.add(p);
    }
    bounds_.add(own.low);
    bounds_.add(own.high);
    ++rows_;
    encode(table_.kind, parts, own, srs_, bytes_);
    insert_->bind(1, rows_);
    insert_->bind(2, std::span<const std::uint8_t>(bytes_));
    int at = 3;
    for (const auto values : {first, rest})
      for (const Value& value : values) bind(at++, value);
    insert_->run();
    index_.add(rows_, own.low, own.high);
  }

  void finish() {
    index_.write();
    if (rows_ > 0) {
      Statement contents(database_,
                         "UPDATE gpkg_contents SET min_x=?,min_y=?,max_x=?,max_y=? "
                         "WHERE table_name=?");
      int at = 1;
      for (const double value : {bounds_.low.x, bounds_.low.y, bounds_.high.x, bounds_.high.y})
        contents.bind(at++, value);
      contents.bind(at, table_.name);
      contents.run();
    }
    Statement counts(database_, "UPDATE gpkg_ogr_contents SET feature_count=? WHERE table_name=?");
    counts.bind(1, rows_);
    counts.bind(2, table_.name);
    counts.run();
    insert_.reset();
    for (const std::string& trigger : triggers_) database_.run(trigger);
  }

 private:
  void bind(int at, const Value& value) {
    if (const auto* number = std::get_if<std::int64_t>(&value)) {
      insert_->bind(at, *number);
    } else if (const auto* decimal = std::get_if<double>(&value)) {
      insert_->bind(at, *decimal);
    } else if (const auto* words = std::get_if<std::string>(&value)) {
      insert_->bind(at, std::string_view(*words));
    } else {
      insert_->bind_null(at);
    }
  }

  Database& database_;
  const Table& table_;
  GpkgIndex index_;
  std::vector<std::string> triggers_;
  std::optional<Statement> insert_;
  std::vector<std::uint8_t> bytes_;
  std::int32_t srs_ = 0;
  std::int64_t rows_ = 0;
  Box bounds_ = Box::nothing();
};

class GpkgTables final : public TableSink {
 public:
  GpkgTables(const std::string& path, const OutputCrs& crs, const TableSource& source)
      : database_(path), crs_(crs) {
    for (const Table& table : source.tables) layers_.emplace_back(database_, table);
  }

  Status add(std::size_t table, std::span<const Value> first, std::span<const Value> rest,
             std::span<std::vector<Vec2>> parts) override {
    for (std::vector<Vec2>& part : parts)
      if (Status placed = crs_.transform(part); !placed) return placed;
    layers_[table].add(first, rest, parts);
    return success();
  }

  void finish() {
    for (GpkgLayer& layer : layers_) layer.finish();
    layers_.clear();
    database_.finish();
  }

 private:
  Database database_;
  const OutputCrs& crs_;
  std::deque<GpkgLayer> layers_;  // they stay where they are
};

}  // namespace

Status write_gpkg(const std::string& path, const OutputCrs& crs, const TableSource& source) {
  if (Status made = create_by_gdal(path, "gpkg", crs, source); !made) return made;
  try {
    GpkgTables tables(path, crs, source);
    if (Status filled = source.fill(tables); !filled) return filled;
    tables.finish();
    return success();
  } catch (const SqliteFailure& failure) {
    return Error{ErrorCode::unwritable, "cannot write: " + failure.text, {}};
  }
}

}  // namespace medial::io
