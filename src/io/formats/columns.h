#pragma once

// The columns of an axis in a file of the format safetensors; docs/columns.md lists them.

#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "io/axis_writer.h"
#include "io/format.h"
#include "io/formats/json_text.h"
#include "medial/document.h"

namespace medial::io::columns {

inline constexpr int newest_columns = 1;

/// The type of a column of these numbers.
template <class T>
constexpr std::string_view type_of = std::is_same_v<T, double> ? "F64"
                                     : sizeof(T) == 8          ? "U64"
                                     : sizeof(T) == 4          ? "U32"
                                                               : "U8";

/// What is short enough to be laid out in memory: rows for each item, and for each loop. The rows
/// of item i in a column of `points` are [points[i], points[i + 1]), and so on.
struct Tables {
  using Begins = std::vector<std::uint64_t>;
  std::vector<double> tolerance, resolution, exterior;
  Begins attributes{0}, points{0}, bulges{0}, loops{0}, sites{0}, nodes{0}, edges{0};
  std::vector<std::uint32_t> loop_size, loop_component;
  std::vector<std::uint8_t> loop_hole, method, part, attribute_text;
  std::vector<std::string> methods;
};

template <class AnyTables, class Visit>
void visit_tables(AnyTables& t, const Visit& visit) {
  visit("item_tolerance", t.tolerance);
  visit("item_resolution", t.resolution);
  visit("item_exterior", t.exterior);
  visit("item_attribute_begin", t.attributes);
  visit("item_point_begin", t.points);
  visit("item_bulge_begin", t.bulges);
  visit("item_loop_begin", t.loops);
  visit("item_site_begin", t.sites);
  visit("item_node_begin", t.nodes);
  visit("item_edge_begin", t.edges);
  visit("loop_size", t.loop_size);
  visit("loop_component", t.loop_component);
}

template <class AnyTables, class Visit>
void visit_short_tables(AnyTables& t, const Visit& visit) {
  visit("loop_hole", t.loop_hole);
  visit("item_method", t.method);
  visit("item_part", t.part);
  visit("attributes", t.attribute_text);
}

/// A column of the items' own rows: their vector in an item, and the numbers of a row: references,
/// or what follows from the other columns.
template <class Rows, class Numbers>
struct Column {
  const char* name;
  Tables::Begins Tables::*begins;
  Rows rows;
  Numbers numbers;
};
template <class Rows, class Numbers>
Column(const char*, Tables::Begins Tables::*, Rows, Numbers) -> Column<Rows, Numbers>;

/// All columns of 8-byte numbers, so that all are aligned.
template <class Visit>
void visit_wide_columns(const Visit& visit) {
  const auto points = [](auto& item) -> auto& { return item.shape.points; };
  const auto bulges = [](auto& item) -> auto& { return item.shape.bulges; };
  const auto sites = [](auto& item) -> decltype((item.axis.sites)) { return item.axis.sites; };
  const auto nodes = [](auto& item) -> decltype((item.axis.nodes)) { return item.axis.nodes; };
  const auto edges = [](auto& item) -> decltype((item.axis.edges)) { return item.axis.edges; };
  const auto of_disk = [](auto& disk) {
    return std::tie(disk.center.x, disk.center.y, disk.radius);
  };
  visit(Column{"points", &Tables::points, points, [](auto& p) { return std::tie(p.x, p.y); }});
  visit(Column{"bulges", &Tables::bulges, bulges, [](auto& bulge) { return std::tie(bulge); }});
  visit(Column{"site_ends", &Tables::sites, sites, [](auto& site) {
                 return std::tie(site.start.x, site.start.y, site.end.x, site.end.y);
               }});
  visit(Column{"site_bulge", &Tables::sites, sites, [](auto& s) { return std::tie(s.bulge); }});
  visit(Column{"node_disk", &Tables::nodes, nodes, [=](auto& n) { return of_disk(n.disk); }});
  visit(Column{"edge_control", &Tables::edges, edges, [=](auto& e) { return of_disk(e.control); }});
  visit(Column{"edge_weight", &Tables::edges, edges, [](auto& e) { return std::tie(e.weight); }});
}

template <class Visit>
void visit_columns(const Visit& visit) {
  const auto sources = [](auto& item) -> auto& { return item.shape.sources; };
  const auto sites = [](auto& item) -> decltype((item.axis.sites)) { return item.axis.sites; };
  const auto nodes = [](auto& item) -> decltype((item.axis.nodes)) { return item.axis.nodes; };
  const auto edges = [](auto& item) -> decltype((item.axis.edges)) { return item.axis.edges; };
  visit(Column{"point_source", &Tables::points, sources,
               [](auto& source) { return std::tie(source.ring, source.vertex); }});
  visit(Column{"site_source", &Tables::sites, sites,
               [](auto& site) { return std::tie(site.ring, site.vertex); }});
  visit(Column{"node_component", &Tables::nodes, nodes,
               [](auto& node) { return std::tie(node.component); }});
  visit(Column{"edge_nodes", &Tables::edges, edges,
               [](auto& edge) { return std::tie(edge.node[0], edge.node[1]); }});
  visit(Column{"edge_sites", &Tables::edges, edges,
               [](auto& edge) { return std::tie(edge.site[0], edge.site[1]); }});
  visit(Column{"site_kind", &Tables::sites, sites, [](auto& s) { return std::tuple(s.kind()); }});
  visit(Column{"node_kind", &Tables::nodes, nodes, [](auto& n) { return std::tie(n.kind); }});
}

/// What the rows of a column are made of: numbers of one type.
template <class C>
struct RowOf {
  static const C& column();
  static AxisItem& item();
  using Numbers = decltype(column().numbers(column().rows(item())[0]));
  using Number = std::remove_reference_t<std::tuple_element_t<0, Numbers>>;
  static constexpr std::size_t width = std::tuple_size<Numbers>::value;
};

inline void add_to_checksum(std::uint32_t& sum, std::string_view text) {
  sum = static_cast<std::uint32_t>(
      crc32_z(sum, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

/// Calls use(text) with all bytes of a column of some items, some at a time. Whether all numbers
/// are finite.
template <class Items, class C, class Use>
bool use_bytes(const Items& items, const C& column, const Use& use) {
  using T = typename RowOf<C>::Number;
  std::array<T, 4096 * RowOf<C>::width> block;
  std::size_t filled = 0;
  bool finite = true;
  const auto flush = [&] {
    if constexpr (std::is_same_v<T, double>)
      for (std::size_t i = 0; i < filled; ++i) finite = finite && std::isfinite(block[i]);
    use(std::string_view(reinterpret_cast<const char*>(block.data()), filled * sizeof(T)));
    filled = 0;
  };
  for (const auto& item : items) {
    for (const auto& row : column.rows(item)) {
      std::apply([&](const auto&... number) { ((block[filled++] = number), ...); },
                 column.numbers(row));
      if (filled == block.size()) flush();
    }
  }
  flush();
  return finite;
}

/// Nothing where a number is not finite.
template <class Items, class C>
std::optional<std::uint32_t> checksum_of(const Items& items, const C& column) {
  std::uint32_t sum = 0;
  const bool finite =
      use_bytes(items, column, [&](std::string_view text) { add_to_checksum(sum, text); });
  return finite ? std::optional(sum) : std::nullopt;
}

/// How many rows each of the items of an axis has.
struct RowCounts {
  std::uint64_t sites, nodes, edges;
};
/// Adds an item without its attributes; `about` is its axis, or one without rows.
void add_item(Tables& tables, const Shape& shape, const MedialAxis& about, const RowCounts& counts,
              bool part);
/// Adds the attributes of all items.
template <class Items>
void add_attributes(Tables& tables, const Items& items) {
  std::string text;
  OutputStream out = OutputStream::to(text);
  for (const auto& item : items) {
    put_attributes(out, item.attributes);
    static_cast<void>(out.finish());
    tables.attributes.push_back(text.size());
  }
  tables.attribute_text.assign(text.begin(), text.end());
}

/// A column as the header names it.
struct ColumnHead {
  std::string_view name, type;
  std::vector<std::uint64_t> shape;
  std::uint64_t size = 0;  ///< in bytes
  std::uint32_t checksum = 0;
};

/// Calls take(head, column) for each column in the order of the file: a Column, or a table's
/// values. The head has neither size nor checksum.
template <class Take>
void visit_all_columns(const Tables& tables, const Take& take) {
  const auto table = [&](const char* name, const auto& values) {
    using T = typename std::remove_cvref_t<decltype(values)>::value_type;
    const std::uint64_t size = values.size() * sizeof(T);
    take(ColumnHead{name, type_of<T>, {values.size()}, size},
         std::string_view(reinterpret_cast<const char*>(values.data()), size));
  };
  const auto column = [&](const auto& of) {
    using Row = RowOf<std::remove_cvref_t<decltype(of)>>;
    const std::uint64_t rows = (tables.*of.begins).back();
    ColumnHead head{of.name, type_of<typename Row::Number>, {rows}};
    if (Row::width > 1) head.shape.push_back(Row::width);
    head.size = rows * Row::width * sizeof(typename Row::Number);
    take(std::move(head), of);
  };
  visit_wide_columns(column);
  visit_tables(tables, table);
  visit_columns(column);
  visit_short_tables(tables, table);
}

/// Writes what stands before the columns.
void put_column_heads(Target& target, const DocumentInfo& file, const Tables& tables,
                      const std::vector<ColumnHead>& heads);

/// Writes a file. source.checksum(column) is nothing where a number is not finite;
/// source.put(out, column) writes the bytes.
template <class Source>
Status write_columns(Target& target, const DocumentInfo& file, const Tables& tables,
                     Source& source) {
  std::vector<ColumnHead> heads;
  bool finite = true;
  visit_all_columns(tables, [&]<class C>(ColumnHead head, const C& column) {
    if constexpr (std::is_same_v<C, std::string_view>) {
      add_to_checksum(head.checksum, column);
    } else {
      const auto sum = source.checksum(column);
      finite = finite && sum.has_value();
      head.checksum = sum.value_or(0);
    }
    heads.push_back(std::move(head));
  });
  if (!finite) return Error{ErrorCode::internal, "a number is not finite: please report this", {}};
  put_column_heads(target, file, tables, heads);
  Status done = success();
  visit_all_columns(tables, [&]<class C>(const ColumnHead&, const C& column) {
    if constexpr (std::is_same_v<C, std::string_view>)
      target.out->put(column);
    else if (done)
      done = source.put(*target.out, column);
  });
  return done;
}

/// See Format::grow.
std::unique_ptr<AxisWriter> grow(Target& target, const GrowingFrame& frame);

}  // namespace medial::io::columns
