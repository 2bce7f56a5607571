#include "io/features_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "io/gdal_target.h"
#include "io/ring_text.h"
#include "io/table_writer.h"
#include "medial/query.h"

namespace medial::io {

namespace {

constexpr char feature_formats[] = ".json .geojson .gpkg .shp .fgb .csv .svg .pdf .png .ps";

Value whole_or_nothing(std::uint32_t number) { return number == no_site ? Value{} : whole(number); }
Value real(double number) { return std::isfinite(number) ? Value{number} : Value{}; }
Value text_value(const char* words) { return std::string(words); }

void put_values(std::size_t item, const BranchFeatures& branch, std::size_t index,
                const PrimitiveRun& run, std::vector<Value>& values) {
  values.resize(12);
  auto value = values.begin();
  for (const std::uint64_t number :
       {std::uint64_t{item}, std::uint64_t{branch.branch}, std::uint64_t{index}})
    *value++ = whole(number);
  *value++ = text_value(name_of(run.primitive));
  *value++ = text_value(name_of(run.variation));
  for (const double number : {run.length, run.from.disk.radius, run.to.disk.radius,
                              2 * run.mean_radius, run.slope, run.bend, run.turning})
    *value++ = real(number);
}

void put_values(std::size_t item, const BranchFeatures& branch, const AxisFeatures& features,
                std::vector<Value>& values) {
  std::string primitives;
  for (std::uint32_t k = 0; k < branch.run_count; ++k) {
    const PrimitiveRun& run = features.runs[branch.first_run + k];
    if (k > 0) primitives += "; ";
    primitives += name_of(run.primitive);
    if (run.variation == Variation::straight) continue;
    primitives += ' ';
    primitives += name_of(run.variation);
  }
  values.clear();
  values.push_back(whole(item));
  values.push_back(whole(branch.branch));
  values.push_back(text_value(name_of(branch.from_kind)));
  values.push_back(text_value(name_of(branch.to_kind)));
  values.push_back(whole(branch.closed ? 1 : 0));
  for (const double number :
       {branch.length, branch.smallest_radius, branch.largest_radius, branch.mean_width,
        branch.turning, branch.absolute_turning, branch.area, branch.significance})
    values.push_back(real(number));
  values.push_back(whole(branch.run_count));
  values.emplace_back(std::move(primitives));
  for (const BoundarySection& section : branch.side) {
    values.push_back(whole_or_nothing(section.ring));
    values.push_back(whole_or_nothing(section.first_vertex));
    values.push_back(whole_or_nothing(section.last_vertex));
    values.push_back(real(section.length));
  }
}

/// The part of an edge between two parameters, in this order, without its first disk.
void append(const MedialAxis& axis, const Edge& edge, double from, double to, double chord,
            std::vector<Disk>& samples, std::vector<Disk>& line) {
  sample(axis, edge, chord, samples);
  const bool whole_edge = (from == 0 && to == 1) || (from == 1 && to == 0);
  if (line.empty()) line.push_back(disk_at(axis, edge, from));
  if (whole_edge) {
    if (from == 1) std::ranges::reverse(samples);
    line.insert(line.end(), samples.begin() + 1, samples.end());
    return;
  }
  const double pieces = std::ceil(std::fabs(to - from) * static_cast<double>(samples.size() - 1));
  for (double i = 1; i <= pieces; ++i)
    line.push_back(disk_at(axis, edge, from + (to - from) * (i / pieces)));
}

void put_centers(const std::vector<Disk>& line, std::vector<Vec2>& points) {
  points.clear();
  for (const Disk& disk : line) points.push_back(disk.center);
}

// ---- JSON.

void put_value(OutputStream& out, double value) {
  if (std::isfinite(value)) {
    out.put(value);
  } else {
    out.put("null");
  }
}

void put_member(OutputStream& out, std::string_view name, double value) {
  out.put(",\"");
  out.put(name);
  out.put("\":");
  put_value(out, value);
}
void put_member(OutputStream& out, std::string_view name, std::uint64_t value) {
  out.put(",\"");
  out.put(name);
  out.put("\":");
  out.put(value);
}
void put_text(OutputStream& out, std::string_view name, std::string_view value) {
  out.put(",\"");
  out.put(name);
  out.put("\":\"");
  out.put(value);
  out.put('"');
}

void put_point(OutputStream& out, Vec2 p) {
  out.put('[');
  out.put(p.x);
  out.put(',');
  out.put(p.y);
  out.put(']');
}

void put_place(OutputStream& out, std::string_view name, const AxisPlace& place) {
  out.put(",\"");
  out.put(name);
  out.put("\":{\"edge\":");
  out.put(place.edge);
  put_member(out, "t", place.t);
  put_member(out, "x", place.disk.center.x);
  put_member(out, "y", place.disk.center.y);
  put_member(out, "r", place.disk.radius);
  out.put('}');
}

void put_section(OutputStream& out, std::string_view name, const BoundarySection& section) {
  out.put(",\"");
  out.put(name);
  out.put("\":{\"from\":");
  put_point(out, section.from);
  out.put(",\"to\":");
  put_point(out, section.to);
  put_member(out, "length", section.length);
  if (section.ring != no_site) {
    put_member(out, "ring", std::uint64_t{section.ring});
    put_member(out, "first_vertex", std::uint64_t{section.first_vertex});
    put_member(out, "last_vertex", std::uint64_t{section.last_vertex});
  }
  out.put('}');
}

void put_run(OutputStream& out, const PrimitiveRun& run) {
  out.put("{\"primitive\":\"");
  out.put(name_of(run.primitive));
  out.put('"');
  put_text(out, "variation", name_of(run.variation));
  put_member(out, "length", run.length);
  put_member(out, "mean_width", 2 * run.mean_radius);
  put_member(out, "slope", run.slope);
  put_member(out, "bend", run.bend);
  put_member(out, "turning", run.turning);
  put_member(out, "spiral", run.spiral);
  put_place(out, "from", run.from);
  put_place(out, "to", run.to);
  out.put('}');
}

void put_branch(OutputStream& out, const BranchFeatures& branch, const AxisFeatures& features) {
  out.put("{\"branch\":");
  out.put(branch.branch);
  out.put(branch.reversed ? ",\"reversed\":true" : ",\"reversed\":false");
  out.put(branch.closed ? ",\"closed\":true" : ",\"closed\":false");
  put_member(out, "from", std::uint64_t{branch.from});
  put_text(out, "from_kind", name_of(branch.from_kind));
  put_member(out, "to", std::uint64_t{branch.to});
  put_text(out, "to_kind", name_of(branch.to_kind));
  put_member(out, "length", branch.length);
  put_member(out, "smallest_radius", branch.smallest_radius);
  put_member(out, "largest_radius", branch.largest_radius);
  put_member(out, "mean_width", branch.mean_width);
  put_member(out, "turning", branch.turning);
  put_member(out, "absolute_turning", branch.absolute_turning);
  put_member(out, "area", branch.area);
  put_member(out, "significance", branch.significance);
  put_section(out, "left", branch.side[0]);
  put_section(out, "right", branch.side[1]);
  out.put(",\"runs\":[");
  for (std::uint32_t k = 0; k < branch.run_count; ++k) {
    if (k > 0) out.put(',');
    put_run(out, features.runs[branch.first_run + k]);
  }
  out.put("]}");
}

void write_json(OutputStream& out, const Document<AxisItem>& axes,
                std::span<const AxisFeatures> features) {
  out.put("{\"medial_features\":1,\n\"items\":[");
  for (std::size_t i = 0; i < features.size(); ++i) {
    const AxisFeatures& item = features[i];
    const MedialAxis& axis = axes.items[i].axis;
    out.put(i == 0 ? "\n{\"feature\":" : ",\n{\"feature\":");
    out.put(i);
    out.put(",\"attributes\":[");
    const auto& attributes = axes.items[i].attributes;
    for (std::size_t k = 0; k < attributes.size(); ++k)
      out.put(fmt::format("{}[{},{}]", k == 0 ? "" : ",", quoted(attributes[k].first),
                          quoted(attributes[k].second)));
    out.put(']');
    put_member(out, "components", item.components);
    put_member(out, "cycles", item.cycles);
    put_member(out, "ends", item.ends);
    put_member(out, "branchings", item.branchings);
    put_member(out, "closed_branches", item.closed_branches);
    put_member(out, "length", item.length);
    put_member(out, "area", item.area);
    put_member(out, "boundary", item.boundary);
    put_member(out, "largest_radius", item.largest_radius);
    put_member(out, "mean_width", item.mean_width);
    out.put(",\n\"share\":{");
    const char* separator = "\"";
    for (std::size_t p = 0; p < item.share.size(); ++p)
      for (std::size_t v = 0; v < item.share[p].size(); ++v) {
        if (!(item.share[p][v] > 0)) continue;
        out.put(separator);
        separator = ",\"";
        out.put(name_of(static_cast<Primitive>(p)));
        out.put(' ');
        out.put(name_of(static_cast<Variation>(v)));
        out.put("\":");
        out.put(item.share[p][v]);
      }
    out.put("},\n\"points\":[");
    separator = "\n{\"node\":";
    for (std::size_t k = 0; k < item.points.size(); ++k) {
      if (item.points[k] == PointKind::normal) continue;
      const Disk& disk = axis.nodes[k].disk;
      out.put(separator);
      separator = ",\n{\"node\":";
      out.put(k);
      put_text(out, "kind", name_of(item.points[k]));
      put_member(out, "x", disk.center.x);
      put_member(out, "y", disk.center.y);
      put_member(out, "r", disk.radius);
      out.put('}');
    }
    out.put("],\n\"branches\":[");
    for (std::size_t k = 0; k < item.branches.size(); ++k) {
      out.put(k == 0 ? "\n" : ",\n");
      put_branch(out, item.branches[k], item);
    }
    out.put("]}");
  }
  out.put("\n]}\n");
}

// ---- CSV.

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
Status write_table(OutputStream& out, const Document<AxisItem>& axes,
                   std::span<const AxisFeatures> features, FeatureTable table) {
  const Result<OutputCrs> crs = OutputCrs::make(axes.crs_wkt);
  if (!crs) return crs.error();
  const char* comma = "";
  for (const Column& column : columns_of(table)) {
    out.put(comma);
    out.put(column.name);
    comma = ",";
  }
  out.put(table == FeatureTable::points ? ",x,y\n" : ",x_from,y_from,x_to,y_to\n");
  for (std::size_t i = 0; i < features.size(); ++i) {
    // The ends are all that is wanted: any chord does.
    const double chord = std::numeric_limits<double>::max();
    const Status written = for_each_row(table, i, axes.items[i].axis, features[i], chord,
                                        [&](TableRow& row) -> Status {
                                          comma = "";
                                          for (const Value& value : row.values) {
                                            out.put(comma);
                                            put_csv(out, value);
                                            comma = ",";
                                          }
                                          std::vector<Vec2> places{row.points.front()};
                                          if (table != FeatureTable::points)
                                            places.push_back(row.points.back());
                                          if (Status placed = crs->transform(places); !placed)
                                            return placed;
                                          for (const Vec2 p : places) {
                                            out.put(',');
                                            put_point(out, p, ',');
                                          }
                                          out.put('\n');
                                          return success();
                                        });
    if (!written) return written;
  }
  return success();
}

}  // namespace

const char* name_of(FeatureTable table) {
  constexpr std::array<const char*, 3> names{"runs", "branches", "points"};
  return names[static_cast<std::size_t>(table)];
}

std::vector<std::vector<Disk>> lines_of(const MedialAxis& axis, const AxisFeatures& features,
                                        const BranchFeatures& branch, const Branch& chain,
                                        double chord) {
  std::vector<Step> way = chain.steps;
  if (branch.reversed) {
    std::ranges::reverse(way);
    for (Step& step : way) step.forward = !step.forward;
  }
  std::vector<std::vector<Disk>> lines(branch.run_count);
  std::vector<Disk> samples;
  std::size_t at = 0;
  for (std::uint32_t k = 0; k < branch.run_count; ++k) {
    const PrimitiveRun& run = features.runs[branch.first_run + k];
    std::size_t searched = 0;
    while (way[at].edge != run.from.edge && ++searched < way.size()) at = (at + 1) % way.size();
    double from = run.from.t;
    for (std::size_t walked = 0; walked <= way.size(); ++walked) {
      const Step& step = way[at];
      const Edge& edge = axis.edges[step.edge];
      const bool ahead = step.forward ? from < run.to.t : from > run.to.t;
      // A closed run ends on the edge that it begins on, behind its start.
      if (step.edge == run.to.edge && (ahead || walked > 0)) {
        append(axis, edge, from, run.to.t, chord, samples, lines[k]);
        break;
      }
      append(axis, edge, from, step.forward ? 1 : 0, chord, samples, lines[k]);
      at = (at + 1) % way.size();
      from = way[at].forward ? 0 : 1;
    }
  }
  return lines;
}

Status for_each_row(FeatureTable table, std::size_t item, const MedialAxis& axis,
                    const AxisFeatures& features, double chord,
                    const std::function<Status(TableRow&)>& visit) {
  TableRow row;  // one, whose memory is kept
  if (table == FeatureTable::points) {
    const Incidence incidence(axis);
    row.values.resize(5);
    for (std::uint32_t i = 0; i < features.points.size(); ++i) {
      if (features.points[i] == PointKind::normal) continue;
      const Disk& disk = axis.nodes[i].disk;
      row.values[0] = whole(item);
      row.values[1] = whole(i);
      row.values[2] = text_value(name_of(features.points[i]));
      row.values[3] = whole(incidence.degree(i));
      row.values[4] = real(disk.radius);
      row.points.assign(1, disk.center);
      if (Status visited = visit(row); !visited) return visited;
    }
    return success();
  }
  const std::vector<Branch> all = branches(axis);
  for (const BranchFeatures& branch : features.branches) {
    const Branch& chain = all[branch.branch];
    if (table == FeatureTable::branches) {
      std::vector<Disk> line = sample(axis, chain, chord);
      if (branch.reversed) std::ranges::reverse(line);
      put_values(item, branch, features, row.values);
      put_centers(line, row.points);
      if (Status visited = visit(row); !visited) return visited;
      continue;
    }
    const auto lines = lines_of(axis, features, branch, chain, chord);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      put_values(item, branch, k, features.runs[branch.first_run + k], row.values);
      put_centers(lines[k], row.points);
      if (Status visited = visit(row); !visited) return visited;
    }
  }
  return success();
}

std::string known_feature_formats() { return feature_formats; }

Status write_features(const std::string& path, const std::string& format,
                      const Document<AxisItem>& axes, std::span<const AxisFeatures> features,
                      const FeatureWriteOptions& options) {
  const Result<std::string> known = output_format(path, format, "json", feature_formats);
  if (!known) return known.error();
  if (holds_tables(*known))
    return write_tables(path, *known, "features", features_tables(axes, features, *known, options));
  return write_whole(path, [&](OutputStream& out) -> Status {
    if (*known == "json") {
      write_json(out, axes, features);
      return success();
    }
    if (*known == "csv") return write_table(out, axes, features, options.table);
    return write_features_picture(out, *known, axes, features, options);
  });
}

}  // namespace medial::io
