// Regions as tables: offset curves, shapes and Voronoi diagrams for formats of GIS.

#include "io/attribute_columns.h"
#include "io/ring_text.h"
#include "io/tables.h"
#include "io/voronoi_parts.h"

namespace medial::io {

namespace {

constexpr ColumnType whole_type = ColumnType::whole, real_type = ColumnType::real,
                     text_type = ColumnType::text;

std::vector<std::vector<Vec2>> parts_of(const std::vector<Ring>& rings, double chord) {
  std::vector<std::vector<Vec2>> parts;
  for (const Ring& ring : rings) parts.push_back(chords_of(ring, chord));
  return parts;
}

/// "0 3 17": what lies in a buffer.
std::string list_of(const std::vector<std::uint32_t>& numbers) {
  std::string text;
  for (const std::uint32_t number : numbers) {
    if (!text.empty()) text += ' ';
    text += std::to_string(number);
  }
  return text;
}

Status add_regions(TableSink& sink, const OffsetItem& item, std::size_t feature,
                   const AttributeColumns& attributes, double chord) {
  for (std::size_t k = 0; k < item.offsets.regions.size(); ++k) {
    const OffsetRegion& region = item.offsets.regions[k];
    const BufferSource* source = item.sources.empty() ? nullptr : &item.sources[k];
    const std::vector<Value> values{whole(feature),
                                    whole(k),
                                    region.clearance,
                                    region.parent == no_region ? Value{} : whole(region.parent),
                                    area(region),
                                    length(region),
                                    source == nullptr ? Value{} : list_of(source->features)};
    auto parts = parts_of(region.rings, chord);
    const auto rest =
        attributes.values_of(source == nullptr ? item.attributes : source->attributes);
    if (Status added = sink.add(0, values, rest, parts); !added) return added;
  }
  return success();
}

Status add_diagram(TableSink& sink, const Document<VoronoiItem>& file, std::size_t i,
                   const AttributeColumns& attributes, double chord) {
  const VoronoiItem& item = file.items[i];
  const VoronoiDiagram& diagram = item.diagram;
  for (std::uint32_t k = 0; k < diagram.sites.size(); ++k) {
    std::vector<std::vector<Vec2>> parts{ring_of_face(diagram, k, chord)};
    if (parts[0].empty()) continue;
    const Site& site = diagram.sites[k];
    const Owner owner = owner_of(file, i, site);
    const std::vector<Value> values{whole(owner.feature), whole(k),
                                    std::string(name_of(item, site)),
                                    whole(ring_in_feature(item, site)), whole(site.vertex)};
    if (Status added = sink.add(0, values, attributes.values_of(*owner.attributes), parts); !added)
      return added;
  }
  for (const VoronoiEdge& edge : diagram.edges) {
    std::vector<std::vector<Vec2>> line(1);
    for (const Disk& disk : sample_by_chord(diagram, edge, chord)) line[0].push_back(disk.center);
    const std::optional<Owner> owner = owner_of(file, i, edge);
    const std::vector<Value> values{owner ? whole(owner->feature) : Value{},
                                    std::string(name_of(edge)),
                                    number_of(edge.site[0]),
                                    number_of(edge.site[1]),
                                    diagram.nodes[edge.node[0]].disk.radius,
                                    diagram.nodes[edge.node[1]].disk.radius};
    if (Status added = sink.add(
            1, values, attributes.values_of(owner ? *owner->attributes : Attributes()), line);
        !added)
      return added;
  }
  return success();
}

}  // namespace

std::vector<Column> own_columns(const OffsetsOutput&) {
  return {{"feature", whole_type}, {"region", whole_type}, {"clearance", real_type},
          {"parent", whole_type},  {"area", real_type},    {"length", real_type},
          {"features", text_type}};
}

TableSource tables_of(const OffsetsOutput& output, const Target& target) {
  const std::vector<Column> own = own_columns(output);
  const AttributeColumns attributes =
      target.columns ? *target.columns : AttributeColumns(output.document, own);
  TableSource source;
  source.tables.push_back({"offsets", GeometryKind::polygon, attributes.appended_to(own)});
  source.fill = [&output, attributes, part = target.part](TableSink& sink) -> Status {
    const auto& items = output.document.items;
    for (std::size_t i = 0; i < items.size(); ++i)
      if (Status added = add_regions(sink, items[i], part.number_of(output.document, i), attributes,
                                     chord_of(items[i], output.options));
          !added)
        return added;
    return success();
  };
  return source;
}

TableSource tables_of(const ShapesOutput& output, const Target&) {
  const std::vector<Column> own{{"feature", whole_type}, {"part", whole_type}};
  const AttributeColumns attributes(output.document, own);
  TableSource source;
  source.tables.push_back({"shapes", GeometryKind::polygon, attributes.appended_to(own)});
  source.fill = [&output, attributes](TableSink& sink) -> Status {
    const auto& items = output.document.items;
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto rest = attributes.values_of(items[i].attributes);
      const double chord = chord_of(items[i], output.options);
      std::uint64_t part = 0;
      for (const std::vector<Ring>& polygon : polygons_of(items[i].shape)) {
        auto parts = parts_of(polygon, chord);
        const std::vector<Value> values{whole(output.document.index_of(i)), whole(part++)};
        if (Status added = sink.add(0, values, rest, parts); !added) return added;
      }
    }
    return success();
  };
  return source;
}

TableSource tables_of(const VoronoiOutput& output, const Target&) {
  const std::vector<Column> faces{{"feature", whole_type},
                                  {"site", whole_type},
                                  {"kind", text_type},
                                  {"ring", whole_type},
                                  {"vertex", whole_type}},
      edges{{"feature", whole_type}, {"kind", text_type},   {"left", whole_type},
            {"right", whole_type},   {"r_from", real_type}, {"r_to", real_type}};
  std::vector<Column> own = faces;
  own.insert(own.end(), edges.begin(), edges.end());
  const AttributeColumns attributes(output.document, own);
  TableSource source;
  source.tables.push_back({"faces", GeometryKind::polygon, attributes.appended_to(faces)});
  source.tables.push_back({"edges", GeometryKind::line, attributes.appended_to(edges)});
  source.fill = [&output, attributes](TableSink& sink) -> Status {
    const auto& items = output.document.items;
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (Status added =
              add_diagram(sink, output.document, i, attributes, chord_of(items[i], output.options));
          !added)
        return added;
    }
    return success();
  };
  return source;
}

}  // namespace medial::io
