// Comma-separated values: samples of axes and diagrams, tables of features, width profiles, tool
// paths.

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "io/axis_samples.h"
#include "io/features_tables.h"
#include "io/formats/text.h"
#include "io/ring_text.h"
#include "io/tool_paths.h"
#include "io/voronoi_parts.h"

namespace medial::io {

namespace {

/// The end of a row, or of the first one, which names the columns. The last column is the unit,
/// where one is known.
void end_row(Target& target, bool names = false) {
  if (!target.unit.empty()) {
    target.out->put(',');
    target.out->put(names ? std::string_view("unit") : std::string_view(target.unit));
  }
  target.out->put('\n');
}
void put_names(Target& target, std::string_view names) {
  target.out->put(names);
  end_row(target, true);
}

/// A row: `before`, and the numbers behind it, each after a comma.
void put_values(Target& target, std::string_view before, std::initializer_list<double> values) {
  target.out->put(before);
  for (const double value : values) {
    target.out->put(',');
    target.out->put(value);
  }
  end_row(target);
}

void put_disks(Target& target, const std::string& before, const std::vector<Disk>& disks) {
  for (const Disk& disk : disks)
    put_values(target, before, {disk.center.x, disk.center.y, disk.radius});
}

/// A row for each sample; edges count through all items. Samples of an edge follow each other, the
/// nodes first and last.
Status write_csv(Target& target, const AxesOutput& output) {
  if (target.part.begins) put_names(target, "edge,x,y,r");
  std::uint64_t id = target.part.edge;
  std::vector<Disk> samples;
  for (const AxisItem& item : output.document.items) {
    const double chord = chord_of(item, output.options);
    for (const Edge& edge : item.axis.edges) {
      sample(item.axis, edge, chord, samples);
      target.place(samples);
      put_disks(target, fmt::format_int(id++).str(), samples);
    }
  }
  return success();
}

Status write_csv(Target& target, const VoronoiOutput& output) {
  put_names(target, "edge,part,left,right,x,y,r");
  std::uint64_t number = 0;
  for (const VoronoiItem& item : output.document.items) {
    const double chord = chord_of(item, output.options);
    for (const VoronoiEdge& edge : item.diagram.edges) {
      std::vector<Disk> line = sample_by_chord(item.diagram, edge, chord);
      target.place(line);
      put_disks(target,
                fmt::format("{},{},{},{}", number++, name_of(edge), number_of(edge.site[0]),
                            number_of(edge.site[1])),
                line);
    }
  }
  return success();
}

void put_csv(OutputStream& out, const Value& value) {
  if (const auto* number = std::get_if<std::int64_t>(&value)) {
    out.put(*number);
  } else if (const auto* decimal = std::get_if<double>(&value)) {
    out.put(*decimal);
  } else if (const auto* words = std::get_if<std::string>(&value)) {
    out.put(*words);  // names: no comma, no quote
  }
}

/// The table without lines: their ends, or the point.
Status write_csv(Target& target, const FeaturesOutput& output) {
  OutputStream& out = *target.out;
  const bool points = output.own.table == FeatureTable::points;
  for (const Column& column : columns_of(output.own.table)) {
    out.put(column.name);
    out.put(',');
  }
  put_names(target, points ? "x,y" : "x_from,y_from,x_to,y_to");
  const auto put_row = [&](TableRow& row) {
    for (const Value& value : row.values) {
      put_csv(out, value);
      out.put(',');
    }
    std::vector<Vec2> places{row.points.front()};
    if (!points) places.push_back(row.points.back());
    target.place(places);
    for (const Vec2& p : places) {
      put_point(out, p, ',');
      if (&p != &places.back()) out.put(',');
    }
    end_row(target);
    return target.status();
  };
  for (std::size_t i = 0; i < output.features.size(); ++i) {
    // The ends are all that is wanted: any chord does.
    const double chord = std::numeric_limits<double>::max();
    Status written =
        for_each_row(output.own.table, output.document.index_of(i), output.document.items[i].axis,
                     output.features[i], chord, put_row);
    if (!written) return written;
  }
  return success();
}

Status write_csv(Target& target, const CarvingOutput& output) {
  put_names(target, "path,kind,x,y,z");
  std::uint64_t id = 0;
  for (const CarveItem& item : output.document.items) {
    // Next to where offsets of two sides meet, a tangent may come nearer to the other side than its
    // arc does, by as much as it is away from that.
    constexpr double fine = 1e-6;
    for_each_path(item, [&](const Carving& carving, const ToolPath& path, const char* kind) {
      const double chord =
          output.machine.chord > 0
              ? output.machine.chord
              : fine * std::max(carving.tip_radius, carving.slope * carving.deepest);
      const std::string before = fmt::format("{},{}", id++, kind);
      for (const ToolPoint& point : without_arcs(path, chord))
        put_values(target, before, {point.point.x, point.point.y, point.z});
    });
  }
  return success();
}

/// A width profile. Widths are in the unit that is named, wherever the places are.
Status write_csv(Target& target, const LayersOutput& output) {
  const auto& layers = output.document.items;
  if (layers.size() != 1 || layers[0].kind != LayerKind::profile)
    return Error{ErrorCode::unsupported, ".csv holds width profiles; use .geojson or .gpkg", {}};
  const std::string unit = name_of(output.document.unit);
  const std::string end = unit.empty() ? "\n" : "," + unit + "\n";
  if (target.part.begins) {
    target.out->put("feature,line,along,x,y,width,span,left_x,left_y,right_x,right_y");
    target.out->put(unit.empty() ? "\n" : ",unit\n");
  }
  std::vector<Vec2> places;
  for (const LayerFeature& at : layers[0].features)
    places.insert(places.end(), at.parts[0].begin(), at.parts[0].end());
  target.place(places);
  auto place = places.begin();
  for (const LayerFeature& at : layers[0].features) {
    const Vec2 center = *place++, left = *place++, right = *place++;
    const auto& value = at.values;
    target.out->put(fmt::format("{},{},{},{},{},{},{},{},{},{},{}{}",
                                target.part.number_of(output.background, at.feature), value[0],
                                value[1], center.x, center.y, value[2], value[3], left.x, left.y,
                                right.x, right.y, end));
  }
  return success();
}

Result<Document<Feature>> read_vertices(const Input& input, const ReadOptions& options) {
  return read_xy(*input.source, options.loose);
}

}  // namespace

/// Files of two columns hold the vertices of rings; other tables are GDAL's.
Format csv_format() {
  Format format{".csv"};
  format.read = read_vertices;
  format.accepts = has_two_columns;
  format.gdal_chooses = true;
  format.geographic = format.in_parts = true;
  format.growing = Growing::edges;
  return format.writes<AxesOutput, VoronoiOutput, FeaturesOutput, LayersOutput, CarvingOutput>(
      write_csv, write_csv, write_csv, write_csv, write_csv);
}

Format xy_format() {
  Format format{".txt .xy"};
  format.read = read_vertices;
  format.sniff = begins_like_xy;
  return format;
}

}  // namespace medial::io
