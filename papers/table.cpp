#include "papers/table.h"

#include <fmt/format.h>

#include <cmath>

namespace medial::papers {
namespace {

std::string padded(const std::string& cell) { return cell.empty() ? " |" : " " + cell + " |"; }

std::string text_of(const Table::Cell& cell, const std::string& format) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* count = std::get_if<std::uint64_t>(&cell))
    return fmt::format(fmt::runtime(format), *count);
  const double number = std::get<double>(cell);
  return std::isnan(number) ? std::string() : fmt::format(fmt::runtime(format), number);
}

}  // namespace

std::string Table::markdown() const {
  std::string text = "|", rule = "|";
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const bool is_text = rows_.empty() || std::holds_alternative<std::string>(rows_[0][i]);
    text += padded(columns_[i].name);
    rule += is_text ? " --- |" : " ---: |";
  }
  text += "\n" + rule + "\n";
  for (const std::vector<Cell>& row : rows_) {
    text += "|";
    for (std::size_t i = 0; i < row.size(); ++i)
      text += padded(text_of(row[i], columns_[i].format));
    text += "\n";
  }
  return text;
}

std::string Table::csv() const {
  std::string text;
  const auto add = [&](std::size_t i, const std::string& cell) {
    text += cell + (i + 1 < columns_.size() ? "," : "\n");
  };
  for (std::size_t i = 0; i < columns_.size(); ++i) add(i, columns_[i].name);
  for (const std::vector<Cell>& row : rows_)
    for (std::size_t i = 0; i < row.size(); ++i) add(i, text_of(row[i], "{}"));
  return text;
}

}  // namespace medial::papers
