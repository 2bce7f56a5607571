#pragma once

// What the writers of features share: tables whose rows have a geometry and values by column.

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "io/output.h"
#include "medial/io/features.h"
#include "medial/query.h"

namespace medial::io {

/// Nothing, a whole number, a real one, or a text.
using Value = std::variant<std::monostate, std::int64_t, double, std::string>;

enum class ColumnType : std::uint8_t { whole, real, text };
struct TableColumn {
  const char* name;  ///< at most ten characters: a shapefile has no more
  ColumnType type;
};

/// The columns of a table, in order.
std::span<const TableColumn> columns_of(FeatureTable table);
const char* name_of(FeatureTable table);

/// A row: its values, and its geometry, which is one point or a line.
struct TableRow {
  std::vector<Value> values;
  std::vector<Vec2> points;
};

/// The rows of a table of one item; `chord` is the largest deviation of lines, in units of the
/// input.
std::vector<TableRow> rows_of(FeatureTable table, std::size_t item, const MedialAxis& axis,
                              const AxisFeatures& features, double chord);

/// The runs of a branch as lines of disks, in the branch's direction.
std::vector<std::vector<Disk>> lines_of(const MedialAxis& axis, const AxisFeatures& features,
                                        const BranchFeatures& branch, const Branch& chain,
                                        double chord);

/// By GDAL: see write_features(). Errors: unwritable, unsupported.
Status write_features_gdal(const std::string& path, const std::string& format,
                           const NativeFile& axes, std::span<const AxisFeatures> features,
                           const FeatureWriteOptions& options);

/// A picture by Cairo. Errors: invalid_option (the width), unwritable.
Status write_features_picture(OutputStream& out, const std::string& format, const NativeFile& axes,
                              std::span<const AxisFeatures> features,
                              const FeatureWriteOptions& options);

}  // namespace medial::io
