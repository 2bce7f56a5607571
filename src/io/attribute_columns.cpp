#include "io/attribute_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

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

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

AttributeColumns::AttributeColumns(std::span<const Attributes* const> items,
                                   std::span<const std::string> own) {
  std::map<std::string, std::size_t> index;
  for (const Attributes* item : items) {
    for (const auto& [name, value] : *item) {
      const auto [found, inserted] = index.try_emplace(name, columns_.size());
      if (inserted) {
        names_.push_back(name);
        columns_.push_back({name, ColumnType::whole});
      }
      ColumnType& type = columns_[found->second].type;
      std::int64_t whole = 0;
      double real = 0;
      if (type == ColumnType::whole && !spells(value, whole)) type = ColumnType::real;
      if (type == ColumnType::real && !(spells(value, real) && std::isfinite(real)) &&
          !spells(value, whole)) {
        type = ColumnType::text;
      }
    }
  }
  std::set<std::string> taken(own.begin(), own.end());
  for (const char* name : {"fid", "ogc_fid", "geom"}) taken.insert(name);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    for (int i = 1; !taken.insert(lower(columns_[k].name)).second; ++i)
      columns_[k].name = fmt::format("{}_{}", names_[k], i);
  }
}

void AttributeColumns::append_to(std::vector<Column>& columns) const {
  columns.insert(columns.end(), columns_.begin(), columns_.end());
}

std::vector<Value> AttributeColumns::values_of(const Attributes& item) const {
  std::vector<Value> values(columns_.size());
  for (const auto& [name, value] : item) {
    const auto k = static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin());
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
