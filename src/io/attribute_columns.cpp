#include "io/attribute_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <string_view>

#include "io/format_name.h"

namespace medial::io {
namespace {

template <class Number>
bool spells(const std::string& text, Number& value) {
  const char* end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, value);
  if (problem != std::errc() || stop != end) return false;
  std::array<char, 40> again{};
  const auto printed = std::to_chars(again.data(), again.data() + again.size(), value);
  return std::string_view(again.data(), static_cast<std::size_t>(printed.ptr - again.data())) ==
         text;
}

}  // namespace

void AttributeColumns::add(const Attributes& attributes) {
  for (const auto& [name, value] : attributes) {
    const auto [found, inserted] = index_.try_emplace(name, columns_.size());
    if (inserted) {
      names_.push_back(name);
      columns_.push_back({name, ColumnType::whole});
    }
    ColumnType& type = columns_[found->second].type;
    std::int64_t whole = 0;
    double real = 0;
    if (type == ColumnType::whole && !spells(value, whole)) type = ColumnType::real;
    if (type == ColumnType::real && !(spells(value, real) && std::isfinite(real)) &&
        !spells(value, whole))
      type = ColumnType::text;
  }
}

void AttributeColumns::finish(const DocumentInfo& info, std::span<const Column> own) {
  for (const std::string& name : info.text_attributes)
    if (const auto found = index_.find(name); found != index_.end())
      columns_[found->second].type = ColumnType::text;
  std::set<std::string> taken{"fid", "ogc_fid", "geom"};
  for (const Column& column : own) taken.insert(column.name);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    for (int i = 1; !taken.insert(lower_case(columns_[k].name)).second; ++i)
      columns_[k].name = fmt::format("{}_{}", names_[k], i);
  }
}

std::vector<Column> AttributeColumns::appended_to(std::vector<Column> columns) const {
  for (const Column& column : columns_) columns.push_back({column.name, column.type, true});
  return columns;
}

std::vector<Value> AttributeColumns::values_of(const Attributes& item) const {
  std::vector<Value> values(columns_.size());
  for (const auto& [name, value] : item) {
    const std::size_t k = index_.at(name);
    std::int64_t whole = 0;
    double real = 0;
    if (columns_[k].type == ColumnType::whole && spells(value, whole)) {
      values[k] = whole;
    } else if (columns_[k].type == ColumnType::real) {
      std::from_chars(value.data(), value.data() + value.size(), real);
      values[k] = real;
    } else {
      values[k] = value;
    }
  }
  return values;
}

}  // namespace medial::io
