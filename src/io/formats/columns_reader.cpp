// Reads axes from columns (columns.h).

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>

#include "io/formats/columns.h"
#include "io/formats/json.h"
#include "io/formats/json_rows.h"

namespace medial::io {

namespace columns {
namespace {

constexpr std::size_t longest_header = 100'000'000;  // of the format

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
      need(checksums_[name] == sum, "is damaged: its checksum does not match");
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
      auto known = column.numbers(row);
      if constexpr (std::is_same_v<decltype(known), std::tuple<T>>)
        demand(std::get<0>(known) == *number, "a site is not of its kind");
      else
        std::apply([&](auto&... into) { ((into = *number++), ...); }, known);
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

/// A list of texts, or of whole numbers that are not negative, as JSON.
template <class T>
std::vector<T> list_from(const std::string& text, const char* otherwise) {
  constexpr bool of_texts = std::is_same_v<T, std::string>;
  const auto list = nlohmann::json::parse(text, nullptr, false);
  demand(list.is_array(), otherwise);
  std::vector<T> values;
  for (const auto& value : list) {
    demand(of_texts ? value.is_string() : value.is_number_unsigned(), otherwise);
    values.push_back(value.template get<T>());
  }
  return values;
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
  if (const std::string text = reader.about("corner_angle"); !text.empty()) {
    const auto angle = nlohmann::json::parse(text, nullptr, false);
    demand(angle.is_number(), "the corner angle is no number");
    file.corner_angle = corner_angle_from(angle.get<double>());
  }
  if (const std::string text = reader.about("text_attributes"); !text.empty())
    file.text_attributes =
        list_from<std::string>(text, "the names of text attributes are no texts");
  if (const std::string text = reader.about("features"); !text.empty())
    file.indices = list_from<std::uint64_t>(text, "the numbers of features are no whole numbers");
  Tables tables;
  tables.methods = list_from<std::string>(reader.about("methods"), "the methods are no texts");
  const auto read = [&](const char* name, auto& values) { reader.read(name, values); };
  visit_tables(tables, read);
  visit_short_tables(tables, read);
  check_tables(tables);
  file.items.resize(tables.tolerance.size());
  demand(file.indices.empty() || file.indices.size() == file.items.size(),
         "the numbers of features are not one for each");
  const auto column = [&](const auto& of) { read_column(reader, tables, of, file.items); };
  visit_wide_columns(column);
  visit_columns(column);
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    take_tables(tables, i, file.items[i]);
    check_item(file.items[i]);
  }
  return file;
}

}  // namespace
}  // namespace columns

bool begins_like_safetensors(std::string_view text) {
  return text.size() > 9 && text[8] == '{' && text.substr(4, 4) == std::string_view("\0\0\0\0", 4);
}

Result<Document<AxisItem>> read_safetensors(TextSource& source) {
  std::string bytes;
  bytes.reserve(source.length_hint());
  source.read_all(bytes, std::string().max_size() / 2);
  if (source.failure()) return *source.failure();
  try {
    return columns::read_columns(columns::ColumnFile(bytes));
  } catch (const Malformed& problem) {
    return Error{ErrorCode::malformed, problem.text, {}};
  } catch (const TooNew& found) {
    return Error{ErrorCode::unsupported,
                 fmt::format("version {} of the columns; this program reads {}", found.version,
                             columns::newest_columns),
                 {}};
  }
}

}  // namespace medial::io
