#pragma once

#include <cstddef>
#include <cstdint>

#include "medial/geometry.h"
#include "verify/boundary_edge.h"

namespace medial::verify_detail {

/// Boxes around four sets of edges, laid out for vectorised comparison. A box is aligned with the
/// longest extent of its set or with the axes, whichever is smaller; on a smooth boundary,
/// axis-aligned boxes would not exclude enough edges near a contact. `across` is normal . (p -
/// origin), `along` the same with the normal turned to the right.
struct Bounds {
  double normal_x[4], normal_y[4];
  double low_along[4], high_along[4], low_across[4], high_across[4];

  void set(std::size_t i, Vec2 normal, const Box& along_and_across) {
    normal_x[i] = normal.x;
    normal_y[i] = normal.y;
    low_along[i] = along_and_across.low.x;
    high_along[i] = along_and_across.high.x;
    low_across[i] = along_and_across.low.y;
    high_across[i] = along_and_across.high.y;
  }
};

/// Four edges, laid out for vectorised comparison.
struct Run {
  double start_x[4], start_y[4], end_x[4], end_y[4], bulge[4];
  std::uint32_t index[4];  ///< among the shape's

  void set(std::size_t i, const BoundaryEdge& edge, std::uint32_t its_index) {
    start_x[i] = edge.start.x;
    start_y[i] = edge.start.y;
    end_x[i] = edge.end.x;
    end_y[i] = edge.end.y;
    bulge[i] = edge.bulge;
    index[i] = its_index;
  }
};

}  // namespace medial::verify_detail
