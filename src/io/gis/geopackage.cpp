// Rows of GeoPackages, put in by SQLite itself: GDAL's features take several times as long.

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "io/gis/rows.h"

namespace medial::io {

namespace {

struct Finalize {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, Finalize>;
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

/// An SQL name.
std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + '"';
}

/// A geometry as a GeoPackage holds it: a header, and well-known binary.
class GeometryBlob {
 public:
  Box extent = Box::nothing();  ///< of all geometries

  /// The bytes of a row's geometry, which stay until the next one.
  std::span<const char> make(GeometryKind kind, std::int32_t srs, const Rows& rows,
                             std::size_t row) {
    static_assert(std::endian::native == std::endian::little && sizeof(OGRRawPoint) == 16);
    const bool is_point = kind == GeometryKind::point;
    bytes_.clear();
    const char flags = is_point ? 1 : 3;  // little-endian, with an envelope unless it is a point
    for (const char c : {'G', 'P', '\0', flags}) bytes_.push_back(c);
    put(srs);
    const Box box = box_of(rows, row);
    extent.add(box.low);
    extent.add(box.high);
    if (!is_point)
      for (const double bound : {box.low.x, box.high.x, box.low.y, box.high.y}) put(bound);
    bytes_.push_back(1);  // little-endian
    put(std::uint32_t{is_point ? 1U : kind == GeometryKind::line ? 2U : 3U});
    if (is_point) {
      put_points(rows.ring(row, 0).first(1));
    } else if (kind == GeometryKind::line) {
      put(static_cast<std::uint32_t>(rows.ring(row, 0).size()));
      put_points(rows.ring(row, 0));
    } else {
      put(static_cast<std::uint32_t>(rows.ring_count(row)));
      for (std::size_t i = 0; i < rows.ring_count(row); ++i) put_closed(rows.ring(row, i));
    }
    return bytes_;
  }

 private:
  static Box box_of(const Rows& rows, std::size_t row) {
    Box box = Box::nothing();
    for (std::size_t i = 0; i < rows.ring_count(row); ++i)
      for (const OGRRawPoint& p : rows.ring(row, i)) box.add(Vec2{p.x, p.y});
    return box;
  }
  template <class Number>
  void put(Number number) {
    append(&number, sizeof number);
  }
  void put_points(std::span<const OGRRawPoint> points) {
    append(points.data(), points.size_bytes());
  }
  void put_closed(std::span<const OGRRawPoint> ring) {
    const OGRRawPoint &first = ring.front(), &last = ring.back();
    const bool is_open = ring.size() > 1 && (first.x != last.x || first.y != last.y);
    put(static_cast<std::uint32_t>(ring.size() + (is_open ? 1 : 0)));
    put_points(ring);
    if (is_open) put_points(ring.first(1));
  }
  void append(const void* from, std::size_t count) {
    const char* begin = static_cast<const char*>(from);
    bytes_.insert(bytes_.end(), begin, begin + count);
  }

  std::vector<char> bytes_;
};

class GeoPackageRows final : public RowFile {
 public:
  Status open(const std::string& path, std::span<const EmptyLayer> layers, bool is_new) {
    sqlite3* opened = nullptr;
    constexpr int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX;  // one thread at a time
    const int code = sqlite3_open_v2(path.c_str(), &opened, flags, nullptr);
    database_.reset(opened);
    if (code != SQLITE_OK) return failure();
    // No other program knows the file yet. A new one goes away where anything fails.
    if (Status set = run("PRAGMA locking_mode = EXCLUSIVE"); !set) return set;
    if (is_new)
      if (Status set = run("PRAGMA journal_mode = OFF"); !set) return set;
    // Triggers count rows one by one; close() tells what they would.
    sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    if (Status begun = run("BEGIN"); !begun) return begun;
    for (const EmptyLayer& layer : layers)
      if (Status prepared = prepare(layer); !prepared) return prepared;
    return success();
  }

  Status add(const Rows& rows) override {
    for (std::size_t row = 0; row < rows.size(); ++row) {
      Layer& layer = layers_[rows.table(row)];
      sqlite3_stmt* insert = layer.insert.get();
      const std::span<const char> blob = layer.blob.make(layer.kind, layer.srs, rows, row);
      sqlite3_bind_blob64(insert, 1, blob.data(), blob.size(), SQLITE_STATIC);
      int number = 1;
      for (const Rows::Field& field : rows.fields(row)) bind(insert, ++number, rows, field);
      if (sqlite3_step(insert) != SQLITE_DONE) return failure();
      sqlite3_reset(insert);
      ++layer.count;
    }
    return success();
  }

  Status close() override {
    for (Layer& layer : layers_) {
      layer.insert.reset();
      if (layer.count == 0) continue;
      if (Status told = tell(layer); !told) return told;
    }
    if (Status done = run("COMMIT"); !done) return done;
    return sqlite3_close(database_.release()) == SQLITE_OK ? success() : Status(failure());
  }

 private:
  struct Layer {
    std::string name;
    GeometryKind kind = GeometryKind::point;
    std::int32_t srs = 0;
    Statement insert;
    GeometryBlob blob;
    std::int64_t count = 0;
  };

  Error failure() const {
    return {ErrorCode::unwritable,
            fmt::format("cannot write: {}",
                        database_ ? sqlite3_errmsg(database_.get()) : "SQLite has no memory"),
            {}};
  }
  Status run(const char* sql) {
    const int code = sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr);
    return code == SQLITE_OK ? success() : Status(failure());
  }
  Statement statement(const std::string& sql) {
    sqlite3_stmt* made = nullptr;
    sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &made, nullptr);
    return Statement(made);
  }
  static void bind_text(const Statement& to, int number, const std::string& text) {
    sqlite3_bind_text(to.get(), number, text.c_str(), -1, SQLITE_STATIC);
  }

  Status prepare(const EmptyLayer& of) {
    Layer& layer = layers_.emplace_back();
    layer.name = of.name;
    layer.kind = of.kind;
    const Statement srs =
        statement("SELECT srs_id FROM gpkg_geometry_columns WHERE table_name = ?");
    if (!srs) return failure();
    bind_text(srs, 1, of.name);
    if (sqlite3_step(srs.get()) != SQLITE_ROW) return failure();
    layer.srs = sqlite3_column_int(srs.get(), 0);
    std::string names = quoted(of.geometry), values = "?";
    for (const std::string& column : of.columns) {
      names += ", " + quoted(column);
      values += ", ?";
    }
    layer.insert =
        statement(fmt::format("INSERT INTO {} ({}) VALUES ({})", quoted(of.name), names, values));
    return layer.insert ? success() : Status(failure());
  }

  static void bind(sqlite3_stmt* insert, int number, const Rows& rows, const Rows::Field& field) {
    switch (field.kind) {
      case Rows::Kind::nothing:
        sqlite3_bind_null(insert, number);
        return;
      case Rows::Kind::whole:
        sqlite3_bind_int64(insert, number, field.whole);
        return;
      case Rows::Kind::real:
        sqlite3_bind_double(insert, number, field.real);
        return;
      case Rows::Kind::text:
        sqlite3_bind_text(insert, number, rows.text(field), -1, SQLITE_STATIC);
        return;
    }
  }

  /// The extent and the number of rows.
  Status tell(const Layer& layer) {
    const Statement extent = statement(
        "UPDATE gpkg_contents SET min_x = ?, min_y = ?, max_x = ?, max_y = ?, "
        "last_change = strftime('%Y-%m-%dT%H:%M:%fZ', 'now') WHERE table_name = ?");
    const Statement count =
        statement("UPDATE gpkg_ogr_contents SET feature_count = ? WHERE table_name = ?");
    if (!extent || !count) return failure();
    const Box& box = layer.blob.extent;
    int number = 0;
    for (const double bound : {box.low.x, box.low.y, box.high.x, box.high.y})
      sqlite3_bind_double(extent.get(), ++number, bound);
    bind_text(extent, ++number, layer.name);
    sqlite3_bind_int64(count.get(), 1, layer.count);
    bind_text(count, 2, layer.name);
    for (const Statement* update : {&extent, &count})
      if (sqlite3_step(update->get()) != SQLITE_DONE) return failure();
    return success();
  }

  Database database_;
  std::vector<Layer> layers_;  ///< their statements go before the database
};

}  // namespace

Result<std::unique_ptr<RowFile>> rows_of_geopackage(const std::string& path,
                                                    std::span<const EmptyLayer> layers,
                                                    bool is_new) {
  auto file = std::make_unique<GeoPackageRows>();
  if (Status opened = file->open(path, layers, is_new); !opened) return std::move(opened).error();
  return std::unique_ptr<RowFile>(std::move(file));
}

}  // namespace medial::io
