#pragma once

// Rows of tables on their way into a file of GIS.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/tables.h"

namespace medial::io {

/// Some rows of tables, one behind the other in little memory: they are made on any thread and
/// added to a file on one.
class Rows {
 public:
  enum class Kind : std::uint8_t { nothing, whole, real, text };
  struct Field {
    Kind kind = Kind::nothing;
    union {
      std::int64_t whole = 0;
      double real;
      std::size_t text;  ///< where it begins
    };
  };

  void put(std::size_t table, std::span<const Value> first, std::span<const Value> rest,
           std::span<const std::vector<Vec2>> parts) {
    for (const auto values : {first, rest})
      for (const Value& value : values) put(value);
    for (const std::vector<Vec2>& part : parts) {
      points_.insert(points_.end(), part.begin(), part.end());
      ring_ends_.push_back(points_.size());
    }
    ends_.push_back({table, fields_.size(), ring_ends_.size()});
  }
  void clear() {
    fields_.clear();
    texts_.clear();
    points_.clear();
    ring_ends_.clear();
    ends_.clear();
  }
  std::size_t size() const { return ends_.size(); }
  std::size_t table(std::size_t row) const { return ends_[row].table; }
  std::span<const Field> fields(std::size_t row) const {
    const std::size_t begin = row == 0 ? 0 : ends_[row - 1].fields;
    return std::span(fields_).subspan(begin, ends_[row].fields - begin);
  }
  const char* text(const Field& field) const { return texts_.c_str() + field.text; }
  std::size_t ring_count(std::size_t row) const { return ends_[row].rings - first_ring(row); }
  std::span<const Vec2> ring(std::size_t row, std::size_t i) const {
    const std::size_t ring = first_ring(row) + i;
    const std::size_t begin = ring == 0 ? 0 : ring_ends_[ring - 1];
    return std::span(points_).subspan(begin, ring_ends_[ring] - begin);
  }

 private:
  struct End {
    std::size_t table, fields, rings;
  };

  void put(const Value& value) {
    Field& field = fields_.emplace_back();
    if (const auto* number = std::get_if<std::int64_t>(&value)) {
      field.kind = Kind::whole;
      field.whole = *number;
    } else if (const auto* decimal = std::get_if<double>(&value)) {
      field.kind = Kind::real;
      field.real = *decimal;
    } else if (const auto* words = std::get_if<std::string>(&value)) {
      field.kind = Kind::text;
      field.text = texts_.size();
      texts_.append(words->c_str());  // as far as GDAL reads it
      texts_.push_back('\0');
    }
  }
  std::size_t first_ring(std::size_t row) const { return row == 0 ? 0 : ends_[row - 1].rings; }

  std::vector<Field> fields_;
  std::string texts_;
  std::vector<Vec2> points_;
  std::vector<std::size_t> ring_ends_;
  std::vector<End> ends_;
};

/// A layer of a file that GDAL has made, without rows.
struct EmptyLayer {
  std::string name, geometry;        ///< of the layer and its column of geometries
  std::vector<std::string> columns;  ///< as GDAL named them
  GeometryKind kind;
};

/// Puts rows into the layers of a file. Errors: unwritable. Some failures are only reported through
/// GDAL: callers listen with GdalMessages.
class RowFile {
 public:
  RowFile() = default;
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;
  virtual ~RowFile() = default;

  virtual Status add(const Rows& rows) = 0;
  /// There are no more.
  virtual Status close() = 0;
};

/// Of a closed file. Adding rows this way, by SQLite and by shapelib, is several times faster than
/// through GDAL.
Result<std::unique_ptr<RowFile>> rows_of_geopackage(const std::string& path,
                                                    std::span<const EmptyLayer> layers,
                                                    bool is_new);
Result<std::unique_ptr<RowFile>> rows_of_shapefile(const std::string& path,
                                                   std::span<const EmptyLayer> layers, bool is_new);

}  // namespace medial::io
