#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/tables.h"
#include "medial/document.h"

namespace medial::io {

/// The attributes of the input as columns of the output. Attributes travel as text; a column whose
/// every value is the usual spelling of a number becomes numbers again, unless the input says that
/// it is a text. ("007" is no usual spelling.)
class AttributeColumns {
 public:
  AttributeColumns() = default;
  /// Takes all items of a document, with what lies in their buffers and diagrams; an attribute that
  /// is named as one of the writer's `own` columns gets another name.
  template <class Item>
  AttributeColumns(const Document<Item>& file, std::span<const Column> own) {
    for (const Item& item : file.items) {
      add(item.attributes);
      if constexpr (requires { item.sources; })
        for (const auto& source : item.sources) add(source.attributes);
      if constexpr (requires { item.pieces; })
        for (const Attributes& attributes : item.pieces.features.items) add(attributes);
    }
    finish(file, own);
  }

  /// Takes the attributes of one item into account; finish() follows when there are no more.
  void add(const Attributes& attributes);
  /// Texts stay texts; names differ from those of the writer's `own` columns.
  void finish(const DocumentInfo& info, std::span<const Column> own);

  /// The columns of a table, and these.
  std::vector<Column> appended_to(std::vector<Column> columns) const;
  /// The values of one item in these columns.
  std::vector<Value> values_of(const Attributes& item) const;
  const std::vector<Column>& columns() const { return columns_; }

 private:
  std::map<std::string, std::size_t> index_;  ///< by the names in the input
  std::vector<std::string> names_;            ///< in the input
  std::vector<Column> columns_;  ///< in the output, named differently from the writer's own
};

}  // namespace medial::io
