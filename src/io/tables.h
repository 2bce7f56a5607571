#pragma once

// Tables whose rows have a geometry and a value for each column, and the files that hold them.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "medial/error.h"
#include "medial/vec2.h"

namespace medial::io {

/// Nothing, a whole number, a real one (not finite: nothing), or a text.
using Value = std::variant<std::monostate, std::int64_t, double, std::string>;

inline Value whole(std::uint64_t number) { return static_cast<std::int64_t>(number); }

enum class ColumnType : std::uint8_t { whole, real, text };
struct Column {
  std::string name;  ///< the writer's own: at most ten characters, a shapefile has no more
  ColumnType type;
};

enum class GeometryKind : std::uint8_t { point, line, polygon };

struct Table {
  std::string name;  ///< of its layer in a GeoPackage; the one layer of other files is named after
                     ///< the file
  GeometryKind kind;
  std::vector<Column> columns;
};

/// Takes the rows of tables.
class TableSink {
 public:
  TableSink() = default;
  TableSink(const TableSink&) = delete;
  TableSink& operator=(const TableSink&) = delete;
  virtual ~TableSink() = default;

  /// Adds a row to a table: the values of its columns, `first` before `rest`; and a point, a line,
  /// or the rings of a polygon with the outer one first, each with a point at least. Where the
  /// reference system is a local projection, the points become longitudes and latitudes in place.
  /// Errors: unwritable, unsupported (points that cannot be projected).
  virtual Status add(std::size_t table, std::span<const Value> first, std::span<const Value> rest,
                     std::span<std::vector<Vec2>> parts) = 0;
};

/// What a file of tables holds.
struct TableSource {
  std::vector<Table> tables;
  std::string crs_wkt;
  std::function<Status(TableSink& sink)> fill;  ///< adds all rows
};

/// Whether a format holds tables: geojson, gpkg, shp, fgb.
bool holds_tables(const std::string& format);

/// Writes tables all at once, or to a stream: GeoJSON as one collection (all tables one after
/// another), a GeoPackage with a layer for each; of shapefiles and FlatGeobuf one table only.
/// `name` is what the layer of a stream is called. Errors: unsupported, unwritable, and those of
/// `fill`; they name the file.
Status write_tables(const std::string& path, const std::string& format, const std::string& name,
                    const TableSource& source);

}  // namespace medial::io
