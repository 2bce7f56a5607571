// Axes as columns of numbers: a file of the format safetensors
// (https://github.com/huggingface/safetensors), which NumPy can map into memory as it is.
// docs/format.md lists the columns.

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "io/formats/json.h"
#include "io/formats/json_rows.h"
#include "io/formats/json_text.h"

namespace medial::io {

namespace {

constexpr int newest_columns = 1;
constexpr std::size_t longest_header = 100'000'000;  // of the format

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
  Begins attributes, points, bulges, loops, sites, nodes, edges;
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

/// A column of the items' own rows: their vector in an item, and the numbers of a row.
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
  const auto sites = [](auto& item) -> auto& { return item.axis.sites; };
  const auto nodes = [](auto& item) -> auto& { return item.axis.nodes; };
  const auto edges = [](auto& item) -> auto& { return item.axis.edges; };
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
  const auto sites = [](auto& item) -> auto& { return item.axis.sites; };
  const auto nodes = [](auto& item) -> auto& { return item.axis.nodes; };
  const auto edges = [](auto& item) -> auto& { return item.axis.edges; };
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
  visit(Column{"site_kind", &Tables::sites, sites, [](auto& s) { return std::tie(s.kind); }});
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

Tables tables_of(const Document<AxisItem>& file) {
  Tables t;
  for (auto* begins : {&t.attributes, &t.points, &t.bulges, &t.loops, &t.sites, &t.nodes, &t.edges})
    begins->push_back(0);
  std::string text;
  OutputStream attributes = OutputStream::to(text);
  for (const AxisItem& item : file.items) {
    const Shape& shape = item.shape;
    t.points.push_back(t.points.back() + shape.points.size());
    t.bulges.push_back(t.bulges.back() + shape.bulges.size());
    t.loops.push_back(t.loops.back() + shape.loop_count());
    t.sites.push_back(t.sites.back() + item.axis.sites.size());
    t.nodes.push_back(t.nodes.back() + item.axis.nodes.size());
    t.edges.push_back(t.edges.back() + item.axis.edges.size());
    t.tolerance.push_back(item.axis.tolerance);
    t.resolution.push_back(item.axis.resolution);
    t.exterior.push_back(item.axis.exterior);
    t.part.push_back(item.part ? 1 : 0);
    const auto known = std::ranges::find(t.methods, item.axis.method);
    t.method.push_back(static_cast<std::uint8_t>(known - t.methods.begin()));
    if (known == t.methods.end()) t.methods.push_back(item.axis.method);
    for (std::size_t i = 0; i < shape.loop_count(); ++i) {
      t.loop_size.push_back(shape.loop_begin[i + 1] - shape.loop_begin[i]);
      t.loop_component.push_back(shape.component[i]);
      t.loop_hole.push_back(shape.hole[i] ? 1 : 0);
    }
    put_attributes(attributes, item.attributes);
    static_cast<void>(attributes.finish());
    t.attributes.push_back(text.size());
  }
  t.attribute_text.assign(text.begin(), text.end());
  return t;
}

/// Calls use(text) with all bytes of a column, some at a time. Whether all numbers are finite.
template <class C, class Use>
bool use_bytes(const Document<AxisItem>& file, const C& column, const Use& use) {
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
  for (const AxisItem& item : file.items) {
    for (const auto& row : column.rows(item)) {
      std::apply([&](const auto&... number) { ((block[filled++] = number), ...); },
                 column.numbers(row));
      if (filled == block.size()) flush();
    }
  }
  flush();
  return finite;
}

/// Calls put(name, type, shape, bytes) for each column, where bytes(use) is use_bytes().
template <class Put>
void put_columns(const Document<AxisItem>& file, const Tables& tables, const Put& put) {
  const auto table = [&](const char* name, const auto& values) {
    using T = typename std::remove_cvref_t<decltype(values)>::value_type;
    put(name, type_of<T>, std::vector<std::uint64_t>{values.size()}, [&](const auto& use) {
      use(std::string_view(reinterpret_cast<const char*>(values.data()),
                           values.size() * sizeof(T)));
      return true;
    });
  };
  const auto column = [&](const auto& of) {
    using Row = RowOf<std::remove_cvref_t<decltype(of)>>;
    std::vector<std::uint64_t> shape{(tables.*of.begins).back()};
    if (Row::width > 1) shape.push_back(Row::width);
    put(of.name, type_of<typename Row::Number>, shape,
        [&](const auto& use) { return use_bytes(file, of, use); });
  };
  visit_wide_columns(column);
  visit_tables(tables, table);
  visit_columns(column);
  visit_short_tables(tables, table);
}

void add_to_checksum(std::uint32_t& sum, std::string_view text) {
  sum = static_cast<std::uint32_t>(
      crc32_z(sum, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

Status write_safetensors(Target& target, const AxesOutput& output) {
  using nlohmann::ordered_json;
  const Document<AxisItem>& file = output.document;
  const Tables tables = tables_of(file);
  ordered_json header, checksums;
  std::uint64_t end = 0;
  bool finite = true;
  put_columns(file, tables,
              [&](const char* name, std::string_view type, const std::vector<std::uint64_t>& shape,
                  const auto& bytes) {
                const std::uint64_t begin = end;
                std::uint32_t sum = 0;
                finite &= bytes([&](std::string_view text) {
                  end += text.size();
                  add_to_checksum(sum, text);
                });
                checksums[name] = sum;
                header[name] = {{"dtype", type}, {"shape", shape}, {"data_offsets", {begin, end}}};
              });
  if (!finite) return Error{ErrorCode::internal, "a number is not finite: please report this", {}};
  ordered_json about{{"medial", std::to_string(newest_columns)},
                     {"methods", ordered_json(tables.methods).dump()},
                     {"crc32", checksums.dump()}};
  if (!file.crs_wkt.empty()) about["crs"] = nlohmann::json::parse(json_quoted(file.crs_wkt));
  if (!target.unit.empty()) about["unit"] = target.unit;
  if (file.y_down) about["y_down"] = "true";
  ordered_json whole{{"__metadata__", about}};
  whole.update(header);
  std::string text = whole.dump();
  text.append(7 - (text.size() + 7) % 8, ' ');  // the columns begin at a multiple of 8
  const std::uint64_t size = text.size();
  OutputStream& out = *target.out;
  for (int byte = 0; byte < 8; ++byte) out.put(static_cast<char>(size >> 8 * byte & 0xFF));
  out.put(text);
  put_columns(file, tables, [&](const char*, std::string_view, const auto&, const auto& bytes) {
    bytes([&](std::string_view part) { out.put(part); });
  });
  return success();
}

/// A file in memory. Its functions throw Malformed.
class ColumnFile {
 public:
  explicit ColumnFile(std::string_view file) {
    std::uint64_t size = 0;
    demand(file.size() >= 8, "the file is cut off");
    for (std::size_t i = 0; i < 8; ++i)
      size |= std::uint64_t{static_cast<unsigned char>(file[i])} << 8 * i;
    demand(size <= longest_header && size <= file.size() - 8, "the file is cut off");
    header_ = nlohmann::json::parse(file.substr(8, size), nullptr, false);
    demand(header_.is_object(), "the header is not a JSON object");
    data_ = file.substr(8 + size);
    const auto checksums = about("crc32");
    checksums_ = nlohmann::json::parse(checksums.empty() ? "{}" : checksums, nullptr, false);
  }

  /// A text of the metadata; empty where there is none.
  std::string about(const char* name) const {
    const auto about = header_.find("__metadata__");
    if (about == header_.end() || !about->is_object()) return {};
    const auto text = about->find(name);
    return text != about->end() && text->is_string() ? text->get<std::string>() : std::string();
  }

  /// The bytes of a column of rows of `width` numbers.
  template <class T>
  std::string_view bytes(const char* name, std::size_t width) const {
    const auto found = header_.find(name);
    const auto need = [&](bool condition, const char* what) {
      if (!condition) throw Malformed{fmt::format("the column '{}' {}", name, what)};
    };
    need(found != header_.end() && found->is_object(), "is missing");
    need(found->value("dtype", nlohmann::json()) == type_of<T>, "is not of its type");
    const auto ends = numbers(found->value("data_offsets", nlohmann::json()));
    const auto shape = numbers(found->value("shape", nlohmann::json()));
    need(ends.size() == 2 && ends[0] <= ends[1] && ends[1] <= data_.size(), "is cut off");
    const std::uint64_t size = ends[1] - ends[0], row = width * sizeof(T);
    need(size % row == 0 && !shape.empty() && shape[0] == size / row &&
             (shape.size() == 1 ? width == 1 : shape.size() == 2 && shape[1] == width),
         "has another shape");
    const std::string_view found_bytes = data_.substr(ends[0], size);
    if (checksums_.is_object() && checksums_.contains(name)) {
      std::uint32_t sum = 0;
      add_to_checksum(sum, found_bytes);
      need(checksums_[name] == sum, "is damaged: its checksum is another");
    }
    return found_bytes;
  }

  template <class T>
  void read(const char* name, std::vector<T>& values) const {
    const std::string_view text = bytes<T>(name, 1);
    values.resize(text.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), text.data(), text.size());
    check(values);
  }

  template <class T>
  static void check(const T& values) {
    if constexpr (std::is_same_v<typename T::value_type, double>)
      for (const double value : values) demand(std::isfinite(value), "a number is not finite");
  }

 private:
  static std::vector<std::uint64_t> numbers(const nlohmann::json& list) {
    std::vector<std::uint64_t> result;
    demand(list.is_array(), "the header is not that of columns");
    for (const auto& value : list) {
      demand(value.is_number_unsigned(), "the header is not that of columns");
      result.push_back(value.get<std::uint64_t>());
    }
    return result;
  }

  nlohmann::json header_, checksums_;
  std::string_view data_;
};

/// A column into the rows of the items, of as many rows as the table says.
template <class C>
void read_column(const ColumnFile& reader, const Tables& tables, const C& column,
                 std::vector<AxisItem>& items) {
  using T = typename RowOf<C>::Number;
  constexpr std::size_t width = RowOf<C>::width;
  const std::string_view bytes = reader.bytes<T>(column.name, width);
  const Tables::Begins& begins = tables.*column.begins;
  demand(begins.back() == bytes.size() / (width * sizeof(T)), "columns differ in length");
  const char* next = bytes.data();
  for (std::size_t i = 0; i < items.size(); ++i) {
    auto& rows = column.rows(items[i]);
    rows.resize(begins[i + 1] - begins[i]);
    for (auto& row : rows) {
      std::array<T, width> numbers;
      std::memcpy(numbers.data(), next, sizeof numbers);
      next += sizeof numbers;
      ColumnFile::check(numbers);
      const T* number = numbers.data();
      std::apply([&](auto&... into) { ((into = *number++), ...); }, column.numbers(row));
    }
  }
}

void check_tables(const Tables& t) {
  const std::size_t items = t.tolerance.size();
  const auto covers = [&](const Tables::Begins& begins) {
    demand(begins.size() == items + 1 && begins[0] == 0 &&
               std::is_sorted(begins.begin(), begins.end()),
           "the items do not cover a column");
  };
  for (const auto* begins :
       {&t.attributes, &t.points, &t.bulges, &t.loops, &t.sites, &t.nodes, &t.edges})
    covers(*begins);
  demand(t.resolution.size() == items && t.exterior.size() == items && t.method.size() == items &&
             t.part.size() == items && t.attributes.back() == t.attribute_text.size() &&
             t.loops.back() == t.loop_size.size() &&
             t.loop_component.size() == t.loop_size.size() &&
             t.loop_hole.size() == t.loop_size.size(),
         "columns differ in length");
}

Attributes attributes_from(std::string_view text) {
  Attributes attributes;
  const auto list = nlohmann::json::parse(text, nullptr, false);
  demand(list.is_array(), "the attributes are not a list");
  for (const auto& pair : list) {
    demand(pair.is_array() && pair.size() == 2 && pair[0].is_string() && pair[1].is_string(),
           "an attribute is not a pair of strings");
    attributes.emplace_back(pair[0].get<std::string>(), pair[1].get<std::string>());
  }
  return attributes;
}

void take_tables(const Tables& t, std::size_t i, AxisItem& item) {
  MedialAxis& axis = item.axis;
  axis.tolerance = t.tolerance[i];
  axis.resolution = t.resolution[i];
  axis.exterior = t.exterior[i];
  item.part = t.part[i] != 0;
  demand(t.method[i] < t.methods.size(), "an unknown method");
  axis.method = t.methods[t.method[i]];
  item.attributes =
      attributes_from(std::string_view(reinterpret_cast<const char*>(t.attribute_text.data()),
                                       t.attribute_text.size())
                          .substr(t.attributes[i], t.attributes[i + 1] - t.attributes[i]));
  Shape& shape = item.shape;
  if (t.loops[i] < t.loops[i + 1]) shape.loop_begin.push_back(0);
  for (std::uint64_t k = t.loops[i]; k < t.loops[i + 1]; ++k) {
    demand(t.loop_size[k] <= shape.points.size() - shape.loop_begin.back(),
           "the loops do not cover the points");
    shape.loop_begin.push_back(shape.loop_begin.back() + t.loop_size[k]);
    shape.component.push_back(t.loop_component[k]);
    shape.hole.push_back(t.loop_hole[k] != 0);
  }
}

Document<AxisItem> read_columns(const ColumnFile& reader) {
  const std::string version = reader.about("medial");
  demand(!version.empty(), "the columns are not those of a medial axis");
  if (version != std::to_string(newest_columns))
    throw TooNew{std::strtoull(version.c_str(), nullptr, 10)};
  Document<AxisItem> file;
  file.crs_wkt = reader.about("crs");
  file.y_down = reader.about("y_down") == "true";
  if (const std::string unit = reader.about("unit"); !unit.empty()) file.unit = unit_from(unit);
  Tables tables;
  const auto methods = nlohmann::json::parse(reader.about("methods"), nullptr, false);
  demand(methods.is_array(), "the methods are missing");
  for (const auto& method : methods) {
    demand(method.is_string(), "a method is not a text");
    tables.methods.push_back(method.get<std::string>());
  }
  const auto read = [&](const char* name, auto& values) { reader.read(name, values); };
  visit_tables(tables, read);
  visit_short_tables(tables, read);
  check_tables(tables);
  file.items.resize(tables.tolerance.size());
  const auto column = [&](const auto& of) { read_column(reader, tables, of, file.items); };
  visit_wide_columns(column);
  visit_columns(column);
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    take_tables(tables, i, file.items[i]);
    check_item(file.items[i]);
  }
  return file;
}

Result<Document<Feature>> read_features_of_columns(const Input& input, const ReadOptions&) {
  Result<Document<AxisItem>> file = read_safetensors(*input.source);
  if (!file) return file.error();
  return dataset_of(std::move(*file));
}

}  // namespace

bool begins_like_safetensors(std::string_view text) {
  return text.size() > 9 && text[8] == '{' && text.substr(4, 4) == std::string_view("\0\0\0\0", 4);
}

Result<Document<AxisItem>> read_safetensors(TextSource& source) {
  std::string bytes;
  bytes.reserve(source.length_hint());
  source.read_all(bytes, std::string().max_size() / 2);
  if (source.failure()) return *source.failure();
  try {
    return read_columns(ColumnFile(bytes));
  } catch (const Malformed& problem) {
    return Error{ErrorCode::malformed, problem.text, {}};
  } catch (const TooNew& found) {
    return Error{ErrorCode::unsupported,
                 fmt::format("version {} of the columns; this program reads {}", found.version,
                             newest_columns),
                 {}};
  }
}

Format safetensors_format() {
  Format format{".safetensors"};
  format.read = read_features_of_columns;
  format.sniff = begins_like_safetensors;
  format.accepts = begins_like_safetensors;
  return format.writes<AxesOutput>(write_safetensors);
}

}  // namespace medial::io
