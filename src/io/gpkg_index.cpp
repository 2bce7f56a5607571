#include "io/gpkg_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "io/sqlite.h"

namespace medial::io {

namespace {

constexpr std::size_t header_size = 4, cell_size = 8 + 4 * sizeof(float);

/// The largest float that is not above, and the least that is not below.
float float_below(double value) {
  const auto near = static_cast<float>(value);
  return near > value ? std::nextafter(near, -std::numeric_limits<float>::infinity()) : near;
}
float float_above(double value) { return -float_below(-value); }

/// Appends a whole number, its high byte first.
template <class Number>
void put_big_endian(std::vector<std::uint8_t>& out, Number value) {
  for (int shift = 8 * (static_cast<int>(sizeof(Number)) - 1); shift >= 0; shift -= 8)
    out.push_back(static_cast<std::uint8_t>(value >> shift));
}

}  // namespace

GpkgIndex::GpkgIndex(Database& database, const std::string& layer) : database_(database) {
  Statement column(database, "SELECT column_name FROM gpkg_geometry_columns WHERE table_name=?");
  column.bind(1, layer);
  if (!column.step()) return;
  table_ = fmt::format("rtree_{}_{}", layer, column.text(0));
  Statement made(database, "SELECT count(*) FROM sqlite_master WHERE type='table' AND name=?");
  made.bind(1, table_);
  if (!made.step() || made.whole(0) == 0) return;
  Statement size(database, fmt::format("SELECT length(data) FROM {} WHERE nodeno=1",
                                       quoted_name(table_ + "_node")));
  if (size.step()) node_size_ = static_cast<std::size_t>(size.whole(0));
  if (node_size_ < header_size + 2 * cell_size) node_size_ = 0;
}

void GpkgIndex::add(std::int64_t row, Vec2 low, Vec2 high) {
  if (node_size_ == 0) return;
  cells_.push_back(
      {row, float_below(low.x), float_above(high.x), float_below(low.y), float_above(high.y)});
}

/// Slices by x of about as many nodes as there are slices, each of them by y.
void GpkgIndex::sort(std::vector<Cell>& cells, std::size_t nodes) const {
  // Twice the middle, in doubles: floats may overflow.
  const auto x = [](const Cell& c) { return double{c.low_x} + double{c.high_x}; };
  const auto y = [](const Cell& c) { return double{c.low_y} + double{c.high_y}; };
  std::ranges::sort(cells, {}, x);
  const auto slices = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(nodes))));
  for (std::size_t i = 0; i < slices; ++i) {
    const auto at = [&](std::size_t k) {
      return cells.begin() + static_cast<std::ptrdiff_t>(cells.size() * k / slices);
    };
    std::ranges::sort(at(i), at(i + 1), {}, y);
  }
}

void GpkgIndex::write() {
  if (node_size_ == 0) return;
  constexpr std::int64_t root = 1;
  const auto statement = [this](const char* verb, const char* ending) {
    return fmt::format("{} INTO {} VALUES(?,?)", verb, quoted_name(table_ + ending));
  };
  Statement nodes(database_, statement("REPLACE", "_node"));
  Statement rows(database_, statement("INSERT", "_rowid"));
  Statement parents(database_, statement("INSERT", "_parent"));
  const std::size_t capacity = (node_size_ - header_size) / cell_size;
  std::vector<Cell> cells = std::move(cells_), above;
  std::vector<std::pair<std::int64_t, std::int64_t>> leaves;  // row and node
  leaves.reserve(cells.size());
  std::int64_t next = root + 1;
  std::vector<std::uint8_t> bytes;
  for (std::uint16_t level = 0;; ++level) {
    const std::size_t count = std::max<std::size_t>((cells.size() + capacity - 1) / capacity, 1);
    if (count > 1) sort(cells, count);
    above.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t node = count == 1 ? root : next++;
      const std::size_t begin = cells.size() * i / count, end = cells.size() * (i + 1) / count;
      Cell box{node};
      bytes.clear();
      put_big_endian(bytes, count == 1 ? level : std::uint16_t{0});
      put_big_endian(bytes, static_cast<std::uint16_t>(end - begin));
      for (std::size_t k = begin; k < end; ++k) {
        const Cell& cell = cells[k];
        put_big_endian(bytes, static_cast<std::uint64_t>(cell.id));
        for (const float value : {cell.low_x, cell.high_x, cell.low_y, cell.high_y})
          put_big_endian(bytes, std::bit_cast<std::uint32_t>(value));
        if (level == 0) {
          leaves.emplace_back(cell.id, node);
        } else {
          parents.bind(1, cell.id);
          parents.bind(2, node);
          parents.run();
        }
        if (k == begin) {
          box = cell;
          box.id = node;
        }
        box.low_x = std::min(box.low_x, cell.low_x);
        box.high_x = std::max(box.high_x, cell.high_x);
        box.low_y = std::min(box.low_y, cell.low_y);
        box.high_y = std::max(box.high_y, cell.high_y);
      }
      bytes.resize(node_size_);
      nodes.bind(1, node);
      nodes.bind(2, std::span<const std::uint8_t>(bytes));
      nodes.run();
      above.push_back(box);
    }
    if (count == 1) break;
    cells.swap(above);
  }
  // In the order of their keys rows are appended, and none is looked for.
  std::ranges::sort(leaves);
  for (const auto& [row, node] : leaves) {
    rows.bind(1, row);
    rows.bind(2, node);
    rows.run();
  }
}

}  // namespace medial::io
