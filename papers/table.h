#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace medial::papers {

/// A table of results: Markdown for readers, CSV with all digits for programs.
class Table {
 public:
  /// NaN is an empty cell.
  using Cell = std::variant<std::string, std::uint64_t, double>;
  struct Column {
    std::string name;
    std::string format = "{}";  ///< of the numbers in Markdown
  };

  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}
  void add(std::vector<Cell> row) { rows_.push_back(std::move(row)); }

  /// Columns whose first cell is a number are aligned to the right.
  std::string markdown() const;
  std::string csv() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace medial::papers
