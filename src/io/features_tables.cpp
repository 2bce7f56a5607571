#include "io/features_tables.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "axis/steps.h"
#include "io/attribute_columns.h"
#include "io/axis_samples.h"

namespace medial::io {

namespace {

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

constexpr std::array<FeatureTable, 3> all_tables{FeatureTable::runs, FeatureTable::branches,
                                                 FeatureTable::points};

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

TableSource tables_of(const FeaturesOutput& output, const Target& target) {
  std::vector<FeatureTable> wanted{output.own.table};
  if (target.tables == TableRoom::several) wanted.assign(all_tables.begin(), all_tables.end());
  std::vector<Column> own;
  for (const FeatureTable table : all_tables)
    for (const Column& column : columns_of(table)) own.push_back(column);
  const AttributeColumns attributes(output.document, own);
  TableSource source;
  for (const FeatureTable table : wanted) {
    const bool points = table == FeatureTable::points;
    source.tables.push_back({name_of(table), points ? GeometryKind::point : GeometryKind::line,
                             attributes.appended_to(columns_of(table))});
  }
  source.fill = [&output, attributes, wanted](TableSink& sink) {
    for (std::size_t i = 0; i < output.features.size(); ++i) {
      const AxisItem& item = output.document.items[i];
      const std::vector<Value> values = attributes.values_of(item.attributes);
      const double chord = chord_of(item, output.options);
      for (std::size_t table = 0; table < wanted.size(); ++table) {
        Status written =
            for_each_row(wanted[table], output.document.index_of(i), item.axis, output.features[i],
                         chord, [&](TableRow& row) {
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
