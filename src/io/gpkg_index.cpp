#include "io/gpkg_index.h"

#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>

#include "io/gdal_support.h"
#include "io/gdal_target.h"

namespace medial::io {

namespace {

constexpr std::size_t header_size = 4, cell_size = 8 + 4 * sizeof(float);

/// The largest float that is not above, and the least that is not below.
float float_below(double value) {
  const auto near = static_cast<float>(value);
  return near > value ? std::nextafter(near, -std::numeric_limits<float>::infinity()) : near;
}
float float_above(double value) { return -float_below(-value); }

void put_hex(std::string& out, std::uint64_t value, int bytes) {
  fmt::format_to(std::back_inserter(out), "{:0{}x}", value, 2 * bytes);
}

void execute(GDALDataset& target, const std::string& statement) {
  target.ReleaseResultSet(target.ExecuteSQL(statement.c_str(), nullptr, nullptr));
}

}  // namespace

bool has_gpkg_index(GDALDataset& target) { return EQUAL(target.GetDriverName(), "GPKG"); }

char** without_index() {
  static char option[] = "SPATIAL_INDEX=NO";
  static char* options[] = {option, nullptr};
  return options;
}

struct GpkgIndex::Insert {
  GDALDataset& target;
  std::string into;
  std::string statement = {};

  void add(std::int64_t key, std::string_view value) {
    constexpr std::size_t enough = 1U << 16U;
    statement += statement.empty() ? into : ",";
    fmt::format_to(std::back_inserter(statement), "({},{})", key, value);
    if (statement.size() > enough) end();
  }
  void end() {
    if (!statement.empty()) execute(target, statement);
    statement.clear();
  }
};

GpkgIndex::GpkgIndex(GDALDataset& target, OGRLayer& layer) : target_(target) {
  // GDAL makes the tables, their triggers and what announces them, all of them empty.
  const std::string column = layer.GetGeometryColumn();
  table_ = fmt::format("rtree_{}_{}", layer.GetName(), column);
  text_of(fmt::format("SELECT CreateSpatialIndex('{}','{}')", layer.GetName(), column));
  const std::string size =
      text_of(fmt::format("SELECT length(data) FROM \"{}_node\" WHERE nodeno=1", table_));
  node_size_ = std::strtoull(size.c_str(), nullptr, 10);
  if (node_size_ < header_size + 2 * cell_size) return;
  const std::string trigger = table_ + "_insert";
  insert_trigger_ = text_of(fmt::format("SELECT sql FROM sqlite_master WHERE name='{}'", trigger));
  if (!insert_trigger_.empty()) execute(target_, fmt::format("DROP TRIGGER \"{}\"", trigger));
}

std::string GpkgIndex::text_of(const std::string& query) const {
  OGRLayer* rows = target_.ExecuteSQL(query.c_str(), nullptr, nullptr);
  std::string text;
  if (rows != nullptr) {
    const OGRFeatureUniquePtr first(rows->GetNextFeature());
    if (first && first->GetFieldCount() > 0) text = first->GetFieldAsString(0);
  }
  target_.ReleaseResultSet(rows);
  return text;
}

void GpkgIndex::add(std::int64_t row, const std::vector<Vec2>& points) {
  if (insert_trigger_.empty()) return;
  Vec2 low = points.front(), high = low;
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
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

Status GpkgIndex::write(const GdalMessages& messages) {
  if (insert_trigger_.empty()) return success();
  constexpr std::int64_t root = 1;
  Insert nodes{target_, fmt::format("REPLACE INTO \"{}_node\" VALUES", table_)};
  Insert rows{target_, fmt::format("INSERT INTO \"{}_rowid\" VALUES", table_)};
  Insert parents{target_, fmt::format("INSERT INTO \"{}_parent\" VALUES", table_)};
  const std::size_t capacity = (node_size_ - header_size) / cell_size;
  std::vector<Cell> cells = std::move(cells_), above;
  std::int64_t next = root + 1;
  std::string blob;
  for (std::uint64_t level = 0;; ++level) {
    const std::size_t count = std::max<std::size_t>((cells.size() + capacity - 1) / capacity, 1);
    if (count > 1) sort(cells, count);
    above.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t node = count == 1 ? root : next++;
      const std::size_t begin = cells.size() * i / count, end = cells.size() * (i + 1) / count;
      Cell box{node};
      blob = "x'";
      put_hex(blob, count == 1 ? level : 0, 2);
      put_hex(blob, end - begin, 2);
      for (std::size_t k = begin; k < end; ++k) {
        const Cell& cell = cells[k];
        put_hex(blob, static_cast<std::uint64_t>(cell.id), 8);
        for (const float value : {cell.low_x, cell.high_x, cell.low_y, cell.high_y})
          put_hex(blob, std::bit_cast<std::uint32_t>(value), 4);
        (level == 0 ? rows : parents).add(cell.id, std::to_string(node));
        if (k == begin) {
          box = cell;
          box.id = node;
        }
        box.low_x = std::min(box.low_x, cell.low_x);
        box.high_x = std::max(box.high_x, cell.high_x);
        box.low_y = std::min(box.low_y, cell.low_y);
        box.high_y = std::max(box.high_y, cell.high_y);
      }
      blob.append(2 * (node_size_ - header_size - cell_size * (end - begin)), '0');
      blob += '\'';
      nodes.add(node, blob);
      above.push_back(box);
    }
    if (count == 1) break;
    cells.swap(above);
  }
  nodes.end();
  rows.end();
  parents.end();
  execute(target_, insert_trigger_);
  return messages.failure().empty() ? success() : cannot_write(messages);
}

}  // namespace medial::io
