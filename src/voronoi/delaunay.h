#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "base/local_frame.h"
#include "medial/axis.h"

namespace medial::voronoi {

/// Stands for a vertex outside the convex hull.
constexpr std::uint32_t outside = 0xFFFFFFFF;

/// A Delaunay triangulation of the whole plane: triangles, and one "ghost" beyond each edge of the
/// convex hull, one of whose vertices is `outside`.
///
/// Half-edge 4 t + i (i < 3) leads from vertex[i] of triangle t to the next vertex, with the
/// triangle on its left.
struct Delaunay {
  struct alignas(32) Triangle {
    std::array<std::uint32_t, 3> vertex;  ///< counter-clockwise; of a ghost vertex[2] is a point
    std::uint32_t mark = 0;  ///< 1: circles[] is accurate; after triangulation, free for use
    std::array<std::uint32_t, 3> twin;  ///< of each half-edge: its reverse
    std::uint32_t spare = 0;            ///< free for use
    bool is_ghost() const { return vertex[0] == outside || vertex[1] == outside; }
  };

  static std::uint32_t next(std::uint32_t h) { return (h & 3U) == 2 ? h - 2 : h + 1; }
  static std::uint32_t before(std::uint32_t h) { return (h & 3U) == 0 ? h + 2 : h - 1; }
  std::uint32_t start(std::uint32_t h) const { return triangles[h >> 2U].vertex[h & 3U]; }
  std::uint32_t twin(std::uint32_t h) const { return triangles[h >> 2U].twin[h & 3U]; }

  std::vector<Triangle> triangles;  ///< 2 n - 2 for n points; none if all lie on one line
  /// The circumcircle of each triangle, with its squared radius; infinite for ghosts and if
  /// rounding leaves few digits. Has capacity for the nodes of a dual.
  std::vector<Node> circles;
  std::vector<Vec2> points;            ///< local, in insertion order: each is usually near the next
  std::vector<std::uint32_t> input;    ///< of each point: its index in the input
  std::vector<std::uint32_t> leaving;  ///< of each point: a half-edge
};

/// The Delaunay triangulation of distinct points in the local frame. Exact for all finite
/// coordinates. Cocircular points are triangulated as after some tiny displacement. O(n log n)
/// expected for any points, over the random choices made here: points are inserted in rounds, each
/// 32 times as large as the previous one, along a space-filling curve (Amenta, Choi and Rote,
/// "Incremental constructions con BRIO", 2003), by replacing the triangles whose circumcircle
/// contains the point (Bowyer 1981; Watson 1981). Incomplete if `cancel` becomes true. Requires
/// less than 2^29 points.
Delaunay triangulate(std::span<const Vec2> points, const LocalFrame& local = {},
                     const std::atomic<bool>* cancel = nullptr);

}  // namespace medial::voronoi
