#include "medial/io/layers.h"

#include <fmt/format.h>

#include "io/attribute_columns.h"
#include "io/gdal_target.h"
#include "io/output.h"
#include "io/picture.h"
#include "io/place.h"
#include "io/ring_text.h"
#include "io/tables.h"

namespace medial::io {
namespace {

constexpr char layer_formats[] = ".geojson .gpkg .shp .fgb .wkt .svg .pdf .png .ps";

GeometryKind geometry_of(LayerKind kind) {
  if (kind == LayerKind::disks) return GeometryKind::point;
  return kind == LayerKind::lines ? GeometryKind::line : GeometryKind::polygon;
}

/// A table for each layer; in the one collection of a GeoJSON file rows tell their layer.
TableSource layer_tables(const LayerFile& file, const std::string& format) {
  const bool named = format == "geojson";
  std::vector<std::string> own{"feature", "layer"};
  for (const Layer& layer : file.layers)
    own.insert(own.end(), layer.fields.begin(), layer.fields.end());
  std::vector<const Attributes*> items;
  for (const Attributes& item : file.attributes) items.push_back(&item);
  const AttributeColumns attributes(items, own);
  TableSource source;
  source.crs_wkt = file.crs_wkt;
  for (const Layer& layer : file.layers) {
    Table& table = source.tables.emplace_back();
    table.name = layer.name;
    table.kind = geometry_of(layer.kind);
    table.columns.push_back({"feature", ColumnType::whole});
    if (named) table.columns.push_back({"layer", ColumnType::text});
    for (const std::string& field : layer.fields)
      table.columns.push_back({field, ColumnType::real});
    attributes.append_to(table.columns);
  }
  source.fill = [&file, attributes, named](TableSink& sink) {
    for (std::size_t k = 0; k < file.layers.size(); ++k) {
      for (const LayerFeature& feature : file.layers[k].features) {
        std::vector<Value> values{whole(feature.feature)};
        if (named) values.emplace_back(file.layers[k].name);
        values.insert(values.end(), feature.values.begin(), feature.values.end());
        std::vector<Value> rest;
        if (feature.feature < file.attributes.size())
          rest = attributes.values_of(file.attributes[feature.feature]);
        auto parts = feature.parts;
        if (Status added = sink.add(k, values, rest, parts); !added) return added;
      }
    }
    return success();
  };
  return source;
}

/// Well-known text, a geometry a line.
Status write_layers_wkt(OutputStream& out, const LayerFile& file) {
  const Result<OutputCrs> crs = OutputCrs::make(file.crs_wkt);
  if (!crs) return crs.error();
  for (const Layer& layer : file.layers) {
    for (const LayerFeature& feature : layer.features) {
      auto parts = feature.parts;
      const char* separator = layer.kind == LayerKind::disks   ? "POINT "
                              : layer.kind == LayerKind::lines ? "LINESTRING "
                                                               : "POLYGON (";
      for (std::vector<Vec2>& part : parts) {
        if (Status placed = crs->transform(part); !placed) return placed;
        if (layer.kind == LayerKind::polygons && part.front() != part.back())
          part.push_back(part.front());
        out.put(separator);
        put_wkt_points(out, part);
        separator = ", ";
      }
      out.put(layer.kind == LayerKind::polygons ? ")\n" : "\n");
    }
  }
  return success();
}

}  // namespace

std::string known_layer_formats() { return layer_formats; }

Status write_layers(const std::string& path, const std::string& format, const LayerFile& file,
                    const Document<AxisItem>& background, const WriteOptions& options) {
  const Result<std::string> known = output_format(path, format, "geojson", known_layer_formats());
  if (!known) return known.error();
  const auto refused = [&path](ErrorCode code, std::string text) {
    return Error{code, std::move(text), in_file(path)};
  };
  if ((*known == "shp" || *known == "fgb") && file.layers.size() != 1)
    return refused(ErrorCode::unsupported,
                   fmt::format(".{} holds one layer only, and there are {}; .gpkg and .geojson "
                               "hold several",
                               *known, file.layers.size()));
  if (holds_tables(*known)) return write_tables(path, *known, "medial", layer_tables(file, *known));
  return write_whole(path, [&](OutputStream& out) {
    return *known == "wkt" ? write_layers_wkt(out, file)
                           : write_layers_picture(out, *known, file, background, options);
  });
}

}  // namespace medial::io
