#include "io/geojson.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>

#include "io/gdal_target.h"
#include "io/ring_text.h"
#include "io/tables.h"

namespace medial::io {

namespace {

/// The name of a reference system, as a uniform resource name of the OGC; empty where it has no
/// code.
std::string urn_of(const OGRSpatialReference& reference) {
  const std::unique_ptr<OGRSpatialReference> copy(reference.Clone());
  if (copy->GetAuthorityCode(nullptr) == nullptr) copy->AutoIdentifyEPSG();
  const char* authority = copy->GetAuthorityName(nullptr);
  const char* code = copy->GetAuthorityCode(nullptr);
  if (authority == nullptr || code == nullptr) return {};
  // Coordinates are longitude before latitude.
  if (EQUAL(authority, "EPSG") && EQUAL(code, "4326")) return "urn:ogc:def:crs:OGC:1.3:CRS84";
  return fmt::format("urn:ogc:def:crs:{}::{}", authority, code);
}

class GeojsonTables final : public TableSink {
 public:
  GeojsonTables(OutputStream& out, const std::string& name, const OutputCrs& crs,
                const TableSource& source)
      : out_(out), crs_(crs), tables_(source.tables), collection_(out, name, crs.reference()) {
    for (const Table& table : tables_) {
      auto& keys = keys_.emplace_back();
      for (const Column& column : table.columns) keys.push_back(quoted(column.name));
    }
  }

  Status add(std::size_t table, std::span<const Value> first, std::span<const Value> rest,
             std::span<std::vector<Vec2>> parts) override {
    for (std::vector<Vec2>& part : parts)
      if (Status placed = crs_.transform(part); !placed) return placed;
    collection_.start();
    std::size_t column = 0;
    for (const auto values : {first, rest}) {
      for (const Value& value : values) {
        collection_.member(keys_[table][column++]);
        put(value);
      }
    }
    switch (tables_[table].kind) {
      case GeometryKind::point:
        collection_.geometry("Point");
        out_.put('[');
        put_point(out_, parts[0][0], ',');
        out_.put(']');
        break;
      case GeometryKind::line:
        collection_.geometry("LineString");
        put_geojson_points(out_, parts[0]);
        break;
      case GeometryKind::polygon:
        collection_.geometry("Polygon");
        for (std::size_t i = 0; i < parts.size(); ++i) {
          out_.put(i == 0 ? '[' : ',');
          if (parts[i].front() != parts[i].back()) parts[i].push_back(parts[i].front());
          put_geojson_points(out_, parts[i]);
        }
        out_.put(']');
        break;
    }
    collection_.end();
    return success();
  }

  void finish() { collection_.finish(); }

 private:
  void put(const Value& value) {
    if (const auto* number = std::get_if<std::int64_t>(&value)) {
      out_.put(*number);
    } else if (const auto* decimal = std::get_if<double>(&value);
               decimal && std::isfinite(*decimal)) {
      put_real(out_, *decimal);
    } else if (const auto* words = std::get_if<std::string>(&value)) {
      put_quoted(out_, *words);
    } else {
      out_.put("null");
    }
  }

  OutputStream& out_;
  const OutputCrs& crs_;
  const std::vector<Table>& tables_;
  GeojsonCollection collection_;
  std::vector<std::vector<std::string>> keys_;  ///< of each table
};

}  // namespace

GeojsonCollection::GeojsonCollection(OutputStream& out, const std::string& name,
                                     const OGRSpatialReference* reference)
    : out_(out) {
  out_.put("{\"type\":\"FeatureCollection\",");
  if (!name.empty()) out_.put(fmt::format("\"name\":{},", quoted(name)));
  const std::string urn = reference == nullptr ? std::string() : urn_of(*reference);
  if (!urn.empty())
    out_.put(
        fmt::format("\"crs\":{{\"type\":\"name\",\"properties\":{{\"name\":{}}}}},", quoted(urn)));
  out_.put("\"features\":[");
}

void GeojsonCollection::start() {
  out_.put(first_feature_ ? "\n" : ",\n");
  first_feature_ = false;
  out_.put("{\"type\":\"Feature\",\"properties\":{");
  first_member_ = true;
}

void GeojsonCollection::member(std::string_view quoted_key) {
  if (!first_member_) out_.put(',');
  first_member_ = false;
  out_.put(quoted_key);
  out_.put(':');
}

void GeojsonCollection::geometry(std::string_view type) {
  out_.put("},\"geometry\":{\"type\":\"");
  out_.put(type);
  out_.put("\",\"coordinates\":");
}

void GeojsonCollection::end() { out_.put("}}"); }

void GeojsonCollection::finish() { out_.put("\n]}\n"); }

void put_quoted(OutputStream& out, const std::string& text) {
  const bool plain = std::ranges::all_of(
      text, [](char c) { return c >= ' ' && c < 0x7f && c != '"' && c != '\\'; });
  if (!plain) return out.put(std::string_view(quoted(text)));
  out.put('"');
  out.put(std::string_view(text));
  out.put('"');
}

void put_real(OutputStream& out, double value) {
  std::array<char, 40> digits{};
  const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  const std::string_view text(digits.data(), static_cast<std::size_t>(end - digits.data()));
  out.put(text);
  if (text.find_first_not_of("-0123456789") == std::string_view::npos) out.put(".0");
}

Status put_geojson(OutputStream& out, const std::string& name, const OutputCrs& crs,
                   const TableSource& source) {
  GeojsonTables tables(out, name, crs, source);
  if (Status filled = source.fill(tables); !filled) return filled;
  tables.finish();
  return success();
}

}  // namespace medial::io
