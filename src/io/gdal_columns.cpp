#include "io/gdal_columns.h"

#include <fmt/format.h>
#include <ogrsf_frmts.h>

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
      if (inserted) columns_.push_back({name, name, OFTInteger64});
      OGRFieldType& type = columns_[found->second].type;
      std::int64_t whole = 0;
      double real = 0;
      if (type == OFTInteger64 && !spells(value, whole)) type = OFTReal;
      if (type == OFTReal && !(spells(value, real) && std::isfinite(real)) &&
          !spells(value, whole)) {
        type = OFTString;
      }
    }
  }
  std::set<std::string> taken(own.begin(), own.end());
  for (const char* name : {"fid", "ogc_fid", "geom"}) taken.insert(name);
  for (Column& column : columns_) {
    for (int i = 1; !taken.insert(lower(column.column)).second; ++i)
      column.column = fmt::format("{}_{}", column.name, i);
  }
}

bool AttributeColumns::create_in(OGRLayer& layer) const {
  return std::ranges::all_of(columns_, [&layer](const Column& column) {
    OGRFieldDefn definition(column.column.c_str(), column.type);
    return layer.CreateField(&definition) == OGRERR_NONE;
  });
}

void AttributeColumns::set(OGRFeature& feature, int first, const Attributes& item) const {
  for (const auto& [name, value] : item) {
    const auto column = std::ranges::find(columns_, name, &Column::name);
    const int field = first + static_cast<int>(column - columns_.begin());
    std::int64_t whole = 0;
    double real = 0;
    if (column->type == OFTInteger64 && spells(value, whole)) {
      feature.SetField(field, static_cast<GIntBig>(whole));
    } else if (column->type == OFTReal) {
      std::from_chars(value.data(), value.data() + value.size(), real);
      feature.SetField(field, real);
    } else {
      feature.SetField(field, value.c_str());
    }
  }
}

}  // namespace medial::io
