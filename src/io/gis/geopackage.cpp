// Rows of GeoPackages, put in by SQLite itself: GDAL's features take several times as long.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <deque>
#include <utility>

#include "io/gis/rows.h"
#include "io/gis/sqlite.h"

namespace medial::io {

namespace {

/// An SQL name.
std::string sql_name(const std::string& name) {
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
    static_assert(std::endian::native == std::endian::little && sizeof(Vec2) == 16);
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
      for (const Vec2 p : rows.ring(row, i)) box.add(p);
    return box;
  }
  template <class Number>
  void put(Number number) {
    append(&number, sizeof number);
  }
  void put_points(std::span<const Vec2> points) { append(points.data(), points.size_bytes()); }
  void put_closed(std::span<const Vec2> ring) {
    const bool is_open = ring.front() != ring.back();
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

/// A layer, and the rows on their way to it.
struct FilledLayer {
  std::string name;
  std::size_t number = 0;
  GeometryKind kind = GeometryKind::point;
  std::int32_t srs = 0;
  std::size_t columns = 0;  ///< besides the geometry
  GeometryBlob blob;
  const Rows* rows = nullptr;
  Statement insert;
  std::int64_t count = 0;

  /// The first of the rows from `row` on that belongs to this layer; or their number.
  std::size_t own_from(std::size_t row) const {
    while (row < rows->size() && rows->table(row) != number) ++row;
    return row;
  }
  std::size_t own_count() const {
    std::size_t own = 0;
    for (std::size_t row = 0; row < rows->size(); ++row) own += rows->table(row) == number ? 1 : 0;
    return own;
  }
};

/// A layer's rows as a table of SQLite's, so that one statement inserts many of them. SQLite calls
/// these functions by pointers.
struct RowTable : sqlite3_vtab {
  FilledLayer* layer;
};
struct RowCursor : sqlite3_vtab_cursor {
  std::size_t row;
};

/// No exception passes through SQLite.
template <class Work>
int without_exceptions(const Work& work) {
  try {
    return work();
  } catch (...) {
    return SQLITE_NOMEM;
  }
}

int connect_rows(sqlite3* database, void* layer, int, const char* const*, sqlite3_vtab** made,
                 char**) {
  return without_exceptions([&] {
    auto table = std::make_unique<RowTable>();
    table->layer = static_cast<FilledLayer*>(layer);
    std::string columns = "geometry";
    for (std::size_t i = 0; i < table->layer->columns; ++i) columns += fmt::format(", c{}", i);
    const std::string sql = fmt::format("CREATE TABLE x({})", columns);
    const int code = sqlite3_declare_vtab(database, sql.c_str());
    if (code == SQLITE_OK) *made = table.release();
    return code;
  });
}
int disconnect_rows(sqlite3_vtab* table) {
  delete static_cast<RowTable*>(table);
  return SQLITE_OK;
}
int choose_index(sqlite3_vtab*, sqlite3_index_info*) { return SQLITE_OK; }
int open_cursor(sqlite3_vtab*, sqlite3_vtab_cursor** cursor) {
  *cursor = new (std::nothrow) RowCursor{};
  return *cursor != nullptr ? SQLITE_OK : SQLITE_NOMEM;
}
int close_cursor(sqlite3_vtab_cursor* cursor) {
  delete static_cast<RowCursor*>(cursor);
  return SQLITE_OK;
}
FilledLayer& layer_of(sqlite3_vtab_cursor* cursor) {
  return *static_cast<RowTable*>(cursor->pVtab)->layer;
}
int first_row(sqlite3_vtab_cursor* cursor, int, const char*, int, sqlite3_value**) {
  static_cast<RowCursor*>(cursor)->row = layer_of(cursor).own_from(0);
  return SQLITE_OK;
}
int next_row(sqlite3_vtab_cursor* cursor) {
  std::size_t& row = static_cast<RowCursor*>(cursor)->row;
  row = layer_of(cursor).own_from(row + 1);
  return SQLITE_OK;
}
int is_at_end(sqlite3_vtab_cursor* cursor) {
  return static_cast<RowCursor*>(cursor)->row == layer_of(cursor).rows->size() ? 1 : 0;
}
int row_number(sqlite3_vtab_cursor* cursor, sqlite3_int64* number) {
  *number = static_cast<sqlite3_int64>(static_cast<RowCursor*>(cursor)->row);
  return SQLITE_OK;
}
/// Nothing is copied: a row is in the file before the next one is asked for.
int give_value(sqlite3_vtab_cursor* cursor, sqlite3_context* to, int column) {
  FilledLayer& layer = layer_of(cursor);
  const Rows& rows = *layer.rows;
  const std::size_t row = static_cast<RowCursor*>(cursor)->row;
  if (column == 0) {
    return without_exceptions([&] {
      const std::span<const char> blob = layer.blob.make(layer.kind, layer.srs, rows, row);
      sqlite3_result_blob64(to, blob.data(), blob.size(), SQLITE_STATIC);
      return SQLITE_OK;
    });
  }
  const Rows::Field& field = rows.fields(row)[static_cast<std::size_t>(column) - 1];
  if (field.kind == Rows::Kind::whole)
    sqlite3_result_int64(to, field.whole);
  else if (field.kind == Rows::Kind::real)
    sqlite3_result_double(to, field.real);
  else if (field.kind == Rows::Kind::text)
    sqlite3_result_text(to, rows.text(field), -1, SQLITE_STATIC);
  return SQLITE_OK;
}

const sqlite3_module* row_module() {
  static const sqlite3_module module = [] {
    sqlite3_module made{};
    made.xCreate = made.xConnect = connect_rows;
    made.xDestroy = made.xDisconnect = disconnect_rows;
    made.xBestIndex = choose_index;
    made.xOpen = open_cursor;
    made.xClose = close_cursor;
    made.xFilter = first_row;
    made.xNext = next_row;
    made.xEof = is_at_end;
    made.xColumn = give_value;
    made.xRowid = row_number;
    return made;
  }();
  return &module;
}

class GeoPackageRows final : public RowFile {
 public:
  Status open(const std::string& path, std::span<const EmptyLayer> layers, bool is_new) {
    sqlite3* opened = nullptr;
    constexpr int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX;  // one thread at a time
    const int code = sqlite3_open_v2(path.c_str(), &opened, flags, nullptr);
    database_.reset(opened);
    if (code != SQLITE_OK) return failure();
    // No other program knows the file yet. A new file is deleted on failure.
    if (Status set = run("PRAGMA locking_mode = EXCLUSIVE"); !set) return set;
    if (is_new)
      if (Status set = run("PRAGMA journal_mode = OFF"); !set) return set;
    // Triggers count rows one by one; close() states what they would.
    sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    if (Status begun = run("BEGIN"); !begun) return begun;
    for (const EmptyLayer& layer : layers)
      if (Status prepared = prepare(layer); !prepared) return prepared;
    return success();
  }

  Status add(const Rows& rows) override {
    for (FilledLayer& layer : layers_) {
      layer.rows = &rows;
      const std::size_t own = layer.own_count();
      if (own == 0) continue;
      if (sqlite3_step(layer.insert.get()) != SQLITE_DONE) return failure();
      const int added = sqlite3_changes(database_.get());
      if (!std::cmp_equal(added, own))
        return Error{ErrorCode::unwritable,
                     fmt::format("cannot write: {} of {} rows were added", added, own),
                     {}};
      layer.count += added;
      sqlite3_reset(layer.insert.get());
    }
    return success();
  }

  Status close() override {
    sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_ENABLE_TRIGGER, 1, nullptr);
    for (FilledLayer& layer : layers_) {
      layer.insert.reset();
      if (layer.count == 0) continue;
      if (Status told = tell(layer); !told) return told;
    }
    if (Status done = run("COMMIT"); !done) return done;
    return sqlite3_close(database_.release()) == SQLITE_OK ? success() : Status(failure());
  }

 private:
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
    FilledLayer& layer = layers_.emplace_back();
    layer.name = of.name;
    layer.number = layers_.size() - 1;
    layer.kind = of.kind;
    layer.columns = of.columns.size();
    const Statement srs =
        statement("SELECT srs_id FROM gpkg_geometry_columns WHERE table_name = ?");
    if (!srs) return failure();
    bind_text(srs, 1, of.name);
    if (sqlite3_step(srs.get()) != SQLITE_ROW) return failure();
    layer.srs = sqlite3_column_int(srs.get(), 0);
    std::string names = sql_name(of.geometry);
    for (const std::string& column : of.columns) names += ", " + sql_name(column);
    // Nothing of the file has this name: the schema `temp` belongs to this connection.
    const std::string module = fmt::format("medial_rows_{}", layer.number), from = "temp." + module;
    if (sqlite3_create_module(database_.get(), module.c_str(), row_module(), &layer) != SQLITE_OK)
      return failure();
    if (Status made = run(fmt::format("CREATE VIRTUAL TABLE {} USING {}", from, module).c_str());
        !made)
      return made;
    layer.insert = statement(
        fmt::format("INSERT INTO main.{} ({}) SELECT * FROM {}", sql_name(of.name), names, from));
    return layer.insert ? success() : Status(failure());
  }

  /// The extent and the number of rows.
  Status tell(const FilledLayer& layer) {
    const Statement extent = statement(
        "UPDATE gpkg_contents SET min_x = ?, min_y = ?, max_x = ?, max_y = ?, "
        "last_change = strftime('%Y-%m-%dT%H:%M:%fZ', 'now') WHERE table_name = ?");
    if (!extent) return failure();
    const Box& box = layer.blob.extent;
    int number = 0;
    for (const double bound : {box.low.x, box.low.y, box.high.x, box.high.y})
      sqlite3_bind_double(extent.get(), ++number, bound);
    bind_text(extent, ++number, layer.name);
    if (sqlite3_step(extent.get()) != SQLITE_DONE) return failure();
    // A table of GDAL's own, which other programs' files lack.
    const Statement counts =
        statement("SELECT 1 FROM sqlite_master WHERE name = 'gpkg_ogr_contents'");
    if (!counts) return failure();
    if (sqlite3_step(counts.get()) != SQLITE_ROW) return success();
    const Statement count =
        statement("UPDATE gpkg_ogr_contents SET feature_count = ? WHERE table_name = ?");
    if (!count) return failure();
    sqlite3_bind_int64(count.get(), 1, layer.count);
    bind_text(count, 2, layer.name);
    return sqlite3_step(count.get()) == SQLITE_DONE ? success() : Status(failure());
  }

  Database database_;
  std::deque<FilledLayer> layers_;  ///< their statements go before the database
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
