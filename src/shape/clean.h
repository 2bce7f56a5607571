#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "base/quarter_map.h"
#include "medial/shape.h"

namespace medial {

inline constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

/// The weight of an edge in a fill rule: the number of rings of role `winding` that run along it,
/// forward minus backward, and the parity of the number of other rings.
struct EdgeWeight {
  std::int32_t winding = 0;
  bool odd = false;
};

/// The cleaned rings of the input: ring i is points[begin[i], begin[i + 1]). Edge v runs from
/// vertex v to next(v). Each ring has at least three vertices (two if it has arcs), neighbours
/// differ, and no vertex lies inside a straight run or, up to rounding, inside an arc of at most a
/// half circle. No coordinate is -0.
///
/// For a planar graph, the rings are open chains: the last vertex of each starts no edge, and a
/// chain of one vertex is a point.
struct CleanRings {
  std::vector<Vec2> points;
  std::vector<double> bulges;         ///< of each edge, at most 1 in magnitude; empty: all straight
  std::vector<VertexSource> sources;  ///< sources[v].ring is also the index in `begin`
  std::vector<std::uint32_t> begin;
  bool open = false;
  std::vector<EdgeWeight> weights;  ///< of chains' edges, where a fill rule wants them; else empty

  /// no_index where an open chain has no more.
  std::uint32_t next(std::uint32_t vertex) const {
    const std::uint32_t ring = sources[vertex].ring;
    if (vertex + 1 < begin[ring + 1]) return vertex + 1;
    return open ? no_index : begin[ring];
  }
  std::uint32_t previous(std::uint32_t vertex) const {
    const std::uint32_t ring = sources[vertex].ring;
    if (open && vertex == begin[ring]) return no_index;
    return (vertex == begin[ring] ? begin[ring + 1] : vertex) - 1;
  }
};

/// Drops closing points, repeated points and the vertices inside straight runs and arcs, splits
/// arcs of more than a half circle, and counts dropped points in the report. O(n). Errors, of the
/// first invalid ring: empty, too_large, not_finite, too_few_points, no_area.
Result<CleanRings> clean(std::span<const Ring> rings, ShapeReport& report);

/// An edge of a ring, by its first vertex.
struct RingEdge {
  Vec2 point;
  double bulge = 0;
  VertexSource source;
};

/// Properties of all rings, for cleaning one of them.
struct RingSurroundings {
  std::function<QuarterMap()> map;  ///< the best one of all rings, if a circle may be cut anywhere
  std::function<bool(Vec2)> is_shared;  ///< whether rings have more than one vertex there
};

/// The same for the edges of one ring with arcs, none of length zero. A bulge whose arc is straight
/// up to rounding becomes 0. A full circle becomes two half circles, which start at one of the
/// vertices farthest from the centre of their box, or at a vertex that rings share.
void clean_arcs(std::vector<RingEdge>& edges, const RingSurroundings& around, ShapeReport& report);

}  // namespace medial
