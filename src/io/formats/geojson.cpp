// GeoJSON (RFC 7946), written number by number: through GDAL's feature objects it takes four times
// as long.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "io/attribute_columns.h"
#include "io/formats/json.h"
#include "io/formats/json_text.h"
#include "io/reference_system.h"
#include "io/ring_text.h"
#include "io/tables.h"
#include "io/voronoi_parts.h"

namespace medial::io {

namespace {

/// A number that readers take for a real one, also where it is whole.
void put_real(OutputStream& out, double value) {
  if (value != std::trunc(value)) return out.put(value);
  std::array<char, 40> digits{};
  const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  const std::string_view text(digits.data(), static_cast<std::size_t>(end - digits.data()));
  out.put(text);
  if (text.find_first_not_of("-0123456789") == std::string_view::npos) out.put(".0");
}

void put_value(OutputStream& out, const Value& value) {
  if (const auto* number = std::get_if<std::int64_t>(&value)) {
    out.put(*number);
  } else if (const auto* decimal = std::get_if<double>(&value);
             decimal && std::isfinite(*decimal)) {
    put_real(out, *decimal);
  } else if (const auto* words = std::get_if<std::string>(&value)) {
    put_quoted(out, *words);
  } else {
    out.put("null");
  }
}

/// A collection of features, one by one: start(), key() and a value for each property, geometry(),
/// coordinates, end().
class Collection {
 public:
  explicit Collection(Target& target, bool named = false)
      : target_(target), out_(*target.out), first_feature_(target.part.begins) {
    if (!target.part.begins) return;
    out_.put("{\"type\":\"FeatureCollection\",");
    if (named) out_.put(fmt::format("\"name\":{},", json_quoted(target.name)));
    const std::string urn = urn_of_crs(target.crs.wkt);
    if (!urn.empty())
      out_.put(fmt::format("\"crs\":{{\"type\":\"name\",\"properties\":{{\"name\":{}}}}},",
                           json_quoted(urn)));
    if (!target.unit.empty()) out_.put(fmt::format("\"unit\":{},", json_quoted(target.unit)));
    out_.put("\"features\":[");
  }
  void start() {
    out_.put(first_feature_ ? "\n" : ",\n");
    first_feature_ = false;
    out_.put("{\"type\":\"Feature\",\"properties\":{");
    first_member_ = true;
  }
  /// The key of a property, as a JSON string; its value is put next.
  void key(std::string_view quoted_key) {
    if (!first_member_) out_.put(',');
    first_member_ = false;
    out_.put(quoted_key);
    out_.put(':');
  }
  template <class V>
  void member(std::string_view quoted_key, const V& value) {
    key(quoted_key);
    put_json(out_, value);
  }
  void attributes(const AttributeColumns& columns, const Attributes& item) {
    const std::vector<Value> values = columns.values_of(item);
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (std::holds_alternative<std::monostate>(values[k])) continue;
      key(json_quoted(columns.columns()[k].name));
      put_value(out_, values[k]);
    }
  }
  /// Properties end; the geometry's coordinates are put next.
  void geometry(std::string_view type) {
    out_.put("},\"geometry\":{\"type\":\"");
    out_.put(type);
    out_.put("\",\"coordinates\":");
  }
  /// Points in their places of the output.
  void points(std::vector<Vec2> points) {
    place({&points, 1});
    put_geojson_points(out_, points);
  }
  /// The rings of a polygon, the outer one first, likewise.
  void polygon(const std::vector<Ring>& rings, double chord) {
    std::vector<std::vector<Vec2>> parts;
    for (const Ring& ring : rings) parts.push_back(chords_of(ring, chord));
    place(parts);
    put_list(out_, parts, [&](const std::vector<Vec2>& part) { put_geojson_points(out_, part); });
  }
  void end() { out_.put("}}"); }
  /// Behind the last feature.
  Status finish() {
    if (target_.part.ends) out_.put("\n]}\n");
    return success();
  }

 private:
  void place(std::span<std::vector<Vec2>> parts) {
    for (std::vector<Vec2>& part : parts) target_.place(part);
    if (target_.crs.within_half_turn) turn_back(parts);
  }

  Target& target_;
  OutputStream& out_;
  bool first_feature_;
  bool first_member_ = true;
};

class GeojsonTables final : public TableSink {
 public:
  GeojsonTables(Target& target, const TableSource& source)
      : TableSink(target), out_(*target.out), tables_(source.tables), collection_(target, true) {
    for (const Table& table : tables_) {
      auto& keys = keys_.emplace_back();
      for (const Column& column : table.columns) keys.push_back(json_quoted(column.name));
    }
  }
  Status finish() { return collection_.finish(); }

 private:
  Status put(std::size_t table, std::span<const Value> first, std::span<const Value> rest,
             std::span<std::vector<Vec2>> parts) override {
    collection_.start();
    std::size_t column = 0;
    for (const auto values : {first, rest}) {
      for (const Value& value : values) {
        collection_.key(keys_[table][column++]);
        put_value(out_, value);
      }
    }
    constexpr std::array<const char*, 3> types{"Point", "LineString", "Polygon"};
    const GeometryKind kind = tables_[table].kind;
    collection_.geometry(types[static_cast<std::size_t>(kind)]);
    if (kind == GeometryKind::point) {
      put_row(out_, parts[0][0].x, parts[0][0].y);
    } else if (kind == GeometryKind::line) {
      put_geojson_points(out_, parts[0]);
    } else {
      put_list(out_, parts, [&](std::vector<Vec2> ring) {
        if (ring.front() != ring.back()) ring.push_back(ring.front());
        put_geojson_points(out_, ring);
      });
    }
    collection_.end();
    return success();
  }

  OutputStream& out_;
  const std::vector<Table>& tables_;
  Collection collection_;
  std::vector<std::vector<std::string>> keys_;  ///< of each table
};

/// All tables as one collection.
Status put_geojson(Target& target, const TableSource& source) {
  GeojsonTables tables(target, source);
  if (Status filled = source.fill(tables); !filled) return filled;
  return tables.finish();
}

/// A MULTIPOLYGON of chords for each shape.
Status write_geojson(Target& target, const ShapesOutput& output) {
  Collection collection(target);
  const AttributeColumns columns(output.document, {});
  for (const ShapeItem& item : output.document.items) {
    const double chord = chord_of(item, output.options);
    collection.start();
    collection.attributes(columns, item.attributes);
    collection.geometry("MultiPolygon");
    put_list(*target.out, polygons_of(item.shape),
             [&](const std::vector<Ring>& polygon) { collection.polygon(polygon, chord); });
    collection.end();
  }
  return collection.finish();
}

/// A polygon of chords for each region.
Status write_geojson(Target& target, const OffsetsOutput& output) {
  Collection collection(target);
  const AttributeColumns columns =
      target.columns ? *target.columns : AttributeColumns(output.document, own_columns(output));
  for (std::size_t i = 0; i < output.document.items.size(); ++i) {
    const OffsetItem& item = output.document.items[i];
    const double chord = chord_of(item, output.options);
    for (std::size_t k = 0; k < item.offsets.regions.size(); ++k) {
      const OffsetRegion& region = item.offsets.regions[k];
      collection.start();
      collection.member("\"feature\"", target.part.number_of(output.document, i));
      collection.member("\"region\"", k);
      collection.member("\"clearance\"", region.clearance);
      collection.key("\"parent\"");
      region.parent == no_region ? target.out->put("null") : target.out->put(region.parent);
      collection.member("\"area\"", area(region));
      collection.member("\"length\"", length(region));
      if (!item.sources.empty()) {
        collection.key("\"features\"");
        put_list(*target.out, item.sources[k].features,
                 [&](std::uint32_t feature) { target.out->put(feature); });
      }
      collection.attributes(columns,
                            item.sources.empty() ? item.attributes : item.sources[k].attributes);
      collection.geometry("Polygon");
      collection.polygon(region.rings, chord);
      collection.end();
    }
  }
  return collection.finish();
}

void put_face(Collection& collection, OutputStream& out, const Document<VoronoiItem>& file,
              std::size_t i, const AttributeColumns& columns, std::uint32_t k, double chord) {
  const VoronoiDiagram& diagram = file.items[i].diagram;
  std::vector<Vec2> ring = ring_of_face(diagram, k, chord);
  if (ring.empty()) return;
  const Site& site = diagram.sites[k];
  const Owner owner = owner_of(file, i, site);
  collection.start();
  collection.member("\"feature\"", owner.feature);
  collection.member("\"part\"", "face");
  collection.member("\"site\"", k);
  collection.member("\"kind\"", name_of(file.items[i], site));
  collection.member("\"ring\"", ring_in_feature(file.items[i], site));
  collection.member("\"vertex\"", site.vertex);
  collection.attributes(columns, *owner.attributes);
  collection.geometry("Polygon");
  out.put('[');
  collection.points(std::move(ring));
  out.put(']');
  collection.end();
}

void put_edge(Collection& collection, OutputStream& out, const Document<VoronoiItem>& file,
              std::size_t i, const AttributeColumns& columns, const VoronoiEdge& edge,
              double chord) {
  const VoronoiDiagram& diagram = file.items[i].diagram;
  const std::optional<Owner> owner = owner_of(file, i, edge);
  collection.start();
  collection.key("\"feature\"");
  owner ? out.put(owner->feature) : out.put("null");
  collection.member("\"part\"", name_of(edge));
  collection.member("\"left\"", number_of(edge.site[0]));
  collection.member("\"right\"", number_of(edge.site[1]));
  collection.member("\"radius_from\"", diagram.nodes[edge.node[0]].disk.radius);
  collection.member("\"radius_to\"", diagram.nodes[edge.node[1]].disk.radius);
  if (owner) collection.attributes(columns, *owner->attributes);
  collection.geometry("LineString");
  std::vector<Vec2> line;
  for (const Disk& disk : sample_by_chord(diagram, edge, chord)) line.push_back(disk.center);
  collection.points(std::move(line));
  collection.end();
}

/// Faces as polygons and edges as lines.
Status write_geojson(Target& target, const VoronoiOutput& output) {
  Collection collection(target);
  std::vector<Column> own;
  for (const char* name : {"feature", "part", "site", "kind", "ring", "vertex", "left", "right",
                           "radius_from", "radius_to"})
    own.push_back({name, ColumnType::text});
  const AttributeColumns columns(output.document, own);
  for (std::size_t i = 0; i < output.document.items.size(); ++i) {
    const VoronoiDiagram& diagram = output.document.items[i].diagram;
    const double chord = chord_of(output.document.items[i], output.options);
    for (std::uint32_t k = 0; k < diagram.sites.size(); ++k)
      put_face(collection, *target.out, output.document, i, columns, k, chord);
    for (const VoronoiEdge& edge : diagram.edges)
      put_edge(collection, *target.out, output.document, i, columns, edge, chord);
  }
  return collection.finish();
}

}  // namespace

Format geojson_format() {
  Format format = native_reading(".geojson");
  format.in_parts = true;
  format.growing = Growing::branches;
  format.tables = TableRoom::joined;
  return with_tables<put_geojson>(format).writes<ShapesOutput, OffsetsOutput, VoronoiOutput>(
      write_geojson, write_geojson, write_geojson);
}

}  // namespace medial::io
