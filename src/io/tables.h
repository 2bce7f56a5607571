#pragma once

// Tables whose rows have a geometry and a value for each column: what formats of GIS and GeoJSON
// hold.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "io/format.h"
#include "medial/geometry.h"

namespace medial::io {

/// Nothing, a whole number, a real one (not finite: nothing), or a text.
using Value = std::variant<std::monostate, std::int64_t, double, std::string>;

inline Value whole(std::uint64_t number) { return static_cast<std::int64_t>(number); }

enum class ColumnType : std::uint8_t { whole, real, text };
struct Column {
  std::string name;  ///< the writer's own: at most ten characters, a shapefile has no more
  ColumnType type;
  bool is_attribute = false;  ///< of the input's features
};

enum class GeometryKind : std::uint8_t { point, line, polygon };

struct Table {
  std::string name;  ///< of its layer in a GeoPackage; in other files the layer is named after them
  GeometryKind kind;
  std::vector<Column> columns;
};

/// Takes the rows of tables.
class TableSink {
 public:
  explicit TableSink(Target& target) : target_(target) {}
  TableSink(const TableSink&) = delete;
  TableSink& operator=(const TableSink&) = delete;
  virtual ~TableSink() = default;

  /// Adds a row to a table: the values of its columns, `first` before `rest`; and a point, a line,
  /// or the rings of a polygon with the outer one first, each with a point at least. The points
  /// become points of the output in place. Errors: unwritable, unsupported (points that cannot be
  /// projected).
  Status add(std::size_t table, std::span<const Value> first, std::span<const Value> rest,
             std::span<std::vector<Vec2>> parts) {
    for (std::vector<Vec2>& part : parts) target_.place(part);
    if (target_.crs.within_half_turn) turn_back(parts);
    return target_.status() ? put(table, first, rest, parts) : target_.status();
  }

 protected:
  virtual Status put(std::size_t table, std::span<const Value> first, std::span<const Value> rest,
                     std::span<std::vector<Vec2>> parts) = 0;

 private:
  Target& target_;
};

/// What a file of tables holds. Refers to what is written.
struct TableSource {
  std::vector<Table> tables;
  std::function<Status(TableSink& sink)> fill;  ///< adds all rows
};

/// The columns that tables have besides the attributes.
std::vector<Column> own_columns(const AxesOutput& output);
std::vector<Column> own_columns(const OffsetsOutput& output);
std::vector<Column> own_columns(const LayersOutput& output);

/// Axes have a line for each branch, and where there is room the nodes as a second table; features
/// all their tables, or where there is room for one that of the options; layers a table each.
/// Lengths and radii are in the units of the document.
TableSource tables_of(const AxesOutput& output, const Target& target);
TableSource tables_of(const FeaturesOutput& output, const Target& target);
TableSource tables_of(const LayersOutput& output, const Target& target);
/// Polygons of chords: one for each region of offset curves, and for each component of a shape. Of
/// Voronoi diagrams the faces, and the edges as a second table.
TableSource tables_of(const OffsetsOutput& output, const Target& target);
TableSource tables_of(const ShapesOutput& output, const Target& target);
TableSource tables_of(const VoronoiOutput& output, const Target& target);

using PutTables = Status (*)(Target& target, const TableSource& source);

template <PutTables put, class Output>
Status write_tables(Target& target, const Output& output) {
  return put(target, tables_of(output, target));
}

/// A format that holds tables of some kinds of documents, written by `put`.
template <PutTables put, class... Outputs>
Format with_tables(Format format) {
  format.geographic = true;
  return format.writes<AxesOutput, FeaturesOutput, LayersOutput, Outputs...>(
      write_tables<put, AxesOutput>, write_tables<put, FeaturesOutput>,
      write_tables<put, LayersOutput>, write_tables<put, Outputs>...);
}

}  // namespace medial::io
