#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial/shape.h"

namespace medial {

/// The rings of the input without what does not matter: ring i is points[begin[i], begin[i + 1]).
/// Edge v runs from vertex v to next(v). In each ring there are at least three vertices, neighbours
/// differ, and no vertex lies in the inside of a straight run. No coordinate is -0.
struct Outline {
  std::vector<Vec2> points;
  std::vector<VertexSource> sources;  ///< sources[v].ring is also the index in `begin`
  std::vector<std::uint32_t> begin;

  std::uint32_t next(std::uint32_t vertex) const {
    const std::uint32_t ring = sources[vertex].ring;
    return vertex + 1 == begin[ring + 1] ? begin[ring] : vertex + 1;
  }
  std::uint32_t previous(std::uint32_t vertex) const {
    const std::uint32_t ring = sources[vertex].ring;
    return (vertex == begin[ring] ? begin[ring + 1] : vertex) - 1;
  }
};

/// Drops closing points, repeated points and the vertices in the inside of straight runs, and
/// counts them in the report. O(n). Errors: empty, too_large, not_finite, too_few_points, no_area,
/// of the first ring that has one.
Result<Outline> clean(std::span<const Ring> rings, ShapeReport& report);

}  // namespace medial
