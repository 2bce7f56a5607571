#pragma once

// Spatial indexes of GeoPackage layers.

#include <cstdint>
#include <string>
#include <vector>

#include "medial/vec2.h"

namespace medial::io {

class Database;

/// The spatial index of a layer of a GeoPackage (extension gpkg_rtree_index), filled all at once
/// behind the features: one by one, as SQLite's R*-tree takes them, the index is most of the time
/// of writing. The packing is that of Leutenegger, Lopez and
/// Edgington, "STR: a simple and efficient algorithm for R-tree packing" (1997); the nodes are as
/// "The SQLite R*Tree module", section "Shadow tables", has them.
class GpkgIndex {
 public:
  /// Of a layer without features, whose tables GDAL has made. Where this SQLite has no R-trees,
  /// there is no index. Throws SqliteFailure.
  GpkgIndex(Database& database, const std::string& layer);

  /// A feature: its row, and its box.
  void add(std::int64_t row, Vec2 low, Vec2 high);
  /// Writes the index, behind the last feature. O(n log n). Throws SqliteFailure.
  void write();

 private:
  struct Cell {
    std::int64_t id = 0;  ///< of the feature, or of the node below
    float low_x = 0, high_x = 0, low_y = 0, high_y = 0;
  };

  void sort(std::vector<Cell>& cells, std::size_t nodes) const;

  Database& database_;
  std::string table_;          ///< of the index
  std::size_t node_size_ = 0;  ///< in bytes; 0: there is no index
  std::vector<Cell> cells_;
};

}  // namespace medial::io
