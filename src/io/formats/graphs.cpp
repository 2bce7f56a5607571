// Axes as graphs, for programs of networks: GraphML, node-link JSON and lists of edges. Leaves and
// branchings are nodes, branches are edges; several can join the same two nodes.

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "io/formats/json_text.h"
#include "io/ring_text.h"
#include "io/tables.h"

namespace medial::io {

namespace {

/// Where the columns of branches and nodes have what graphs need by itself; the tables of axes.
constexpr std::size_t branch_table = 0, from_column = 2, to_column = 3, length_column = 6;
constexpr std::size_t node_column = 1;

/// Rows as nodes and edges: a row's values in the order of its columns.
class GraphTables : public TableSink {
 public:
  GraphTables(Target& target, const TableSource& source)
      : TableSink(target), out_(*target.out), tables_(source.tables) {}

 protected:
  virtual void put_node(std::span<const Value> values, Vec2 place) = 0;
  virtual void put_edge(std::span<const Value> values, const std::vector<Vec2>& line) = 0;

  static std::int64_t number(const Value& value) { return std::get<std::int64_t>(value); }
  static bool is_known(const Value& value) {
    const auto* real = std::get_if<double>(&value);
    return real != nullptr ? std::isfinite(*real) : !std::holds_alternative<std::monostate>(value);
  }
  /// Calls visit(column, value) for what is known beyond the names of nodes.
  template <class Visit>
  void each_value(std::size_t table, std::span<const Value> values, const Visit& visit) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!names_node(table, i) && is_known(values[i])) visit(i, values[i]);
  }
  static bool names_node(std::size_t table, std::size_t i) {
    return table == branch_table ? i == from_column || i == to_column : i == node_column;
  }

  OutputStream& out_;
  const std::vector<Table>& tables_;

 private:
  Status put(std::size_t table, std::span<const Value> first, std::span<const Value> rest,
             std::span<std::vector<Vec2>> parts) override {
    values_.assign(first.begin(), first.end());
    values_.insert(values_.end(), rest.begin(), rest.end());
    table == branch_table ? put_edge(values_, parts[0]) : put_node(values_, parts[0][0]);
    return success();
  }

  std::vector<Value> values_;
};

/// A text between tags; what XML cannot hold becomes a blank.
std::string xml_of(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')  // which "]]>" must not hold
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return escaped;
}

class GraphmlTables final : public GraphTables {
 public:
  GraphmlTables(Target& target, const TableSource& source) : GraphTables(target, source) {
    out_.put(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n");
    tags_.resize(tables_.size());
    for (std::size_t table = 0; table < tables_.size(); ++table)
      for (std::size_t i = 0; i < tables_[table].columns.size(); ++i) {
        if (!names_node(table, i)) put_key(table, i, tables_[table].columns[i]);
        tags_[table].push_back(fmt::format("<data key=\"{}{}\">", letter(table), i));
      }
    for (const char* place : {"x", "y"}) put_key_of(place, "node", place, "double");
    put_key_of("geometry", "edge", "geometry", "string");
    if (!target.unit.empty()) put_key_of("unit", "graph", "unit", "string");
    out_.put("<graph edgedefault=\"undirected\">\n");
    if (!target.unit.empty()) out_.put("<data key=\"unit\">" + xml_of(target.unit) + "</data>\n");
  }
  Status finish() {
    out_.put("</graph>\n</graphml>\n");
    return success();
  }

 private:
  void put_key(std::size_t table, std::size_t i, const Column& column) {
    const char* type = column.type == ColumnType::whole  ? "long"
                       : column.type == ColumnType::real ? "double"
                                                         : "string";
    put_key_of(fmt::format("{}{}", letter(table), i), table == branch_table ? "edge" : "node",
               column.name, type);
  }
  void put_key_of(const std::string& id, const char* of, const std::string& name,
                  const char* type) {
    out_.put(fmt::format("<key id=\"{}\" for=\"{}\" attr.name=\"{}\" attr.type=\"{}\"/>\n", id, of,
                         xml_of(name), type));
  }
  void put_node(std::span<const Value> values, Vec2 place) override {
    out_.put(fmt::format(
        FMT_COMPILE("<node id=\"{}\"><data key=\"x\">{}</data><data key=\"y\">{}</data>"),
        number(values[node_column]), place.x, place.y));
    put_values(1 - branch_table, values);
    out_.put("</node>\n");
  }
  /// With its line as well-known text, as OSMnx reads it.
  void put_edge(std::span<const Value> values, const std::vector<Vec2>& line) override {
    out_.put(fmt::format(FMT_COMPILE("<edge id=\"{}\" source=\"{}\" target=\"{}\">"), edges_++,
                         number(values[from_column]), number(values[to_column])));
    put_values(branch_table, values);
    out_.put("<data key=\"geometry\">LINESTRING ");
    put_wkt_points(out_, line);
    out_.put("</data></edge>\n");
  }
  void put_values(std::size_t table, std::span<const Value> values) {
    each_value(table, values, [&](std::size_t i, const Value& value) {
      out_.put(tags_[table][i]);
      if (const auto* text = std::get_if<std::string>(&value))
        out_.put(xml_of(*text));
      else if (const auto* whole = std::get_if<std::int64_t>(&value))
        out_.put(*whole);
      else
        out_.put(std::get<double>(value));
      out_.put("</data>");
    });
  }
  static char letter(std::size_t table) { return table == branch_table ? 'e' : 'n'; }

  std::vector<std::vector<std::string>> tags_;  ///< of each table's columns
  std::uint64_t edges_ = 0;
};

/// What networkx.node_link_graph() reads.
class NodelinkTables final : public GraphTables {
 public:
  NodelinkTables(Target& target, const TableSource& source) : GraphTables(target, source) {
    const std::string unit =
        target.unit.empty() ? "" : fmt::format("\"unit\":{}", json_quoted(target.unit));
    out_.put(fmt::format("{{\"directed\":false,\"multigraph\":true,\"graph\":{{{}}},\n\"nodes\":[",
                         unit));
  }
  Status finish() {
    out_.put("],\n\"edges\":[");
    out_.put(edges_json_);
    out_.put("]}\n");
    return success();
  }

 private:
  void put_node(std::span<const Value> values, Vec2 place) override {
    out_.put(fmt::format("{}{{\"id\":{},\"x\":{},\"y\":{}{}}}", first_node_ ? "\n" : ",\n",
                         number(values[node_column]), place.x, place.y,
                         members(1 - branch_table, values)));
    first_node_ = false;
  }
  void put_edge(std::span<const Value> values, const std::vector<Vec2>& line) override {
    edges_json_ += fmt::format("{}{{\"source\":{},\"target\":{},\"key\":{}{},\"geometry\":",
                               edges_json_.empty() ? "\n" : ",\n", number(values[from_column]),
                               number(values[to_column]), edges_++, members(branch_table, values));
    char separator = '[';
    for (const Vec2 p : line) {
      edges_json_ += fmt::format("{}[{},{}]", separator, p.x, p.y);
      separator = ',';
    }
    edges_json_ += "]}";
  }
  std::string members(std::size_t table, std::span<const Value> values) const {
    std::string text;
    each_value(table, values, [&](std::size_t i, const Value& value) {
      text += fmt::format(",{}:", json_quoted(tables_[table].columns[i].name));
      if (const auto* words = std::get_if<std::string>(&value))
        text += json_quoted(*words);
      else if (const auto* whole = std::get_if<std::int64_t>(&value))
        text += fmt::format("{}", *whole);
      else
        text += fmt::format("{}", std::get<double>(value));
    });
    return text;
  }

  std::string edges_json_;  ///< behind all nodes
  std::uint64_t edges_ = 0;
  bool first_node_ = true;
};

/// Two nodes and the length of each branch, as networkx, igraph and R read them.
class EdgelistTables final : public GraphTables {
 public:
  EdgelistTables(Target& target, const TableSource& source) : GraphTables(target, source) {
    out_.put(fmt::format("# from_node to_node length{}\n",
                         target.unit.empty() ? "" : " [" + target.unit + "]"));
  }
  Status finish() { return success(); }

 private:
  void put_node(std::span<const Value>, Vec2) override {}
  void put_edge(std::span<const Value> values, const std::vector<Vec2>&) override {
    out_.put(fmt::format("{} {} {}\n", number(values[from_column]), number(values[to_column]),
                         std::get<double>(values[length_column])));
  }
};

template <class Tables>
Status put_graph(Target& target, const TableSource& source) {
  Tables tables(target, source);
  if (Status filled = source.fill(tables); !filled) return filled;
  return tables.finish();
}

template <class Tables>
Format graph_format(std::string_view extension) {
  Format format{extension};
  format.geographic = true;
  format.tables = TableRoom::several;
  return format.writes<AxesOutput>(write_tables<put_graph<Tables>, AxesOutput>);
}

}  // namespace

Format graphml_format() { return graph_format<GraphmlTables>(".graphml"); }
Format nodelink_format() { return graph_format<NodelinkTables>(".nodelink"); }
Format edgelist_format() { return graph_format<EdgelistTables>(".edgelist"); }

}  // namespace medial::io
