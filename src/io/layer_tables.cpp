#include "io/attribute_columns.h"
#include "io/tables.h"

namespace medial::io {

namespace {

GeometryKind geometry_of(LayerKind kind) {
  if (kind == LayerKind::disks) return GeometryKind::point;
  return kind == LayerKind::polygons ? GeometryKind::polygon : GeometryKind::line;
}

}  // namespace

std::vector<Column> own_columns(const LayersOutput& output) {
  std::vector<Column> own{{"feature", ColumnType::whole}, {"layer", ColumnType::text}};
  for (const Layer& layer : output.document.items)
    for (const std::string& field : layer.fields) own.push_back({field, ColumnType::real});
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
    for (const std::string& field : layer.fields) columns.push_back({field, ColumnType::real});
    source.tables.push_back(
        {layer.name, geometry_of(layer.kind), attributes.appended_to(std::move(columns))});
  }
  source.fill = [&output, attributes, named, part = target.part](TableSink& sink) {
    const auto& layers = output.document.items;
    for (std::size_t k = 0; k < layers.size(); ++k) {
      for (const LayerFeature& feature : layers[k].features) {
        std::vector<Value> values{whole(part.number_of(output.background, feature.feature))};
        if (named) values.emplace_back(layers[k].name);
        values.insert(values.end(), feature.values.begin(), feature.values.end());
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
