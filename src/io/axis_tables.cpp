#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "io/attribute_columns.h"
#include "io/axis_samples.h"
#include "io/tables.h"
#include "medial/centreline.h"
#include "medial/query.h"
#include "ops/routes.h"

namespace medial::io {

namespace {

constexpr std::size_t branch_table = 0, node_table = 1;

const std::vector<Column>& branch_columns() {
  constexpr ColumnType whole = ColumnType::whole, real = ColumnType::real, text = ColumnType::text;
  static const std::vector<Column> columns{
      {"feature", whole}, {"branch", whole},   {"from_node", whole}, {"to_node", whole},
      {"r_from", real},   {"r_to", real},      {"length", real},     {"r_min", real},
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
  return std::to_string(axis.sites[site].ring) + '/' + std::to_string(axis.sites[site].vertex);
}

/// A feature on its way to the tables.
struct Row {
  const Part& part;
  std::size_t feature = 0;
  std::uint64_t first_node = 0;  ///< nodes are numbered on from feature to feature
  const AxisItem& item;
  const std::vector<Branch>& branches;
  std::span<const Value> attributes;
};

Status add_branches(TableSink& sink, const Row& row, const WriteOptions& options) {
  const MedialAxis& axis = row.item.axis;
  const std::vector<Branch>& all = row.branches;
  std::array<std::vector<Vec2>, 1> parts;
  std::vector<Value> values(branch_columns().size());
  const double chord = chord_of(row.item, options);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Branch& branch = all[i];
    line_of(axis, branch, chord, options.simplify, parts[0]);
    double total = 0;
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0;
    for (const Step& step : branch.steps) {
      const Edge& edge = axis.edges[step.edge];
      total += length(axis, edge);
      const double low = ops::narrowest_place(axis, step.edge).t;
      const double high = ops::widest_place(axis, step.edge).t;
      smallest = std::min(smallest, disk_at(axis, edge, low).radius);
      largest = std::max(largest, disk_at(axis, edge, high).radius);
    }
    const Step& first = branch.steps.front();
    const auto& site = axis.edges[first.edge].site;
    values[0] = whole(row.feature);
    values[1] = whole(row.part.branch + i);
    values[2] = whole(row.part.number_of_node(row.first_node, branch.from));
    values[3] = whole(row.part.number_of_node(row.first_node, branch.to));
    values[4] = axis.nodes[branch.from].disk.radius;
    values[5] = axis.nodes[branch.to].disk.radius;
    values[6] = total;
    values[7] = smallest;
    values[8] = largest;
    values[9] = site_text(axis, site[first.forward ? 0 : 1]);
    values[10] = site_text(axis, site[first.forward ? 1 : 0]);
    if (Status added = sink.add(branch_table, values, row.attributes, parts); !added) return added;
  }
  return success();
}

/// Of each node, whether it lies inside a branch: there the axis only passes to another site.
std::vector<bool> inner_nodes(const MedialAxis& axis, const std::vector<Branch>& branches) {
  std::vector<bool> inner(axis.nodes.size(), false);
  for (const Branch& branch : branches)
    for (std::size_t i = 0; i + 1 < branch.steps.size(); ++i)
      inner[axis.edges[branch.steps[i].edge].node[branch.steps[i].forward ? 1 : 0]] = true;
  return inner;
}

Status add_nodes(TableSink& sink, const Row& row, bool all) {
  constexpr std::array<const char*, 3> kinds{"leaf", "site_change", "branching"};
  std::array<std::vector<Vec2>, 1> parts;
  std::vector<Value> values(node_columns().size());
  const std::vector<bool> inner = inner_nodes(row.item.axis, row.branches);
  for (std::size_t i = 0; i < row.item.axis.nodes.size(); ++i) {
    if (inner[i] && !all) continue;
    const Node& node = row.item.axis.nodes[i];
    parts[0].assign(1, node.disk.center);
    values[0] = whole(row.feature);
    values[1] = whole(row.first_node + i);
    values[2] = node.disk.radius;
    values[3] = kinds[static_cast<std::size_t>(node.kind)];
    if (Status added = sink.add(node_table, values, row.attributes, parts); !added) return added;
  }
  return success();
}

}  // namespace

std::vector<Column> own_columns(const AxesOutput&) {
  std::vector<Column> own = branch_columns();
  own.insert(own.end(), node_columns().begin(), node_columns().end());
  return own;
}

TableSource tables_of(const AxesOutput& output, const Target& target) {
  const bool nodes = target.tables == TableRoom::several;
  const auto attributes = target.columns ? target.columns
                                         : std::make_shared<const AttributeColumns>(
                                               output.document, own_columns(output));
  TableSource source;
  source.tables.push_back({"axis", GeometryKind::line, attributes->appended_to(branch_columns())});
  if (nodes)
    source.tables.push_back(
        {"nodes", GeometryKind::point, attributes->appended_to(node_columns())});
  source.fill = [&output, attributes, nodes, part = target.part](TableSink& sink) {
    std::uint64_t first_node = part.node;
    for (std::size_t i = 0; i < output.document.items.size(); ++i) {
      const AxisItem& item = output.document.items[i];
      const std::vector<Value> values = attributes->values_of(item.attributes);
      const std::vector<Branch> all = branches(item.axis);
      const Row row{part, part.number_of(output.document, i), first_node, item, all, values};
      if (Status added = add_branches(sink, row, output.options); !added) return added;
      if (nodes)
        if (Status added = add_nodes(sink, row, output.options.nodes); !added) return added;
      first_node += item.axis.nodes.size();
    }
    return success();
  };
  return source;
}

}  // namespace medial::io
