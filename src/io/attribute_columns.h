#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/tables.h"
#include "medial/document.h"

namespace medial::io {

/// The attributes of the input as columns of the output. Attributes travel as text; a column whose
/// every value is the usual spelling of a number becomes numbers again (so "007" stays a text).
class AttributeColumns {
 public:
  /// `own`: the names that the writer's own columns have, in lower case; an attribute of such a
  /// name gets another one.
  AttributeColumns(std::span<const Attributes* const> items, std::span<const std::string> own);

  /// Appends the columns to those of a table.
  void append_to(std::vector<Column>& columns) const;
  /// The values of one item in these columns.
  std::vector<Value> values_of(const Attributes& item) const;

 private:
  std::vector<std::string> names_;  ///< in the input
  std::vector<Column> columns_;     ///< in the output, named differently from the writer's own
};

}  // namespace medial::io
