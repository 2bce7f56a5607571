#pragma once

// Spatial indexes of GeoPackage layers.

#include <cstdint>
#include <string>
#include <vector>

#include "medial/error.h"
#include "medial/vec2.h"

class GDALDataset;
class OGRLayer;

namespace medial::io {

class GdalMessages;

/// Whether a dataset is a GeoPackage; and the options of a layer that is to have no index yet.
bool has_gpkg_index(GDALDataset& target);
char** without_index();

/// The spatial index of a layer of a GeoPackage (extension gpkg_rtree_index), filled all at once
/// behind the features: one by one, as SQLite's R*-tree takes them, the index is most of the time
/// of writing. The packing is that of Leutenegger, Lopez and
/// Edgington, "STR: a simple and efficient algorithm for R-tree packing" (1997); the nodes are as
/// "The SQLite R*Tree module", section "Shadow tables", has them.
class GpkgIndex {
 public:
  /// Of a layer with all its columns and no features, created with without_index(). Where this
  /// SQLite has no R-trees, there will be no index.
  GpkgIndex(GDALDataset& target, OGRLayer& layer);

  /// A feature: its row, and the points of its line, at least one.
  void add(std::int64_t row, const std::vector<Vec2>& points);
  /// Writes the index, behind the last feature. O(n log n). Errors: unwritable.
  Status write(const GdalMessages& messages);

 private:
  struct Cell {
    std::int64_t id = 0;  ///< of the feature, or of the node below
    float low_x = 0, high_x = 0, low_y = 0, high_y = 0;
  };
  struct Insert;  ///< rows of a table, in statements of some size

  std::string text_of(const std::string& query) const;
  void sort(std::vector<Cell>& cells, std::size_t nodes) const;

  GDALDataset& target_;
  std::string table_;           ///< of the index
  std::string insert_trigger_;  ///< what SQLite is told again at the end; empty: there is no index
  std::size_t node_size_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace medial::io
