#pragma once

// Features as tables whose rows have a geometry and values by column.

#include <functional>
#include <string>
#include <vector>

#include "io/tables.h"
#include "medial/query.h"

namespace medial::io {

/// The columns of a table, in order.
std::vector<Column> columns_of(FeatureTable table);
const char* name_of(FeatureTable table);

/// A row: its values, and its geometry, which is one point or a line.
struct TableRow {
  std::vector<Value> values;
  std::vector<Vec2> points;
};

/// Calls visit(row), which may change the row, for each row of a table of one item; `chord` is the
/// largest deviation of lines, in units of the input. Errors: those of `visit`.
Status for_each_row(FeatureTable table, std::size_t item, const MedialAxis& axis,
                    const AxisFeatures& features, double chord,
                    const std::function<Status(TableRow& row)>& visit);

/// The runs of a branch as lines of disks, in the branch's direction.
std::vector<std::vector<Disk>> lines_of(const MedialAxis& axis, const AxisFeatures& features,
                                        const BranchFeatures& branch, const Branch& chain,
                                        double chord);

}  // namespace medial::io
