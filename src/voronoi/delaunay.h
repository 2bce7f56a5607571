#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "base/local_frame.h"
#include "medial/axis.h"

namespace medial::voronoi {

/// In place of a vertex: outside the convex hull.
constexpr std::uint32_t outside = 0xFFFFFFFF;

/// A Delaunay triangulation of the whole plane: triangles, and one "ghost" beyond each edge of the
/// convex hull, one of whose vertices is `outside`.
///
/// Half-edge 4 t + i leads from vertex[i] of triangle t to the next one, i < 3, the triangle on its
/// left.
struct Delaunay {
  struct alignas(32) Triangle {
    std::array<std::uint32_t, 3> vertex;  ///< counter-clockwise; of a ghost vertex[2] is a point
    std::uint32_t mark = 0;  ///< 1 where circles[] has all of its digits; then free for use
    std::array<std::uint32_t, 3> twin;  ///< of each half-edge, the same one backward
    std::uint32_t spare = 0;            ///< free for use
    bool is_ghost() const { return vertex[0] == outside || vertex[1] == outside; }
  };

  static std::uint32_t next(std::uint32_t h) { return (h & 3U) == 2 ? h - 2 : h + 1; }
  static std::uint32_t before(std::uint32_t h) { return (h & 3U) == 0 ? h + 2 : h - 1; }
  std::uint32_t start(std::uint32_t h) const { return triangles[h >> 2U].vertex[h & 3U]; }
  std::uint32_t twin(std::uint32_t h) const { return triangles[h >> 2U].twin[h & 3U]; }

  std::vector<Triangle> triangles;  ///< 2 n - 2 of n points; none where all lie on one line
  /// Of each triangle the circle around it, with the square of its radius, infinite for ghosts and
  /// where rounding leaves few digits. There is room for the nodes of a dual.
  std::vector<Node> circles;
  std::vector<Vec2> points;          ///< local, in the order of insertion: mostly near to the next
  std::vector<std::uint32_t> input;  ///< of each point: which one of the input it is
  std::vector<std::uint32_t> leaving;  ///< of each point: a half-edge
};

/// The triangulation of points that are all different, in the local frame; exact for all finite
/// coordinates; of points on one circle one that some tiny displacement would give. O(n log n)
/// expected for any points, over the random choices made here: points are inserted round by round,
/// each 32 times as large as the one before, a round along a space-filling curve (Amenta, Choi
/// and Rote, "Incremental constructions con BRIO", 2003), by the triangles whose circle holds them
/// (Bowyer 1981; Watson 1981). Incomplete where `cancel` becomes true. Requires less than 2^29
/// points.
Delaunay triangulate(std::span<const Vec2> points, const LocalFrame& local = {},
                     const std::atomic<bool>* cancel = nullptr);

}  // namespace medial::voronoi
