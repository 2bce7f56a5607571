// GeoPackages: GDAL makes the tables, empty, and SQLite takes the rows one by one in prepared
// statements, which takes a third of the time that GDAL's feature objects do.

#include <fmt/format.h>
#include <sqlite3.h>

#include <bit>
#include <deque>
#include <memory>

#include "io/formats/gis.h"
#include "medial/box.h"

namespace medial::io {

namespace {

/// What SQLite reports; thrown within this file, and caught in put_gpkg().
struct SqliteFailure {
  std::string text;
};

/// A database being filled that is thrown away on failure: nothing is kept for a rollback.
class Database {
 public:
  explicit Database(const std::string& path) {
    sqlite3* opened = nullptr;
    const int code = sqlite3_open_v2(path.c_str(), &opened,
                                     SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
    handle_.reset(opened);
    check(code);
    run("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; PRAGMA locking_mode=EXCLUSIVE; "
        "PRAGMA cache_size=-65536; BEGIN");
  }
  void run(const std::string& sql) {
    check(sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr));
  }
  void check(int code) const {
    if (code == SQLITE_OK || code == SQLITE_ROW || code == SQLITE_DONE) return;
    throw SqliteFailure{handle_ ? sqlite3_errmsg(handle_.get()) : sqlite3_errstr(code)};
  }
  sqlite3* handle() const { return handle_.get(); }

 private:
  std::unique_ptr<sqlite3, decltype(&sqlite3_close_v2)> handle_{nullptr, &sqlite3_close_v2};
};

/// A prepared statement. Values are bound one after another; texts and bytes stay where they are
/// until the statement has run.
class Statement {
 public:
  Statement(const Database& database, const std::string& sql) : database_(database) {
    sqlite3_stmt* prepared = nullptr;
    database.check(sqlite3_prepare_v3(database.handle(), sql.c_str(), -1, SQLITE_PREPARE_PERSISTENT,
                                      &prepared, nullptr));
    handle_.reset(prepared);
  }
  Statement& bind(const Value& value) {
    ++at_;
    if (const auto* number = std::get_if<std::int64_t>(&value)) {
      database_.check(sqlite3_bind_int64(handle_.get(), at_, *number));
    } else if (const auto* decimal = std::get_if<double>(&value)) {
      database_.check(sqlite3_bind_double(handle_.get(), at_, *decimal));
    } else if (const auto* words = std::get_if<std::string>(&value)) {
      database_.check(sqlite3_bind_text64(handle_.get(), at_, words->data(), words->size(),
                                          SQLITE_STATIC, SQLITE_UTF8));
    } else {
      database_.check(sqlite3_bind_null(handle_.get(), at_));
    }
    return *this;
  }
  Statement& bind(std::span<const std::uint8_t> bytes) {
    database_.check(
        sqlite3_bind_blob64(handle_.get(), ++at_, bytes.data(), bytes.size(), SQLITE_STATIC));
    return *this;
  }
  /// Runs to the end, and is ready for other values; the whole number of the first row, if any.
  std::int64_t run() {
    const int code = sqlite3_step(handle_.get());
    database_.check(code);
    const std::int64_t first = code == SQLITE_ROW ? sqlite3_column_int64(handle_.get(), 0) : 0;
    database_.check(sqlite3_reset(handle_.get()));
    at_ = 0;
    return first;
  }

 private:
  const Database& database_;
  std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> handle_{nullptr, &sqlite3_finalize};
  int at_ = 0;
};

/// Appends the bytes of a value, as this machine orders them.
template <class Number>
void put_bytes(std::vector<std::uint8_t>& out, Number value) {
  const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(Number)>>(value);
  out.insert(out.end(), bytes.begin(), bytes.end());
}

/// A geometry as a GeoPackage has it (OGC 12-128r18, 2.1.3): a header, a box where it is no point,
/// and well-known binary.
void encode(GeometryKind kind, std::span<const std::vector<Vec2>> parts, const Box& extent,
            std::int32_t srs, std::vector<std::uint8_t>& out) {
  constexpr bool little = std::endian::native == std::endian::little;
  out.assign({'G', 'P', 0});
  const bool point = kind == GeometryKind::point;
  put_bytes(out, static_cast<std::uint8_t>((point ? 0 : 2) + (little ? 1 : 0)));
  put_bytes(out, srs);
  if (!point)
    for (const double value : {extent.low.x, extent.high.x, extent.low.y, extent.high.y})
      put_bytes(out, value);
  put_bytes(out, static_cast<std::uint8_t>(little ? 1 : 0));
  put_bytes(out, static_cast<std::uint32_t>(kind) + 1);
  if (kind == GeometryKind::polygon) put_bytes(out, static_cast<std::uint32_t>(parts.size()));
  for (const std::vector<Vec2>& part : parts) {
    if (!point) put_bytes(out, static_cast<std::uint32_t>(part.size()));
    for (const Vec2 p : part) {
      put_bytes(out, p.x);
      put_bytes(out, p.y);
    }
  }
}

std::string quoted_name(std::string_view name) {
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string insertion(const Table& table) {
  std::string marks = "?,?";  // the row's number and the geometry come first
  for (std::size_t i = 0; i < table.columns.size(); ++i) marks += ",?";
  return fmt::format("INSERT INTO {} VALUES({})", quoted_name(table.name), marks);
}

/// A layer being filled.
class GpkgLayer {
 public:
  GpkgLayer(const Database& database, const Table& table)
      : database_(database),
        table_(table),
        insert_(database, insertion(table)),
        srs_(static_cast<std::int32_t>(
            Statement(database, "SELECT srs_id FROM gpkg_geometry_columns WHERE table_name=?")
                .bind(Value(table.name))
                .run())) {}

  void add(std::span<const Value> first, std::span<const Value> rest,
           std::span<std::vector<Vec2>> parts) {
    Box own = Box::nothing();
    for (std::vector<Vec2>& part : parts) {
      if (table_.kind == GeometryKind::polygon && part.front() != part.back())
        part.push_back(part.front());
      for (const Vec2 p : part) own.add(p);
    }
    bounds_.add(own);
    encode(table_.kind, parts, own, srs_, bytes_);
    insert_.bind(Value(++rows_)).bind(std::span<const std::uint8_t>(bytes_));
    for (const auto values : {first, rest})
      for (const Value& value : values) insert_.bind(value);
    insert_.run();
  }

  void finish() {
    if (rows_ == 0) return;
    const Value name = table_.name;
    Statement contents(database_,
                       "UPDATE gpkg_contents SET min_x=?,min_y=?,max_x=?,max_y=? "
                       "WHERE table_name=?");
    for (const double value : {bounds_.low.x, bounds_.low.y, bounds_.high.x, bounds_.high.y})
      contents.bind(Value(value));
    contents.bind(name).run();
  }

 private:
  const Database& database_;
  const Table& table_;
  Statement insert_;
  std::vector<std::uint8_t> bytes_;
  std::int32_t srs_ = 0;
  std::int64_t rows_ = 0;
  Box bounds_ = Box::nothing();
};

class GpkgTables final : public TableSink {
 public:
  GpkgTables(Target& target, const std::string& path, const TableSource& source)
      : TableSink(target), database_(path) {
    for (const Table& table : source.tables) layers_.emplace_back(database_, table);
  }
  void finish() {
    for (GpkgLayer& layer : layers_) layer.finish();
    layers_.clear();
    database_.run("COMMIT");
  }

 private:
  Status put(std::size_t table, std::span<const Value> first, std::span<const Value> rest,
             std::span<std::vector<Vec2>> parts) override {
    layers_[table].add(first, rest, parts);
    return success();
  }

  Database database_;
  std::deque<GpkgLayer> layers_;  // they stay where they are
};

Status put_gpkg(Target& target, const TableSource& source) {
  return make_file(target, [&](const std::string& path) -> Status {
    if (Status made = create_by_gdal(path, target, source); !made) return made;
    try {
      GpkgTables tables(target, path, source);
      if (Status filled = source.fill(tables); !filled) return filled;
      tables.finish();
      return success();
    } catch (const SqliteFailure& failure) {
      return Error{ErrorCode::unwritable, "cannot write: " + failure.text, {}};
    }
  });
}

}  // namespace

Format gpkg_format() {
  Format format{".gpkg"};
  format.own_files = true;
  return with_tables<put_gpkg>(format);
}

}  // namespace medial::io
