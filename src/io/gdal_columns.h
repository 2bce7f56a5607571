#pragma once

#include <ogr_core.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

class OGRFeature;
class OGRLayer;

namespace medial::io {

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// The attributes of the input as columns of the output. Attributes travel as text; a column whose
/// every value is the usual spelling of a number becomes numbers again (so "007" stays a text).
class AttributeColumns {
 public:
  /// `own`: the names that the writer's own columns have, in lower case; an attribute of such a
  /// name gets another one.
  AttributeColumns(std::span<const Attributes* const> items, std::span<const std::string> own);

  /// Adds the columns to a layer; false where GDAL refuses.
  bool create_in(OGRLayer& layer) const;
  /// Sets the values of one item, in the fields from `first` on.
  void set(OGRFeature& feature, int first, const Attributes& item) const;

 private:
  struct Column {
    std::string name;    ///< in the input
    std::string column;  ///< in the output, different from the writer's own
    OGRFieldType type = OFTInteger64;
  };
  std::vector<Column> columns_;
};

}  // namespace medial::io
