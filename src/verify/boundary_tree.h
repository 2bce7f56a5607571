#pragma once

#include <cstdint>
#include <vector>

#include "medial/shape.h"

namespace medial::verify_detail {

/// Distance from p to the closed segment a b. Coordinates are subtracted before anything is
/// multiplied, and the nearer end is the origin: the error is below two units in the last place of
/// half the segment's length plus the distance.
double distance_to_segment(Vec2 p, Vec2 a, Vec2 b);

/// The nearest boundary edge of a shape: a tree of boxes over the edges in spatial order (the
/// engines search along the boundary instead). Few edges are simply all looked at.
class BoundaryTree {
 public:
  explicit BoundaryTree(const Shape& shape);

  /// Distance from p to the nearest edge. `expected` is a guess at it: a query is fast where the
  /// guess is not much too large and not too small. O(log n) expected then.
  double distance(Vec2 p, double expected) const;

 private:
  /// Four boxes side by side, so that a compiler can compare them at once.
  struct Boxes {
    double low_x[4], low_y[4], high_x[4], high_y[4];
  };
  struct Segment {
    Vec2 a, b;
  };

  bool search(Vec2 p, double& best) const;
  double some_distance(Vec2 p) const;
  double segment_distance(std::uint32_t i, Vec2 p) const {
    return distance_to_segment(p, segments_[i].a, segments_[i].b);
  }

  std::vector<Segment> segments_;
  std::vector<std::vector<Boxes>> levels_;  ///< levels_[0]: the boxes of the segments
};

}  // namespace medial::verify_detail
