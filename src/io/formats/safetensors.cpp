// Axes as columns of numbers: a file of the format safetensors
// (https://github.com/huggingface/safetensors), which NumPy can map into memory as it is.

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/formats/columns.h"
#include "io/formats/json.h"
#include "io/formats/json_text.h"

namespace medial::io {

namespace columns {
namespace {

/// The columns of a document in memory.
struct WholeColumns {
  const Document<AxisItem>& file;

  template <class C>
  std::optional<std::uint32_t> checksum(const C& column) const {
    return checksum_of(file.items, column);
  }
  template <class C>
  Status put(OutputStream& out, const C& column) const {
    use_bytes(file.items, column, [&](std::string_view text) { out.put(text); });
    return success();
  }
};

Status write_safetensors(Target& target, const AxesOutput& output) {
  const Document<AxisItem>& file = output.document;
  Tables tables;
  for (const AxisItem& item : file.items)
    add_item(tables, item.shape, item.axis,
             {item.axis.sites.size(), item.axis.nodes.size(), item.axis.edges.size()}, item.part);
  add_attributes(tables, file.items);
  WholeColumns columns{file};
  return write_columns(target, file, tables, columns);
}

}  // namespace

void add_item(Tables& t, const Shape& shape, const MedialAxis& about, const RowCounts& counts,
              bool part) {
  const auto add = [](Tables::Begins& begins, std::uint64_t count) {
    begins.push_back(begins.back() + count);
  };
  add(t.points, shape.points.size());
  add(t.bulges, shape.bulges.size());
  add(t.loops, shape.loop_count());
  add(t.sites, counts.sites);
  add(t.nodes, counts.nodes);
  add(t.edges, counts.edges);
  t.tolerance.push_back(about.tolerance);
  t.resolution.push_back(about.resolution);
  t.exterior.push_back(about.exterior);
  t.part.push_back(part ? 1 : 0);
  const auto known = std::ranges::find(t.methods, about.method);
  t.method.push_back(static_cast<std::uint8_t>(known - t.methods.begin()));
  if (known == t.methods.end()) t.methods.push_back(about.method);
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    t.loop_size.push_back(shape.loop_begin[i + 1] - shape.loop_begin[i]);
    t.loop_component.push_back(shape.component[i]);
    t.loop_hole.push_back(shape.hole[i] ? 1 : 0);
  }
}

void put_column_heads(Target& target, const DocumentInfo& file, const Tables& tables,
                      const std::vector<ColumnHead>& heads) {
  using nlohmann::ordered_json;
  ordered_json header, checksums;
  std::uint64_t end = 0;
  for (const ColumnHead& head : heads) {
    const std::uint64_t begin = end;
    end += head.size;
    checksums[std::string(head.name)] = head.checksum;
    header[std::string(head.name)] = {
        {"dtype", head.type}, {"shape", head.shape}, {"data_offsets", {begin, end}}};
  }
  ordered_json about{{"medial", std::to_string(newest_columns)},
                     {"methods", ordered_json(tables.methods).dump()},
                     {"crc32", checksums.dump()}};
  if (!file.crs_wkt.empty()) about["crs"] = nlohmann::json::parse(json_quoted(file.crs_wkt));
  if (file.unit != Unit::unknown) about["unit"] = name_of(file.unit);
  if (file.y_down) about["y_down"] = "true";
  if (file.corner_angle > 0) about["corner_angle"] = ordered_json(file.corner_angle).dump();
  if (!file.indices.empty()) about["features"] = ordered_json(file.indices).dump();
  if (!file.text_attributes.empty())
    about["text_attributes"] = ordered_json(file.text_attributes).dump();
  ordered_json whole{{"__metadata__", about}};
  whole.update(header);
  std::string text = whole.dump();
  text.append(7 - (text.size() + 7) % 8, ' ');  // the columns begin at a multiple of 8
  const std::uint64_t size = text.size();
  OutputStream& out = *target.out;
  for (int byte = 0; byte < 8; ++byte) out.put(static_cast<char>(size >> 8 * byte & 0xFF));
  out.put(text);
}

}  // namespace columns

namespace {

Result<Document<Feature>> read_features_of_columns(const Input& input, const ReadOptions&) {
  Result<Document<AxisItem>> file = read_safetensors(*input.source);
  if (!file) return file.error();
  return features_of(std::move(*file));
}

}  // namespace

Format safetensors_format() {
  Format format{".safetensors"};
  format.read = read_features_of_columns;
  format.sniff = begins_like_safetensors;
  format.accepts = begins_like_safetensors;
  format.growing = Growing::graph;
  format.grow = columns::grow;
  return format.writes<AxesOutput>(columns::write_safetensors);
}

}  // namespace medial::io
