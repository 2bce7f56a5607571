#pragma once

#include <vector>

#include "base/box_tree.h"
#include "medial/shape.h"

namespace medial {

/// Tests whether points are inside a shape. Keeps a copy of its edges, not the shape.
class Inside {
 public:
  /// O(n log n).
  explicit Inside(const Shape& shape);
  /// Whether clearance() is above 0. On the boundary, either answer. O(log n) for each edge that a
  /// ray to the right meets.
  bool holds(Vec2 p) const;

 private:
  struct BoundaryEdge {
    Vec2 a, b;
    double bulge;
  };
  static std::vector<BoundaryEdge> edges_of(const Shape& shape);
  static std::vector<Box> boxes_of(const std::vector<BoundaryEdge>& edges);

  std::vector<BoundaryEdge> edges_;
  BoxTree tree_;
};

}  // namespace medial
