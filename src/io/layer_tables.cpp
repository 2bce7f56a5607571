#include <algorithm>
#include <array>
#include <string_view>

#include "io/attribute_columns.h"
#include "io/tables.h"

namespace medial::io {

namespace {

GeometryKind geometry_of(LayerKind kind) {
  if (kind == LayerKind::disks) return GeometryKind::point;
  return kind == LayerKind::polygons ? GeometryKind::polygon : GeometryKind::line;
}

/// By its name, as layers in one table share the columns of one name.
ColumnType type_of(std::string_view field) {
  constexpr std::array<std::string_view, 3> whole_fields{"line", "rank", "around_hole"};
  return std::ranges::find(whole_fields, field) == whole_fields.end() ? ColumnType::real
                                                                      : ColumnType::whole;
}

Value value_of(std::string_view field, double value) {
  if (type_of(field) == ColumnType::real) return value;
  return static_cast<std::int64_t>(value);
}

}  // namespace

std::vector<Column> own_columns(const LayersOutput& output) {
  std::vector<Column> own{{"feature", ColumnType::whole}, {"layer", ColumnType::text}};
  for (const Layer& layer : output.document.items)
    for (const std::string& field : layer.fields) own.push_back({field, type_of(field)});
  return own;
}

TableSource tables_of(const LayersOutput& output, const Target& target) {
  const bool named = target.tables == TableRoom::joined;
  const std::vector<Column> own = own_columns(output);
  const AttributeColumns attributes =
      target.columns ? *target.columns : AttributeColumns(output.background, own);
  TableSource source;
  for (const Layer& layer : output.document.items) {
    std::vector<Column> columns(own.begin(), own.begin() + (named ? 2 : 1));
    for (const std::string& field : layer.fields) columns.push_back({field, type_of(field)});
    source.tables.push_back(
        {layer.name, geometry_of(layer.kind), attributes.appended_to(std::move(columns))});
  }
  source.fill = [&output, attributes, named, part = target.part](TableSink& sink) {
    const auto& layers = output.document.items;
    for (std::size_t k = 0; k < layers.size(); ++k) {
      for (const LayerFeature& feature : layers[k].features) {
        std::vector<Value> values{whole(part.number_of(output.background, feature.feature))};
        if (named) values.emplace_back(layers[k].name);
        for (std::size_t i = 0; i < feature.values.size(); ++i)
          values.push_back(value_of(layers[k].fields[i], feature.values[i]));
        const auto rest = attributes.values_of(output.background.items[feature.feature].attributes);
        auto parts = feature.parts;
        if (Status added = sink.add(k, values, rest, parts); !added) return added;
      }
    }
    return success();
  };
  return source;
}

}  // namespace medial::io
