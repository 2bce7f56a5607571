#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "io/attribute_columns.h"
#include "io/axis_samples.h"
#include "io/tables.h"
#include "medial/centreline.h"
#include "medial/query.h"

namespace medial::io {

namespace {

constexpr std::size_t branch_table = 0, node_table = 1;

const std::vector<Column>& branch_columns() {
  constexpr ColumnType whole = ColumnType::whole, real = ColumnType::real, text = ColumnType::text;
  static const std::vector<Column> columns{
      {"feature", whole}, {"branch", whole},   {"r_from", real},
      {"r_to", real},     {"length", real},    {"r_min", real},
      {"r_max", real},    {"site_left", text}, {"site_right", text}};
  return columns;
}

const std::vector<Column>& node_columns() {
  constexpr ColumnType whole = ColumnType::whole, real = ColumnType::real, text = ColumnType::text;
  static const std::vector<Column> columns{
      {"feature", whole}, {"node", whole}, {"r", real}, {"kind", text}};
  return columns;
}

/// "ring/vertex" (a colon would make readers take it for a time of day); empty for no site.
std::string site_text(const MedialAxis& axis, std::uint32_t site) {
  if (site == no_site) return {};
  return fmt::format("{}/{}", axis.sites[site].ring, axis.sites[site].vertex);
}

Status add_branches(TableSink& sink, std::size_t index, const AxisItem& item,
                    std::span<const Value> attributes, const WriteOptions& options) {
  const MedialAxis& axis = item.axis;
  const double chord = chord_of(item, options);
  const std::vector<Branch> all = branches(axis);
  std::array<std::vector<Vec2>, 1> parts;
  std::vector<Value> values(branch_columns().size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Branch& branch = all[i];
    parts[0].clear();
    for (const Disk& disk : sample(axis, branch, chord)) parts[0].push_back(disk.center);
    double total = 0;
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0;
    for (const Step& step : branch.steps) {
      const Edge& edge = axis.edges[step.edge];
      total += length(axis, edge);
      const double low = narrowest_place(axis, step.edge).t;
      const double high = widest_place(axis, step.edge).t;
      smallest = std::min(smallest, disk_at(axis, edge, low).radius);
      largest = std::max(largest, disk_at(axis, edge, high).radius);
    }
    const Step& first = branch.steps.front();
    const auto& site = axis.edges[first.edge].site;
    values[0] = whole(index);
    values[1] = whole(i);
    values[2] = axis.nodes[branch.from].disk.radius;
    values[3] = axis.nodes[branch.to].disk.radius;
    values[4] = total;
    values[5] = smallest;
    values[6] = largest;
    values[7] = site_text(axis, site[first.forward ? 0 : 1]);
    values[8] = site_text(axis, site[first.forward ? 1 : 0]);
    if (Status added = sink.add(branch_table, values, attributes, parts); !added) return added;
  }
  return success();
}

Status add_nodes(TableSink& sink, std::size_t index, const AxisItem& item,
                 std::span<const Value> attributes) {
  constexpr std::array<const char*, 3> kinds{"leaf", "site_change", "branching"};
  std::array<std::vector<Vec2>, 1> parts;
  std::vector<Value> values(node_columns().size());
  for (std::size_t i = 0; i < item.axis.nodes.size(); ++i) {
    const Node& node = item.axis.nodes[i];
    parts[0].assign(1, node.disk.center);
    values[0] = whole(index);
    values[1] = whole(i);
    values[2] = node.disk.radius;
    values[3] = kinds[static_cast<std::size_t>(node.kind)];
    if (Status added = sink.add(node_table, values, attributes, parts); !added) return added;
  }
  return success();
}

}  // namespace

TableSource tables_of(const AxesOutput& output, const std::string& format) {
  const bool nodes = format == "gpkg";
  std::vector<Column> own = branch_columns();
  own.insert(own.end(), node_columns().begin(), node_columns().end());
  const AttributeColumns attributes(output.document, own);
  TableSource source;
  source.tables.push_back({"axis", GeometryKind::line, attributes.appended_to(branch_columns())});
  if (nodes)
    source.tables.push_back({"nodes", GeometryKind::point, attributes.appended_to(node_columns())});
  source.fill = [&output, attributes, nodes](TableSink& sink) {
    for (std::size_t i = 0; i < output.document.items.size(); ++i) {
      const AxisItem& item = output.document.items[i];
      const std::vector<Value> values = attributes.values_of(item.attributes);
      if (Status added = add_branches(sink, i, item, values, output.options); !added) return added;
      if (!nodes) continue;
      if (Status added = add_nodes(sink, i, item, values); !added) return added;
    }
    return success();
  };
  return source;
}

}  // namespace medial::io
