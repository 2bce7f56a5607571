#include "io/attribute_columns.h"
#include "io/features_writer.h"
#include "io/table_writer.h"

namespace medial::io {

namespace {

/// The input's attributes, named apart from the columns of every table.
AttributeColumns feature_attribute_columns(const Document<AxisItem>& axes) {
  std::vector<const Attributes*> items;
  for (const AxisItem& item : axes.items) items.push_back(&item.attributes);
  std::vector<std::string> own;
  for (const FeatureTable table :
       {FeatureTable::runs, FeatureTable::branches, FeatureTable::points})
    for (const Column& column : columns_of(table)) own.push_back(column.name);
  return {items, own};
}

}  // namespace

std::vector<Column> columns_of(FeatureTable table) {
  constexpr ColumnType whole = ColumnType::whole, real = ColumnType::real, text = ColumnType::text;
  switch (table) {
    case FeatureTable::runs:
      return {{"feature", whole},   {"branch", whole}, {"run", whole},   {"primitive", text},
              {"variation", text},  {"length", real},  {"r_from", real}, {"r_to", real},
              {"mean_width", real}, {"slope", real},   {"bend", real},   {"turning", real}};
    case FeatureTable::branches:
      return {
          {"feature", whole},    {"branch", whole},   {"from_kind", text},  {"to_kind", text},
          {"closed", whole},     {"length", real},    {"r_min", real},      {"r_max", real},
          {"mean_width", real},  {"turning", real},   {"abs_turn", real},   {"area", real},
          {"signif", real},      {"runs", whole},     {"primitives", text}, {"left_ring", whole},
          {"left_from", whole},  {"left_to", whole},  {"left_len", real},   {"right_ring", whole},
          {"right_from", whole}, {"right_to", whole}, {"right_len", real}};
    case FeatureTable::points:
      break;
  }
  return {{"feature", whole}, {"node", whole}, {"kind", text}, {"degree", whole}, {"r", real}};
}

TableSource features_tables(const Document<AxisItem>& axes, std::span<const AxisFeatures> features,
                            const std::string& format, const FeatureWriteOptions& options) {
  std::vector<FeatureTable> wanted{options.table};
  if (format == "gpkg") wanted = {FeatureTable::runs, FeatureTable::branches, FeatureTable::points};
  const AttributeColumns attributes = feature_attribute_columns(axes);
  TableSource source;
  source.crs_wkt = axes.crs_wkt;
  for (const FeatureTable table : wanted) {
    const bool points = table == FeatureTable::points;
    source.tables.push_back(
        {name_of(table), points ? GeometryKind::point : GeometryKind::line, columns_of(table)});
    attributes.append_to(source.tables.back().columns);
  }
  source.fill = [&axes, features, &options, attributes, wanted](TableSink& sink) {
    for (std::size_t i = 0; i < features.size(); ++i) {
      const AxisItem& item = axes.items[i];
      const std::vector<Value> values = attributes.values_of(item.attributes);
      const double chord = chord_of(item, options.write);
      for (std::size_t table = 0; table < wanted.size(); ++table) {
        const Status written =
            for_each_row(wanted[table], i, item.axis, features[i], chord, [&](TableRow& row) {
              return sink.add(table, row.values, values, {&row.points, 1});
            });
        if (!written) return written;
      }
    }
    return success();
  };
  return source;
}

}  // namespace medial::io
